"""Programs that end while daemon threads use the native core; run as ``python exits.py KIND``.

They import nothing of the tests: `scripts/smoke` runs them on installed wheels too.
"""

import atexit
import itertools
import os
import struct
import sys
import threading
import time

NO_MOVE = (0.0, 0.0, 0.0)
NO_TURN = (0.0, 0.0, 0.0, 1.0)
KEPT = []
"""What the threads use until the program ends."""


def in_daemons(action, threads=2):
    """Repeat an action in daemon threads; returns when each thread has done it once."""
    ready = threading.Barrier(threads + 1)

    def run():
        action()
        ready.wait()
        while True:
            action()

    for _ in range(threads):
        threading.Thread(target=run, daemon=True).start()
    ready.wait()


def wait():
    """Lookups with a timeout."""
    import turtlewire

    buffer = turtlewire.Buffer()
    in_daemons(lambda: buffer.can_transform("a", "b", 1, timeout_ns=1_000_000))


def batch():
    """Batches, whose stamps NumPy converts first."""
    import turtlewire

    buffer = turtlewire.Buffer()
    for stamp in range(1, 100):
        buffer.set_transform("a", "b", stamp, NO_MOVE, NO_TURN)
    stamps = list(range(1, 99)) * 20
    in_daemons(lambda: buffer.lookup_transforms("a", "b", stamps))


def intake():
    """Do what the wire's reader thread does for a listener."""
    from turtlewire._native import Intake

    intake = Intake(False, 0, lambda *_: (b"", ""), lambda: None)
    in_daemons(lambda: intake.serve(lambda _: b""))


def expected_message():
    """A message that is waited for: native code calls Python on the wire's thread."""
    from turtlewire import Buffer, msg, wire
    from turtlewire._native import Intake
    from turtlewire.tf.listener import QOS, TYPE_NAME
    from turtlewire.wire.base import TypeId

    called = threading.Event()

    def never_end():
        called.set()
        while True:
            sum(range(2000))

    intake = Intake(False, 0, lambda number, gid_of: (gid_of(number), "me"), never_end)
    buffer = Buffer()
    intake.feed((buffer,))
    intake.expect()
    context = wire.open_context(middleware="rmw_cyclonedds_cpp")
    atexit.unregister(context.close)  # which would wait for the thread
    node = context.create_node(f"exits_{os.getpid()}")
    type_id = TypeId(TYPE_NAME, msg.type_hash(TYPE_NAME))
    publisher = node.create_publisher("/tf", type_id, QOS)
    subscription = node.create_subscription("/tf", type_id, QOS, lambda *_: None, intake)
    cdr = msg.serialize(msg.get_message(TYPE_NAME)())
    while not called.wait(0.01):
        publisher.publish(cdr)
    KEPT.append((context, node, publisher, subscription, buffer))


def change_listener():
    """Data whose arrival runs Python code."""
    import turtlewire

    buffer = turtlewire.Buffer()
    stamps = itertools.count(1)
    buffer.on_change(lambda: sum(range(2000)))
    buffer.on_change(lambda: buffer.can_transform("x", "y", None, timeout_ns=100_000))

    def send():
        head = struct.pack("<IiI", 1, 0, next(stamps))
        frames = struct.pack("<I4sI4sI", 2, b"a", 2, b"b", 0)
        buffer.add_tf_message(b"\0\1\0\0" + head + frames + struct.pack("<7d", *NO_MOVE, *NO_TURN))

    in_daemons(send)


def spin():
    """The usual script: a daemon thread spins, and a timer looks up with a timeout."""
    import rclpy
    import rclpy.time
    import tf2_ros
    from rclpy.duration import Duration

    rclpy.init()
    node = rclpy.create_node(f"exits_{os.getpid()}")  # others like it run at the same time
    buffer = tf2_ros.Buffer()
    tf2_ros.TransformListener(buffer, node)
    asked = threading.Event()

    def look_up():
        asked.set()
        buffer.can_transform("a", "b", rclpy.time.Time(), timeout=Duration(seconds=0.001))

    node.create_timer(0.0005, look_up)
    threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()
    asked.wait()


def spin_and_shutdown():
    """The same, shut down before it ends."""
    import rclpy

    spin()
    rclpy.shutdown()


def publish():
    """Daemon threads that publish, which another one receives."""
    import rclpy
    from rclpy._rclpy_pybind11 import RCLError
    from rclpy.exceptions import InvalidHandle
    from std_msgs.msg import String

    rclpy.init()
    node = rclpy.create_node(f"exits_{os.getpid()}")
    received = threading.Event()
    node.create_subscription(String, "flood", lambda _: received.set(), 10)
    publisher = node.create_publisher(String, "flood", 10)
    threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()

    def send():
        try:
            publisher.publish(String(data="x" * 100))
        except (InvalidHandle, RCLError):
            threading.Event().wait()  # the program has begun to end

    in_daemons(send)
    received.wait()


KINDS = {
    kind.__name__: kind
    for kind in (
        wait,
        batch,
        intake,
        expected_message,
        change_listener,
        spin,
        spin_and_shutdown,
        publish,
    )
}

if __name__ == "__main__":
    KINDS[sys.argv[1]]()
    time.sleep(0.01)  # the threads are in the midst of it
