"""`ros2 doctor`: findings and the report."""

import os

import pytest

from ros2cli.main import main
from turtlewire import msg
from turtlewire.wire import open_context
from turtlewire.wire.base import ServiceTypes, TypeId
from turtlewire.wire.qos import QoS


@pytest.mark.parametrize("name", ["doctor", "wtf"])
def test_an_empty_domain_of_this_host_is_no_problem(capsys, name):
    assert main([name, "--report-failed"]) == 0
    first, *others = capsys.readouterr().out.splitlines()
    assert first.startswith("All is well: middleware ")
    nobody = f"note: No nodes found in domain {os.environ['ROS_DOMAIN_ID']} on this host."
    assert nobody in others


def test_notes_fail_only_on_request(capsys):
    context = open_context()
    try:
        context.create_node("alone")
        assert main(["doctor"]) == 0
        assert "\nnote: No node publishes transforms." in capsys.readouterr().out
        assert main(["doctor", "--include-warnings"]) == 1
    finally:
        context.close()


def test_the_report_has_facts(capsys, monkeypatch):
    monkeypatch.setenv("RCUTILS_COLORIZED_OUTPUT", "1")
    context = open_context()
    try:
        kind = TypeId("std_msgs/msg/String", msg.type_hash("std_msgs/msg/String"))
        node = context.create_node("talker")
        node.create_publisher("/chatter", kind, QoS())
        name = "turtlesim/action/RotateAbsolute_FeedbackMessage"
        node.create_publisher("/turn/_action/feedback", TypeId(name, msg.type_hash(name)), QoS())
        name = "std_srvs/srv/Empty"
        parts = [
            TypeId(part, msg.type_hash(part)) for part in (f"{name}_Request", f"{name}_Response")
        ]
        node.create_client("/clear", ServiceTypes(name, *parts, msg.type_hash), QoS())
        assert main(["doctor", "--report"]) == 0
    finally:
        context.close()
    lines = capsys.readouterr().out.splitlines()
    assert [line for line in lines if line.startswith("   ")] == [
        "   PLATFORM INFORMATION",
        "   NETWORK CONFIGURATION",
        "   RMW MIDDLEWARE",
        "   ROS 2 INFORMATION",
        "   ROS ENVIRONMENT",
        "   TOPIC LIST",
        "   SERVICE LIST",
        "   ACTION LIST",
        "   QOS COMPATIBILITY LIST",
    ]
    assert f"domain            : {os.environ['ROS_DOMAIN_ID']}" in lines
    assert "rcutils environment variables : RCUTILS_COLORIZED_OUTPUT=1" in lines
    start = lines.index("   TOPIC LIST")
    assert lines[start + 1 :] == [
        "topic            : /chatter",
        "publisher count  : 1",
        "subscriber count : 0",
        "",
        "   SERVICE LIST",
        "service       : /clear",
        "service count : 0",
        "client count  : 1",
        "",
        "   ACTION LIST",
        "action              : /turn",
        "action server count : 1",
        "action client count : 0",
        "",
        "   QOS COMPATIBILITY LIST",
        "compatibility status : No publisher/subscriber pairs found",
        "",
        "=" * 80,
        "!!! WARNING !!!",
        "The report includes all ROS 2 endpoint information and system platform information.",
        "Please review the report before sharing, as it may contain sensitive or private data.",
        "=" * 80,
    ]
