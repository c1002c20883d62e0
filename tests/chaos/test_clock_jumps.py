"""Clocks that jump: the computer's own, and the simulated one of ``/clock``."""

import platform
import random
import shutil
import struct
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

HOUR = 3600
#: A timer of the steady clock (a node's own clock is the computer's, so that its timers wait again
#: for a time that a jump back repeats, as in ROS 2), a topic, a service and a transform with a
#: timeout; says a line whenever all have worked.
ALIVE = """
import itertools, sys, threading
import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.clock import Clock, ClockType
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.time import Time
from std_msgs.msg import String
from std_srvs.srv import Trigger
from tf2_ros import Buffer, TransformBroadcaster, TransformListener

rclpy.init()
node, other = rclpy.create_node("alive"), rclpy.create_node("other")
buffer = Buffer()
TransformListener(buffer, other, spin_thread=True)
broadcaster = TransformBroadcaster(node)
publisher = node.create_publisher(String, "words", 10)
ticks, heard = threading.Semaphore(0), threading.Semaphore(0)

def tick():
    transform = TransformStamped(child_frame_id="robot")
    transform.header.frame_id = "world"
    transform.header.stamp = node.get_clock().now().to_msg()
    broadcaster.sendTransform(transform)
    publisher.publish(String(data="word"))
    ticks.release()

node.create_timer(0.02, tick, clock=Clock(clock_type=ClockType.STEADY_TIME))
node.create_subscription(String, "words", lambda message: heard.release(), 10)
node.create_service(Trigger, "ask", lambda request, response: response)
client = other.create_client(Trigger, "ask")
executor = SingleThreadedExecutor()
executor.add_node(node)
thread = threading.Thread(target=executor.spin)
thread.start()

for line in sys.stdin:
    for events in (ticks, heard):
        while events.acquire(blocking=False):
            pass
        assert events.acquire(timeout=60), "no event"
    buffer.clear()
    assert buffer.lookup_transform("world", "robot", Time(), Duration(seconds=60))
    assert not buffer.can_transform("world", "nowhere", Time(), Duration(seconds=0.1))
    assert client.wait_for_service(60)
    assert client.call(Trigger.Request(), 60) is not None
    print("alive", line.strip(), int(node.get_clock().now().nanoseconds // 10**9))
rclpy.shutdown()
thread.join(60)
print("joined", not thread.is_alive())
"""


@pytest.fixture
def jumping_clock(tmp_path):
    """Environment of a process whose clock jumps, and a function that sets the offset in
    seconds.
    """
    if (platform.system(), platform.machine()) != ("Linux", "x86_64") or not shutil.which("cc"):
        pytest.skip("preloads a clock that is compiled here with cc, for glibc on x86_64")
    library, offset = tmp_path / "jumping_clock.so", tmp_path / "offset"
    source = Path(__file__).with_name("jumping_clock.c")
    subprocess.run(["cc", "-shared", "-fPIC", "-o", library, source, "-ldl"], check=True)
    offset.write_bytes(struct.pack("q", 0))

    def jump(seconds):
        with offset.open("r+b") as file:
            file.write(struct.pack("q", seconds))

    return {"LD_PRELOAD": str(library), "CLOCK_OFFSET": str(offset)}, jump


def test_nodes_live_on_when_the_clock_of_the_computer_jumps(run, jumping_clock, ends_well):
    """As when it is set by NTP, by hand, or after a suspend."""
    environment, jump = jumping_clock
    program = run(sys.executable, "-u", "-c", ALIVE, environment=environment, terminal=True)
    times = []
    for number, seconds in enumerate([0, HOUR, -HOUR, 24 * HOUR, 0, -365 * 24 * HOUR, 0]):
        jump(seconds)
        program.type(f"{number}\n")
        times.append(int(program.wait_for(rf"^alive {number} (\d+)")[0][1]))
    program.type("\x04")
    program.wait_for("^joined True")
    assert ends_well(program) == 0
    assert times[1] - times[0] > 0.9 * HOUR
    assert times[5] < times[0]


#: A node in simulated time, with a timer, a transform listener and a sleeping thread.
SIMULATED = """
import threading
import rclpy
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from rclpy.time import Time
from rosgraph_msgs.msg import Clock
from std_msgs.msg import String
from tf2_ros import Buffer, TransformListener

rclpy.init()
node = rclpy.create_node("simulated", parameter_overrides=[Parameter("use_sim_time", value=True)])
buffer = Buffer()
TransformListener(buffer, node)
node.create_timer(0.5, lambda: None)
done = threading.Event()
def end(message):
    done.set()
node.create_subscription(String, "end", end, 10)
executor = SingleThreadedExecutor()
executor.add_node(node)

def look():
    while not done.is_set():
        buffer.can_transform("a", "b", Time(), Duration(seconds=0.05))

looking = threading.Thread(target=look)
looking.start()
print("up")
while not all(node.count_publishers(topic) for topic in ("/clock", "/end")):
    executor.spin_once(timeout_sec=0.1)
print("connected")
while not done.is_set():
    executor.spin_once(timeout_sec=1.0)
# The last times may still wait behind the message that ends it: they are of another topic.
while node.get_clock().now().nanoseconds != 7_000_000_000:
    executor.spin_once(timeout_sec=1.0)
print("now", node.get_clock().now().nanoseconds)
looking.join(60)
print("joined", not looking.is_alive())
rclpy.shutdown()
"""


def test_nodes_live_on_when_simulated_time_jumps(python, ends_well):
    """Negative, huge and ever-changing times; the last good one is the time that counts."""
    import rclpy
    from rosgraph_msgs.msg import Clock
    from std_msgs.msg import String

    program = python(SIMULATED)
    program.wait_for("^up")
    drawn = random.Random(11)
    with rclpy.Context() as context:
        node = rclpy.create_node("world", context=context)
        clock = node.create_publisher(Clock, "/clock", 1000)
        end = node.create_publisher(String, "/end", 10)
        publishers = (clock, end)
        assert context.wait_for_graph(
            lambda: all(publisher.get_subscription_count() for publisher in publishers),
            60_000_000_000,
        ), program.text
        program.wait_for("^connected")  # it may know the publishers later than they know it
        for _ in range(150):
            message = Clock()
            message.clock.sec = drawn.choice([0, -1, -(2**31), 2**31 - 1, drawn.randrange(1000)])
            message.clock.nanosec = drawn.choice([0, 2**32 - 1, drawn.randrange(10**9)])
            clock.publish(message)
        message.clock.sec, message.clock.nanosec = 7, 0
        clock.publish(message)
        assert clock.wait_for_all_acked(rclpy.duration.Duration(seconds=60))
        end.publish(String())
        program.wait_for(r"^now 7000000000$")
    assert ends_well(program) == 0, program.text
    assert program.lines[-1][1] == "joined True"
