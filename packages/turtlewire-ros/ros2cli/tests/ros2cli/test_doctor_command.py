"""`ros2 doctor`: findings and the report."""

from __future__ import annotations

import os

import pytest

from ros2cli.main import main
from turtlewire import msg
from turtlewire.wire import open_context
from turtlewire.wire.base import TypeId
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


def test_the_report_has_facts(capsys):
    context = open_context()
    try:
        kind = TypeId("std_msgs/msg/String", msg.type_hash("std_msgs/msg/String"))
        context.create_node("talker").create_publisher("/chatter", kind, QoS())
        assert main(["doctor", "--report"]) == 0
    finally:
        context.close()
    lines = capsys.readouterr().out.splitlines()
    assert [line for line in lines if line.startswith("   ")] == [
        "   PLATFORM INFORMATION",
        "   RMW MIDDLEWARE",
        "   ROS 2 INFORMATION",
        "   TOPIC LIST",
    ]
    assert f"domain            : {os.environ['ROS_DOMAIN_ID']}" in lines
    assert lines[-3:] == [
        "topic            : /chatter",
        "publisher count  : 1",
        "subscriber count : 0",
    ]
