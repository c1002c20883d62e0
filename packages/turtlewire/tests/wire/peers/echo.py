"""A process of ours: echoes a topic, answers a service, keeps a latched message.

Ends when its standard input does.
"""

from __future__ import annotations

import sys
import threading

from turtlewire.wire import open_context
from turtlewire.wire.base import ServiceTypes, TypeId
from turtlewire.wire.qos import Durability, QoS

STRING = TypeId("std_msgs/msg/String", "RIHS01_" + "0" * 64)
REQUEST = TypeId("std_srvs/srv/SetBool_Request", "RIHS01_" + "1" * 64)
RESPONSE = TypeId("std_srvs/srv/SetBool_Response", "RIHS01_" + "2" * 64)
SWITCH = ServiceTypes("std_srvs/srv/SetBool", REQUEST, RESPONSE, lambda _: "RIHS01_" + "3" * 64)
HELLO = b"\x00\x01\x00\x00\x06\x00\x00\x00hello\x00\x00\x00"


def main() -> None:
    context = open_context()
    node = context.create_node("echo", "/peer")
    answers = node.create_publisher("/from_peer", STRING, QoS(depth=1000))
    questions = node.create_subscription("/to_peer", STRING, QoS(depth=1000))
    service = node.create_service("/peer/service", SWITCH, QoS())
    latched = node.create_publisher(
        "/latched", STRING, QoS(depth=1, durability=Durability.TRANSIENT_LOCAL)
    )
    latched.publish(HELLO)
    wait_set = context.create_wait_set()
    wait_set.attach(questions)
    wait_set.attach(service)
    ended = threading.Event()

    def wait_for_the_end() -> None:
        sys.stdin.read()
        ended.set()
        wait_set.wake()

    threading.Thread(target=wait_for_the_end, daemon=True).start()
    print("ready", flush=True)
    while not ended.is_set():
        wait_set.wait()
        for data, _ in questions.take():
            answers.publish(data)
        for request_id, request in service.take():
            service.send_response(request_id, request)
    context.close()


main()
