"""`ros2 service echo` with a service that has introspection on."""

from __future__ import annotations

import sys

import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.qos import qos_profile_services_default
from rclpy.service_introspection import ServiceIntrospectionState
from ros2cli.main import main

ROS2 = (
    sys.executable,
    "-c",
    "import sys; from ros2cli.main import main; sys.exit(main(sys.argv[1:]))",
)


def add(request, response):
    response.sum = request.a + request.b
    return response


def test_events_of_a_call(run):
    with rclpy.init(args=[]) as context:
        node = rclpy.create_node("adder")
        service = node.create_service(AddTwoInts, "add", add)
        service.configure_introspection(
            node.get_clock(), qos_profile_services_default, ServiceIntrospectionState.CONTENTS
        )
        client = node.create_client(AddTwoInts, "add")
        echo = run(*ROS2, "service", "echo", "/add")
        assert context.wait_for_graph(
            lambda: service._events.wire.subscription_count() == 1, 30_000_000_000
        )
        rclpy.spin_until_future_complete(
            node, client.call_async(AddTwoInts.Request(a=5, b=6)), timeout_sec=60
        )
        echo.wait_for("^---$", count=2)
        lines = echo.text.splitlines()
    assert lines[:2] == ["info:", "  event_type: REQUEST_RECEIVED"]
    assert [line for line in lines if "event_type" in line] == [
        "  event_type: REQUEST_RECEIVED",
        "  event_type: RESPONSE_SENT",
    ]
    received, sent = (part.rstrip("\n") for part in echo.text.removesuffix("---").split("---\n"))
    assert received.endswith("request:\n- a: 5\n  b: 6\nresponse: []")
    assert sent.endswith("request: []\nresponse:\n- sum: 11")


def test_without_introspection_there_is_a_word_of_advice(run):
    echo = run(*ROS2, "service", "echo", "/nothing", "example_interfaces/srv/AddTwoInts")
    echo.wait_for(
        "^No publishers on topic '/nothing/_service_event'; is service introspection on the "
        "client or server enabled\\?$"
    )


def test_unechoable_topics_are_rejected(run, capsys):
    unknown = run(*ROS2, "service", "echo", "/nothing")
    assert (unknown.wait(), unknown.text) == (1, "Could not load the type for the passed service")
    assert main(["service", "echo", "/add", "no/srv/Such"]) == 1
    assert capsys.readouterr().err == "The service type 'no/srv/Such' is invalid\n"
