"""A real node that sends messages back, for test_types: run by the Python of scripts/peers.

`echo.py TYPE ...` prints the fields of each message that comes on /ours_0, /ours_1, ..., one topic
for each type, and sends it back on /theirs_0, /theirs_1, ...
"""

import functools
import importlib
import json
import sys

from fields import fields

import rclpy
from rclpy.qos import DurabilityPolicy, QoSProfile

#: Messages wait for subscriptions that are found later.
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def send_back(type_name, publisher, message):
    print(type_name, json.dumps(fields(message)), flush=True)
    publisher.publish(message)


rclpy.init()
node = rclpy.create_node("peer")
for number, name in enumerate(sys.argv[1:]):
    package, kind, class_name = name.split("/")
    message_class = getattr(importlib.import_module(f"{package}.{kind}"), class_name)
    back = node.create_publisher(message_class, f"theirs_{number}", LATCHED)
    node.create_subscription(
        message_class, f"ours_{number}", functools.partial(send_back, name, back), LATCHED
    )
rclpy.spin(node)
