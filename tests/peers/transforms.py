"""A real node on /tf, for test_transforms: run by the Python of scripts/peers.

`transforms.py send COUNT` sends a transform every millisecond as soon as a subscription matches;
`transforms.py receive COUNT` prints how many transforms have arrived, once the last one has. The
wheels have no tf2_msgs, so the messages stay serialized here.
"""

import ctypes
import struct
import sys
import time

import rclpy
import rclpy.task
from geometry_msgs.msg import TransformStamped
from rclpy.duration import Duration
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.qos import QoSProfile

SECOND, MILLISECOND = 1_000_000_000, 1_000_000
#: So deep that nothing is lost while a busy computer stops one of the nodes.
QOS = QoSProfile(depth=10_000)
#: The encapsulation, the number of transforms and the stamp.
HEAD = struct.Struct("<4sIiI")
#: Two names and seven numbers, aligned.
REST = struct.pack("<I8sI12s7d", 6, b"world", 6, b"robot", 1, 2, 3, 0, 0, 0, 1)


FAST_DDS = b"rosidl_typesupport_fastrtps_c"
Find = ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.c_void_p, ctypes.c_char_p)


class Handle(ctypes.Structure):
    """The type support of a message, ``rosidl_message_type_support_t``."""

    _fields_ = [
        ("identifier", ctypes.c_char_p),
        ("callbacks", ctypes.c_void_p),
        ("find", Find),
        ("descriptions", ctypes.c_void_p * 3),
    ]


class Callbacks(ctypes.Structure):
    """The type as Fast DDS knows it, ``message_type_support_callbacks_t``."""

    _fields_ = [
        ("namespace", ctypes.c_char_p),
        ("name", ctypes.c_char_p),
        ("functions", ctypes.c_void_p * 5),
    ]


Model = type(TransformStamped)
Model.__import_type_support__()
read_capsule = ctypes.pythonapi.PyCapsule_GetPointer
read_capsule.argtypes, read_capsule.restype = [ctypes.py_object, ctypes.c_void_p], ctypes.c_void_p
make_capsule = ctypes.pythonapi.PyCapsule_New
make_capsule.argtypes, make_capsule.restype = [ctypes.c_void_p] * 3, ctypes.py_object

# TFMessage is announced under its own name with the functions of TransformStamped. They would
# convert messages, and are not called for bytes.
model = Handle.from_address(read_capsule(Model._TYPE_SUPPORT, None))
for_fast_dds = Handle.from_buffer_copy(
    Handle.from_address(model.find(ctypes.addressof(model), FAST_DDS))
)
callbacks = Callbacks.from_buffer_copy(Callbacks.from_address(for_fast_dds.callbacks))
callbacks.namespace, callbacks.name = b"tf2_msgs::msg", b"TFMessage"
for_fast_dds.callbacks = ctypes.addressof(callbacks)


@Find
def find(_, identifier):
    if identifier == FAST_DDS:
        return ctypes.addressof(for_fast_dds)
    return model.find(ctypes.addressof(model), identifier)


handle = Handle.from_buffer_copy(model)
handle.find = find


class SerializedType(Model):
    """The class of TFMessage."""

    _TYPE_SUPPORT = make_capsule(ctypes.addressof(handle), None, None)


class TFMessage(TransformStamped, metaclass=SerializedType):
    """A message that rclpy sends and receives as bytes."""


def transform(number):
    return HEAD.pack(b"\0\1\0\0", 1, *divmod(number * MILLISECOND, SECOND)) + REST


def send(node, count):
    matched = rclpy.task.Future()
    events = PublisherEventCallbacks(matched=matched.set_result)
    publisher = node.create_publisher(TFMessage, "tf", QOS, event_callbacks=events)
    rclpy.spin_until_future_complete(node, matched)
    # A subscription on Cyclone DDS may skip what was sent before its first heartbeat.
    publisher.publish(transform(1))
    print("acknowledged:", publisher.wait_for_all_acked(Duration(seconds=30)), flush=True)
    start = time.monotonic_ns()
    for number in range(1, count + 1):
        time.sleep(max(0, start + number * MILLISECOND - time.monotonic_ns()) / SECOND)
        publisher.publish(transform(number))
    print("sent in", (time.monotonic_ns() - start) / SECOND, "s", flush=True)
    rclpy.spin(node)  # until it is killed, to send again what is missing


def receive(node, count):
    stamps = set()

    def on_message(data):
        seconds, nanoseconds = HEAD.unpack_from(data)[2:]
        stamps.add((seconds * SECOND + nanoseconds) // MILLISECOND)
        if count in stamps:
            print("received", len(stamps), flush=True)

    def on_matched(status):
        print("publishers of /tf:", status.current_count, flush=True)

    events = SubscriptionEventCallbacks(matched=on_matched)
    node.create_subscription(TFMessage, "tf", on_message, QOS, raw=True, event_callbacks=events)
    rclpy.spin(node)


rclpy.init()
kind, number = sys.argv[1:]
{"send": send, "receive": receive}[kind](rclpy.create_node("peer"), int(number))
