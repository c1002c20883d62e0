"""Small bags that tests write, and their contents."""

from turtlewire import msg
from turtlewire.bag import BagWriter
from turtlewire.wire.qos import Durability, QoS

SECOND = 1_000_000_000
START = 1_700_000_000 * SECOND


def stamped(message, stamp_ns, frame=""):
    """The message, with a time and a frame in its header."""
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp_ns, SECOND)
    message.header.frame_id = frame
    return message


def transform(i, parent="odom", child="base_link"):
    """A TFMessage of one transform, 10 ms after the one before."""
    made = msg.get_message("geometry_msgs/msg/TransformStamped")(child_frame_id=child)
    made.transform.translation.x, made.transform.rotation.w = 0.01 * i, 1.0
    stamped(made, START + i * 10_000_000, parent)
    return msg.get_message("tf2_msgs/msg/TFMessage")(transforms=[made])


def write_bag(path, count=100, **options):
    """A bag with ``count`` transforms, a static one before them, and a text after each tenth."""
    with BagWriter(path, **options) as writer:
        writer.add_topic(
            "/tf_static",
            "tf2_msgs/msg/TFMessage",
            qos=[QoS(depth=1, durability=Durability.TRANSIENT_LOCAL)],
        )
        writer.add_topic("/tf", "tf2_msgs/msg/TFMessage", qos=[QoS(depth=100)])
        writer.add_topic("/chatter", "std_msgs/msg/String")
        text = msg.get_message("std_msgs/msg/String")
        writer.write("/tf_static", transform(0, "base_link", "camera"), START, START - SECOND)
        for i in range(count):
            log_time = START + i * 10_000_000 + 1_000_000
            writer.write("/tf", transform(i), log_time, log_time - 500_000)
            if i % 10 == 9:
                writer.write("/chatter", text(data=f"number {i}"), log_time + 1)
    return path


def contents(messages):
    """Messages as plain tuples, to compare bags."""
    return [(m.topic, m.type, m.log_time_ns, m.data) for m in messages]
