"""The 3D view of 1,000 moving frames at 30 Hz: CPU of the server for each picture.

The whole process is counted: receiving and storing the transforms, computing all poses in the fixed
frame, the rows of the tree once a second, and sending all of it to one page.
"""

from __future__ import annotations

import subprocess
import sys
import threading
import time
from collections.abc import Iterator

from benchmarks.figures import Figure, Row, on_loopback

TITLE = "3D view: 1,000 frames at 30 Hz, CPU of the server for each picture"
FRAMES, RATE_HZ, PICTURES, ROUNDS = 1000, 30, 150, 3


def rows() -> Iterator[Row]:
    costs = Figure.of([measure() for _ in range(ROUNDS)])
    yield Row("wire, poses and page", costs, {}, "<= 3 ms")


def parent_of(number: int) -> str:
    """A tree ten frames wide, three deep."""
    return f"frame_{number // 10}" if number >= 10 else "map"


def measure() -> float:
    """CPU nanoseconds of a server for each picture."""
    environment = on_loopback(103)
    server, sender = ([sys.executable, "-m", __name__, word] for word in ("serve", "send"))
    with (
        subprocess.Popen(
            server, env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        ) as serving,
        subprocess.Popen(sender, env=environment, stdin=subprocess.PIPE) as sending,
    ):
        assert serving.stdin is not None
        assert serving.stdout is not None
        pictures = watch(serving.stdout.readline().strip(), serving)
        cpu_ns = float(serving.stdout.readline()) - float(pictures[1])
        serving.communicate("")
        sending.communicate()
    return cpu_ns / pictures[0]


def watch(url: str, server: subprocess.Popen[str]) -> tuple[int, str]:
    """Be the page for some pictures; how many, and the server's CPU time before."""
    from websockets.sync.client import connect

    assert server.stdin is not None
    assert server.stdout is not None
    before, count = "", -RATE_HZ
    with connect(url.replace("http", "ws", 1) + "live", max_size=None) as page:
        for message in page:
            if b'"type":"frames"' not in message[:100]:
                continue
            count += 1
            if count == 0:
                server.stdin.write("\n")
                server.stdin.flush()
                before = server.stdout.readline()
            if count == PICTURES:
                break
        server.stdin.write("\n")
        server.stdin.flush()
    return count, before


def serve() -> None:
    """Print the page's address, and the CPU time for each line that comes."""
    from turtlewire_view import LiveSource, Viewer

    viewer = Viewer(LiveSource(), port=0)
    print(viewer.url, flush=True)
    for _ in sys.stdin:
        print(time.process_time_ns(), flush=True)
    viewer.close()


def send() -> None:
    """Send all transforms in one message, 30 times a second, until the input ends."""
    from geometry_msgs.msg import TransformStamped
    from tf2_msgs.msg import TFMessage
    from turtlewire import msg, wire
    from turtlewire.tf.listener import QOS, TYPE_NAME
    from turtlewire.wire.base import TypeId

    ended = threading.Event()
    threading.Thread(target=lambda: (sys.stdin.read(), ended.set()), daemon=True).start()
    transforms = [TransformStamped(child_frame_id=f"frame_{n}") for n in range(1, FRAMES)]
    for number, transform in enumerate(transforms, 1):
        transform.header.frame_id = parent_of(number)
        transform.transform.translation.x = 1.0
    context = wire.open_context()
    node = context.create_node("sender")
    publisher = node.create_publisher("/tf", TypeId(TYPE_NAME, msg.type_hash(TYPE_NAME)), QOS)
    begin, count = time.monotonic(), 0
    while not ended.wait(max(0.0, begin + count / RATE_HZ - time.monotonic())):
        seconds, nanoseconds = divmod(time.time_ns(), 10**9)
        for transform in transforms:
            transform.header.stamp.sec, transform.header.stamp.nanosec = seconds, nanoseconds
            transform.transform.translation.y = 0.001 * count
        publisher.publish(msg.serialize(TFMessage(transforms=transforms)))
        count += 1
    context.close()


if __name__ == "__main__":
    {"serve": serve, "send": send}[sys.argv[1]]()
