"""Publishes each line of its input to the peer ``echo.py`` and prints what comes back.

It also prints how many peers each of its ends has, at the start and whenever the graph changes.
Ends with its input.
"""

from __future__ import annotations

import sys
import threading

from turtlewire.wire import open_context
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import History, QoS

STRING = TypeId("std_msgs/msg/String", "RIHS01_" + "0" * 64)
KEEP = QoS(history=History.KEEP_ALL)
said = threading.Lock()


def say(text: str) -> None:
    with said:
        print(text, flush=True)


def text_of(data: bytes) -> str:
    return data[8:].rstrip(b"\x00").decode()


context = open_context()
node = context.create_node("asker")
answers = node.create_subscription("/from_peer", STRING, KEEP, lambda data, _: say(text_of(data)))
questions = node.create_publisher("/to_peer", STRING, KEEP)


def say_peers() -> None:
    say(f"peers {questions.subscription_count()} {answers.publisher_count()}")


context.graph.add_listener(say_peers)
say_peers()  # they may have met before
for line in sys.stdin:
    body = line.strip().encode() + b"\x00"
    questions.publish(b"\x00\x01\x00\x00" + len(body).to_bytes(4, "little") + body)
context.close()
