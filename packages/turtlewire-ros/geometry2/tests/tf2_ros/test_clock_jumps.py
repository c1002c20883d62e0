"""A simulated world that is killed and restarts at an earlier time.

The server, the client, filters and tools, each in its own process.
"""

import contextlib
import signal
import sys
import threading
import time

import pytest
from tests.places import ROS2

from rclpy.duration import Duration
from rclpy.time import Time
from tf2_ros import BufferClient, TimeoutException, TransformException

pytestmark = pytest.mark.usefixtures("real_middleware")

SIMULATED = ("--ros-args", "-p", "use_sim_time:=true")

#: Plays from a time on, 50 times as fast as real time: the clock, a robot at x, a point in its
#: frame; each tick its transform comes last.
WORLD = """
import sys, time
import rclpy
from geometry_msgs.msg import PointStamped, TransformStamped
from rclpy.node import Node
from rclpy.time import Time
from rosgraph_msgs.msg import Clock
from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster

now, x = float(sys.argv[1]), float(sys.argv[2])
rclpy.init()
node = Node("world")
clock = node.create_publisher(Clock, "/clock", 10)
points = node.create_publisher(PointStamped, "point", 10)
broadcaster, static = TransformBroadcaster(node), StaticTransformBroadcaster(node)


def transform(child, x, stamp):
    message = TransformStamped(child_frame_id=child)
    message.header.frame_id, message.header.stamp = "world", stamp
    message.transform.translation.x = x
    return message


if x == 1.0:
    static.sendTransform(transform("wall", 5.0, Time().to_msg()))
while True:
    stamp = Time(seconds=now).to_msg()
    clock.publish(Clock(clock=stamp))
    point = PointStamped()
    point.header.frame_id, point.header.stamp = "robot", stamp
    points.publish(point)
    broadcaster.sendTransform(transform("robot", x, stamp))
    time.sleep(0.01)
    now += 0.5
"""

#: Waits in the server for what never comes.
WAITING = """
import rclpy
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import BufferClient

rclpy.init()
client = BufferClient(Node("waiting"), "tf2_buffer_server")
assert client.action_client.wait_for_server(60)
print("waits", flush=True)
client.lookup_transform("world", "nowhere", Time(), Duration(seconds=3600))
"""

#: Takes the points into the world, and prints where they are.
FILTERING = """
import rclpy
from geometry_msgs.msg import PointStamped
from message_filters import Subscriber, TimeSynchronizer
from rclpy.duration import Duration
from rclpy.node import Node
from tf2_ros import Buffer, MessageFilter, TransformListener
import tf2_geometry_msgs

rclpy.init(args=["filtering", "--ros-args", "-p", "use_sim_time:=true"])
node, buffer = Node("filtering"), Buffer()
TransformListener(buffer, node)
filters = [
    MessageFilter(
        Subscriber(node, PointStamped, "point"), buffer, "world", 100, node,
        timeout=Duration(seconds=60),
    )
    for _ in "ab"
]


def handle(point, _same):
    print("at", point.header.stamp.sec, "x", buffer.transform(point, "world").point.x, flush=True)


TimeSynchronizer(filters, 10).registerCallback(handle)
rclpy.spin(node)
"""


@pytest.fixture
def client(node):
    client = BufferClient(node, "tf2_buffer_server", timeout_padding=Duration(seconds=2))
    yield client
    client.destroy()


@pytest.fixture
def world(run):
    return lambda begins, x: run(sys.executable, "-c", WORLD, str(begins), str(x))


def place(client, frame="robot"):
    return client.lookup_transform(
        "world", frame, Time(), Duration(seconds=2)
    ).transform.translation.x


def wait_until_there(client, x):
    """Ask as often as it takes.

    A server may not have heard of the new time yet, or may have been killed just now.
    """
    until = time.monotonic() + 90
    found = None
    while found != x:
        assert time.monotonic() < until, found
        with contextlib.suppress(TransformException):
            found = place(client)


def test_server_and_client_after_the_world_began_anew(client, run, world):
    server = run(ROS2, "run", "tf2_ros", "buffer_server", *SIMULATED)
    first = world(1000, 1.0)
    wait_until_there(client, 1.0)
    first.kill()
    world(100, 2.0)
    wait_until_there(client, 2.0)  # what was there before had later stamps
    with pytest.raises(TransformException):
        client.lookup_transform("world", "robot", Time(seconds=1001), Duration())
    assert place(client, "wall") == 5.0  # static transforms hold for all times
    server.wait_for("Detected jump back in time. Clearing tf buffer.")


@pytest.mark.slow
def test_the_client_goes_on_with_the_next_server(client, run, world):
    server = run(ROS2, "run", "tf2_ros", "buffer_server")
    world(100, 2.0)
    wait_until_there(client, 2.0)
    threading.Timer(0.5, server.kill).start()
    with pytest.raises(
        TimeoutException, match="The BufferServer left the graph before it answered"
    ):
        client.lookup_transform("world", "nowhere", Time(), Duration(seconds=3600))
    run(ROS2, "run", "tf2_ros", "buffer_server")
    wait_until_there(client, 2.0)


def test_clients_that_are_killed_while_they_wait_hold_up_nobody(client, run, world):
    server = run(ROS2, "run", "tf2_ros", "buffer_server")
    world(100, 2.0)
    waiting = [run(sys.executable, "-c", WAITING) for _ in range(2)]
    for each in waiting:
        each.wait_for("waits")
    wait_until_there(client, 2.0)
    for each in waiting:
        each.kill()
    assert place(client) == 2.0
    # Not to the group: `ros2 run` passes the signal on, and the second one would be a new request.
    server.process.send_signal(signal.SIGINT)
    assert server.wait() == 0
    assert "Traceback" not in server.text


def test_filters_after_the_world_began_anew(run, world):
    filtering = run(sys.executable, "-c", FILTERING)
    first = world(1000, 1.0)
    filtering.wait_for(r"^at 10\d\d x 1\.0$", count=20)
    first.kill()
    world(100, 2.0)
    filtering.wait_for(r"^at 1\d\d x 2\.0$", count=20)
    assert "Traceback" not in filtering.text
    later = filtering.text.partition("x 2.0")[2]
    assert "x 1.0" not in later


def test_echo_after_the_world_began_anew(run, world):
    echo = run(ROS2, "run", "tf2_ros", "tf2_echo", "world", "robot", "20", *SIMULATED)
    first = world(1000, 1.0)
    echo.wait_for(r"Translation: \[1\.000, 0\.000, 0\.000\]", count=3)
    first.kill()
    world(100, 2.0)
    echo.wait_for(r"Translation: \[2\.000, 0\.000, 0\.000\]", count=3)


def test_monitor_in_simulated_time(run, world):
    world(1000, 1.0)
    monitor = run(
        ROS2, "run", "tf2_ros", "tf2_monitor", "--period", "1", "--limit", "2", *SIMULATED
    )
    delays = [
        float(match[1])
        for match in monitor.wait_for(
            r"Frame: robot, published by /world, Average Delay: (\S+),", count=2
        )
    ]
    assert monitor.wait() == 0
    assert abs(delays[1]) < 100.0  # and not the thousand seconds to the start of the clock
