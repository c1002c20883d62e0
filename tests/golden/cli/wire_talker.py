"""The node ``/wire_talker`` of the captures 345 to 401: publishes a message of each kind on ``/w/<name>`` every 0.4 s.

Topics and types are those that capture 401 lists. The messages are those of ``wire/cdr_cases.json``; where that has none, they are what the
capture of the topic shows, and otherwise default ones.
"""

from __future__ import annotations

import json
import re
from pathlib import Path

import yaml

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rosidl_runtime_py import set_message_fields
from tests.golden.cli.captures import capture, captures
from turtlewire.msg import get_message

HERE = Path(__file__).parent


def captured_values() -> dict[str, dict]:
    """What the captures of ``ros2 topic echo`` show, by topic; complete messages only."""
    values = {}
    for case in captures():
        command = re.search(r"^ros2 topic echo --once (.*)(/w/\w+)$", case.command)
        if command is None or {"--csv", "--raw", "--no-arr", "--filter"} & set(command.group(1).split()):
            continue
        shown = yaml.safe_load(case.stdout.split("---\n")[0])
        field = re.search(r"--field (\w+)", command.group(1))
        values[command.group(2)] = {field.group(1): shown} if field else shown
    return values


class WireTalker(Node):
    """Publishes each message, as bytes where they are given."""

    def __init__(self) -> None:
        super().__init__("wire_talker")
        cases = {f"/w/{case['name']}": case for case in json.loads((HERE.parent / "wire" / "cdr_cases.json").read_text(encoding="utf-8"))}
        values = captured_values()
        listed = re.findall(r"^(/w/\w+) \[(\S+)\]$", capture("401_topic_list_hidden2").stdout, re.MULTILINE)
        self._messages = []
        for topic, type_name in listed:
            message = get_message(type_name)()
            if topic in cases:
                payload = bytes.fromhex(cases[topic]["bytes"])
            else:
                set_message_fields(message, values.get(topic) or {})
                payload = message
            self._messages.append((self.create_publisher(type(message), topic, 10), payload))
        self.create_timer(0.4, self._publish)

    def _publish(self) -> None:
        for publisher, payload in self._messages:
            publisher.publish(payload)


def main() -> None:
    rclpy.init()
    try:
        rclpy.spin(WireTalker())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
