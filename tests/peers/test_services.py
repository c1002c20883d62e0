"""No request of ours ever reaches a server on Fast DDS, and each command says why.

Such a server reads the 16 bytes in front of the fields as fields. The node then allocates gigabytes
or never answers again.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import rclpy
from turtlewire import msg
from turtlewire.errors import UncallableServiceError
from turtlewire.wire import report
from turtlewire.wire.base import ServiceTypes, TypeId
from turtlewire.wire.qos import QoS
from turtlewire.wire.services import RequestId, join_header

pytestmark = pytest.mark.slow

LONG = 60_000_000_000
MOST_RSS_KB = 200_000
ADVICE = (
    "Start the {} with RMW_IMPLEMENTATION=rmw_cyclonedds_cpp, or both ends with "
    "RMW_IMPLEMENTATION=rmw_zenoh_cpp."
)
LIST = "/peer/list_parameters"
COMMANDS = [
    (["param", "list"], LIST),
    (["param", "list", "/peer"], LIST),
    (["param", "get", "/peer", "speed"], "/peer/get_parameters"),
    (["param", "set", "/peer", "speed", "2.0"], "/peer/set_parameters"),
    (["param", "describe", "/peer", "speed"], "/peer/describe_parameters"),
    (["param", "delete", "/peer", "speed"], "/peer/set_parameters"),
    (["param", "dump", "/peer"], LIST),
    (["lifecycle", "get"], "/peer/get_state"),
    (["lifecycle", "get", "/peer"], "/peer/get_state"),
    (["service", "call", "/echo", "test_msgs/srv/BasicTypes"], "/echo"),
    (
        ["action", "send_goal", "/fibonacci", "test_msgs/action/Fibonacci", "{order: 3}"],
        "/fibonacci/_action/send_goal",
    ),
]


def reason(service):
    return (
        f"service {service} is not called: its server runs on Fast DDS (rmw_fastrtps_cpp), "
        "which would misread our requests"
    )


def most_rss_kb(process):
    status = Path(f"/proc/{process.pid}/status").read_text()
    return int(re.search(r"VmHWM:\s*(\d+) kB", status)[1])


def assert_sound(peer, real):
    """The node was not harmed: it got none of our requests, and answers those of a real client."""
    client = real("client", "3")
    assert client.wait() == 0, client.text
    assert re.findall(r"answer: (\w+)", client.text) == ["0", "1", "2"]
    assert re.findall(r"called (-?\d+)", peer.text) == ["0", "1", "2"]
    assert "rror" not in peer.text
    assert most_rss_kb(peer.process) < MOST_RSS_KB


@pytest.fixture
def echo(venv, monkeypatch):
    """The wire's types of test_msgs/srv/BasicTypes, and its class."""
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(venv))
    name = "test_msgs/srv/BasicTypes"
    request, response = (
        TypeId(f"{name}_{part}", msg.type_hash(f"{name}_{part}"))
        for part in ("Request", "Response")
    )
    return ServiceTypes(name, request, response, msg.type_hash), msg.get_service(name)


def test_each_command_says_why_and_does_no_harm(peer, real, command):
    for words, service in COMMANDS:
        status, text = command("ros2", *words)
        assert status == 1, text
        assert reason(service) in text
        assert ADVICE.format("server") in text
    assert_sound(peer, real)


def test_not_even_a_request_sent_at_the_moment_of_discovery_is_read(peer, real, context, echo):
    types, service = echo
    client = context.create_node("ours").create_client("/echo", types, QoS())
    assert context.graph.wait_for(lambda: client.requests.subscription_count() == 1, LONG)
    assert not client.is_ready()
    cdr = msg.serialize(service.Request(int64_value=7, string_value="y" * 100))
    with pytest.raises(UncallableServiceError, match=re.escape(reason("/echo"))):
        client.send_request(cdr)
    for number in range(10):  # as a thread does that looked before the server matched
        client.requests.publish(join_header(RequestId(client.client_id, number), cdr))
    assert_sound(peer, real)


def test_a_server_that_would_understand_does_not_make_the_service_callable(peer, context, echo):
    types, service = echo
    node = context.create_node("ours")
    client = node.create_client("/echo", types, QoS())
    server = node.create_service("/echo", types, QoS())
    graph = context.graph
    assert graph.wait_for(lambda: client.requests.subscription_count() == 2, LONG)
    assert not client.is_ready()
    cdr = msg.serialize(service.Request())
    with pytest.raises(UncallableServiceError):
        client.send_request(cdr)
    assert server.take() == []
    peer.process.terminate()
    assert graph.wait_for(client.is_ready, LONG)
    assert graph.wait_for(lambda: graph.foreign_servers() == [], LONG)
    client.send_request(cdr)
    wait_set = context.create_wait_set()
    wait_set.attach(server)
    assert wait_set.wait(LONG) == [server]
    ((_, request),) = server.take()
    assert msg.deserialize(service.Request, request) == service.Request()


def test_requests_of_clients_on_fast_dds_are_dropped_with_one_line(
    real, context, echo, capfd, monkeypatch
):
    monkeypatch.setattr(report, "_said", set())
    server = context.create_node("ours").create_service("/echo", echo[0], QoS())
    wait_set = context.create_wait_set()
    wait_set.attach(server)
    client = real("client", "2")
    client.wait_for("server: True")
    assert wait_set.wait(LONG) == [server]
    assert server.take() == []
    client.wait()
    assert server.take() == []
    assert re.findall(r"answer: (\w+)", client.text) == ["None", "None"]
    said = capfd.readouterr().err
    assert said.count("dropped a request of service /echo: its client runs on Fast DDS") == 1
    assert ADVICE.format("client") in said


def test_rclpy_logs_why_it_waits_and_its_futures_fail(peer, echo, capfd):
    with rclpy.init():
        node = rclpy.create_node("ours")
        client = node.create_client(echo[1], "echo")
        said = ""
        while not said:
            assert not client.wait_for_service(timeout_sec=1.0)
            said = capfd.readouterr().err
        assert said.count(f"{reason('/echo')}. {ADVICE.format('server')}") == 1
        assert not client.wait_for_service(timeout_sec=0.1)
        future = client.call_async(echo[1].Request())
        assert isinstance(future.exception(), UncallableServiceError)
        with pytest.raises(UncallableServiceError):
            client.call(echo[1].Request())
        assert capfd.readouterr().err == ""


def test_node_info_and_doctor_tell_what_cannot_be_called(peer, command):
    status, text = command("ros2", "node", "info", "/peer")
    assert status == 0
    assert "    /echo: test_msgs/srv/BasicTypes\n" in text
    assert (
        "The services of /peer, including parameters and actions, cannot be called from here: it "
        f"runs on Fast DDS (rmw_fastrtps_cpp). {ADVICE.format('node')}"
    ) in text
    status, text = command("turtlewire", "doctor")
    assert re.search(
        r"note: The \d+ services of nodes on Fast DDS \(rmw_fastrtps_cpp\) cannot be called from "
        r"here, including parameters and actions; topics work. Nodes: /peer.\n"
        rf"    {ADVICE.format('nodes')}",
        text,
    )
