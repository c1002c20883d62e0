"""Programs in plain rclpy, which run unchanged with ours and with the real one.

``python rclpy_programs.py NAME`` runs one and prints its figures as JSON. A program that serves
another one ends when its stdin is closed.
"""

import json
import sys
import threading
import time

BEGIN = time.perf_counter()

import rclpy  # noqa: E402 - the import is measured

IMPORTED = time.perf_counter()

from rclpy.executors import SingleThreadedExecutor  # noqa: E402
from rclpy.qos import HistoryPolicy, QoSProfile  # noqa: E402

WARM_UP, MESSAGES = 300, 2000
PERIOD_S = 0.001
TICKS, TICK_S = 500, 0.01
CALLS = 2000
IMAGES, IMAGE_SIZE = 300, 1920 * 1080 * 3
LOSSLESS = QoSProfile(history=HistoryPolicy.KEEP_ALL)


def report(**figures):
    print(json.dumps(figures), flush=True)


def make_node(name):
    rclpy.init(args=[])
    return rclpy.create_node(name)


def spin_until_stdin_closes(node):
    """Spin; the other process closes stdin when it has enough."""

    def wait_for_the_end():
        sys.stdin.read()
        rclpy.try_shutdown()

    threading.Thread(target=wait_for_the_end, daemon=True).start()
    try:
        rclpy.spin(node)
    except Exception:
        # The real executor may also trip over what the other thread has destroyed.
        if rclpy.ok():
            raise


def start():
    make_node("started")
    node = time.perf_counter()
    report(imported=(IMPORTED - BEGIN) * 1e9, node=(node - BEGIN) * 1e9)
    rclpy.shutdown()


def timer():
    """The CPU time of a tick, the executor's wait included."""
    node = make_node("ticker")
    done = rclpy.task.Future()
    cpu = []

    def tick():
        cpu.append(time.process_time_ns())
        if len(cpu) == TICKS:
            done.set_result(None)

    node.create_timer(TICK_S, tick)
    rclpy.spin_until_future_complete(node, done)
    report(cpu=(cpu[-1] - cpu[49]) / (len(cpu) - 50))
    rclpy.shutdown()


def latency_serve():
    """Publish strings at 1 kHz."""
    from std_msgs.msg import String

    node = make_node("sender")
    publisher = node.create_publisher(String, "latency", 10)
    cpu = []

    def tick():
        publisher.publish(String(data=str(time.perf_counter_ns())))
        cpu.append(time.process_time_ns())

    node.create_timer(PERIOD_S, tick)
    spin_until_stdin_closes(node)
    report(sender_cpu=(cpu[-1] - cpu[WARM_UP]) / (len(cpu) - 1 - WARM_UP))


def latency_ask():
    from std_msgs.msg import String

    node = make_node("receiver")
    done = rclpy.task.Future()
    latencies, cpu = [], []

    def receive(message):
        latencies.append(time.perf_counter_ns() - int(message.data))
        cpu.append(time.process_time_ns())
        if len(latencies) == WARM_UP + MESSAGES:
            done.set_result(None)

    node.create_subscription(String, "latency", receive, 10)
    rclpy.spin_until_future_complete(node, done)
    ranked = sorted(latencies[WARM_UP:])
    report(
        p50=ranked[len(ranked) // 2],
        p99=ranked[len(ranked) * 99 // 100],
        receiver_cpu=(cpu[WARM_UP + MESSAGES - 1] - cpu[WARM_UP]) / (MESSAGES - 1),
    )
    rclpy.shutdown()


def service_serve():
    from std_srvs.srv import SetBool

    node = make_node("server")
    cpu = []

    def answer(_request, response):
        cpu.append(time.process_time_ns())
        return response

    node.create_service(SetBool, "switch", answer)
    spin_until_stdin_closes(node)
    report(server_cpu=(cpu[-1] - cpu[WARM_UP]) / (len(cpu) - 1 - WARM_UP))


def service_ask():
    """Call in the way that is fastest with the real rclpy: one executor, and `spin_once`."""
    from std_srvs.srv import SetBool

    node = make_node("client")
    client = node.create_client(SetBool, "switch")
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    if not client.wait_for_service(30.0):
        sys.exit("no server within 30 s")
    times, cpu = [], 0
    for number in range(WARM_UP + CALLS):
        if number == WARM_UP:
            cpu = time.process_time_ns()
        begin = time.perf_counter_ns()
        future = client.call_async(SetBool.Request(data=True))
        while not future.done():
            executor.spin_once(10.0)
        times.append(time.perf_counter_ns() - begin)
    cpu = time.process_time_ns() - cpu
    times = times[WARM_UP:]
    report(call=sum(times) / CALLS, call_p50=sorted(times)[CALLS // 2], client_cpu=cpu / CALLS)
    rclpy.shutdown()


def images_serve():
    """Count images; nothing is dropped, and a slow subscription holds up the publisher."""
    from sensor_msgs.msg import Image

    node = make_node("viewer")
    moments = []
    node.create_subscription(
        Image, "image", lambda _: moments.append(time.perf_counter_ns()), LOSSLESS
    )
    spin_until_stdin_closes(node)
    report(image=(moments[-1] - moments[9]) / (len(moments) - 10))


def images_ask():
    from sensor_msgs.msg import Image

    node = make_node("camera")
    publisher = node.create_publisher(Image, "image", LOSSLESS)
    image = Image(height=1080, width=1920, step=1920 * 3, data=bytes(IMAGE_SIZE))
    while not publisher.get_subscription_count():
        rclpy.spin_once(node, timeout_sec=0.1)
    cpu = time.process_time_ns()
    for _ in range(IMAGES):
        publisher.publish(image)
    cpu = time.process_time_ns() - cpu
    publisher.wait_for_all_acked(rclpy.duration.Duration(seconds=30))
    time.sleep(0.5)  # acknowledged, but not yet all handed to the other's callback
    report(image_cpu=cpu / IMAGES)
    rclpy.shutdown()


if __name__ == "__main__":
    globals()[sys.argv[1]]()
