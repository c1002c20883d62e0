"""Parameters between two nodes: services, client, events; and the other services of a node."""

import json
from types import SimpleNamespace

import pytest
from tests.places import GOLDEN

from rcl_interfaces.msg import LoggerLevel, ParameterDescriptor, ParameterValue
from rcl_interfaces.msg import Parameter as ParameterMsg
from rcl_interfaces.srv import GetLoggerLevels, SetLoggerLevels, SetParameters
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.impl import log_levels
from rclpy.node import Node
from rclpy.parameter import Parameter, parameter_value_to_python
from rclpy.parameter_client import AsyncParameterClient
from rclpy.parameter_event_handler import ParameterEventHandler
from rclpy.qos import QoSProfile
from turtlewire import msg
from type_description_interfaces.srv import GetTypeDescription


@pytest.fixture
def server(context, executor):
    server = Node("server", namespace="/ns", context=context, enable_logger_service=True)
    executor.add_node(server)
    return server


@pytest.fixture
def asker(context, executor):
    asker = Node("asker", namespace="/ns", context=context, start_parameter_services=False)
    executor.add_node(asker)
    return asker


@pytest.fixture
def result(executor):
    """Spins until a future is done, and gives its result."""

    def result(future):
        executor.spin_until_future_complete(future, timeout_sec=60)
        assert future.done()
        return future.result()

    return result


@pytest.fixture
def ask(server, asker, result):
    """Calls a service of the server."""

    def ask(service_type, name, request):
        client = asker.create_client(service_type, name)
        assert client.wait_for_service(timeout_sec=60)
        return result(client.call_async(request))

    return ask


@pytest.fixture
def client(server, asker):
    client = AsyncParameterClient(asker, "server")
    assert client.wait_for_services(timeout_sec=60)
    assert client.services_are_ready()
    return client


def test_all_services_share_one_timeout(asker, monkeypatch):
    client = AsyncParameterClient(asker, "server")
    now, waits = [100.0], []

    class Slow:
        def wait_for_service(self, timeout_sec):
            waits.append(timeout_sec)
            now[0] += 4.0
            return True

    monkeypatch.setattr(client, "_clients", lambda: [Slow()] * 4)
    monkeypatch.setattr("rclpy.parameter_client.time", SimpleNamespace(monotonic=lambda: now[0]))
    assert client.wait_for_services(timeout_sec=10.0)
    assert waits == [10.0, 6.0, 2.0, 0.0]
    assert client.wait_for_services()
    assert waits[4:] == [None] * 4


def test_get(server, result, client):
    server.declare_parameters("", [("a", 1), ("b", "x"), ("unset", Parameter.Type.INTEGER)])
    response = result(client.get_parameters(["a", "b"]))
    assert [parameter_value_to_python(value) for value in response.values] == [1, "x"]
    assert result(client.get_parameters(["a", "nope"])).values == []
    assert result(client.get_parameters(["unset"])).values == []


def test_types_lists_descriptions(server, result, client):
    server.declare_parameter("group.a", 1, ParameterDescriptor(description="text"))
    assert list(result(client.get_parameter_types(["group.a", "use_sim_time"])).types) == [
        2,
        1,
    ]
    assert list(result(client.get_parameter_types(["group.a", "nope"])).types) == []
    listed = result(client.list_parameters(["group"], 0)).result
    assert (listed.names, listed.prefixes) == (["group.a"], ["group"])
    assert sorted(result(client.list_parameters()).result.names) == [
        "group.a",
        "start_type_description_service",
        "use_sim_time",
    ]
    described = result(client.describe_parameters(["group.a"])).descriptors
    assert [(each.name, each.type, each.description) for each in described] == [
        ("group.a", 2, "text")
    ]
    one_unknown = client.describe_parameters(["group.a", "nope"])
    assert list(result(one_unknown).descriptors) == []  # as ROS 2 does


def test_set(server, result, spin_until, client):
    server.declare_parameters("", [("a", 1), ("b", 1)])
    done = []
    results = result(
        client.set_parameters(
            [Parameter("a", value=2), Parameter("b", value="x").to_parameter_msg()],
            callback=done.append,
        )
    ).results
    assert [(each.successful, each.reason) for each in results] == [
        (True, ""),
        (False, "Wrong parameter type, expected 'Type.INTEGER' got 'Type.STRING'"),
    ]
    spin_until(lambda: len(done) == 1)
    result = result(
        client.set_parameters_atomically([Parameter("a", value=3), Parameter("nope", value=1)])
    ).result
    assert (result.successful, result.reason) == (
        False,
        "Invalid access to undeclared parameter(s): []",
    )
    assert server.get_parameter("a").value == 2


def test_delete(server, result, client):
    server.declare_parameter("a", 1, ParameterDescriptor(dynamic_typing=True))
    (outcome,) = result(client.delete_parameters(["a"])).results
    assert outcome.successful
    assert not server.has_parameter("a")
    (outcome,) = result(client.delete_parameters(["use_sim_time"])).results
    assert outcome.reason == "Static parameter cannot be undeclared"


def test_load_files(server, result, client, tmp_path):
    server.declare_parameters("", [("a", 1), ("b.c", 1.0)])
    path = tmp_path / "f.yaml"
    path.write_text("server:\n  ros__parameters:\n    a: 5\n    b: {c: 2.5}\n")
    assert [each.successful for each in result(client.load_parameter_file(str(path))).results] == [
        True,
        True,
    ]
    assert (server.get_parameter("a").value, server.get_parameter("b.c").value) == (
        5,
        2.5,
    )
    assert result(client.load_parameter_file_atomically(str(path))).result.successful


def test_an_unknown_type_number_is_answered_with_an_error(ask):
    """What a broken peer might send: the node says no, and lives."""
    request = SetParameters.Request(
        parameters=[ParameterMsg(name="use_sim_time", value=ParameterValue(type=77))]
    )
    (outcome,) = ask(SetParameters, "server/set_parameters", request).results
    assert not outcome.successful
    assert "77" in outcome.reason


def test_parameter_events(server, asker, spin_until):
    handler = ParameterEventHandler(asker)
    calls = []
    server.declare_parameter("a", 0)
    one = handler.add_parameter_callback(
        "a", "server", lambda parameter: calls.append(("a", parameter.value.integer_value))
    )
    handler.add_parameter_callback("a", "/other", lambda parameter: calls.append("other node"))
    everything = handler.add_parameter_event_callback(lambda event: calls.append(event.node))
    server.set_parameters([Parameter("a", value=1)])
    spin_until(lambda: ("a", 1) in calls)
    handler.remove_parameter_callback(one)
    handler.remove_parameter_event_callback(everything)
    calls.clear()
    done = []
    handler.add_parameter_callback("a", "/ns/server", done.append)
    server.set_parameters([Parameter("a", value=2)])
    spin_until(lambda: done)
    assert calls == []
    for remove, handle in (
        (handler.remove_parameter_callback, one),
        (handler.remove_parameter_event_callback, everything),
    ):
        with pytest.raises(RuntimeError, match=r"^Callback doesn't exist$"):
            remove(handle)
    handler.destroy()


def test_logger_levels(ask):
    log_levels.reset()
    try:
        request = SetLoggerLevels.Request(
            levels=[LoggerLevel(name="ns.server", level=10), LoggerLevel(name="x", level=11)]
        )
        results = ask(SetLoggerLevels, "server/set_logger_levels", request).results
        assert [(each.successful, each.reason) for each in results] == [
            (True, ""),
            (False, "Failed reason: Invalid logger level."),
        ]
        response = ask(
            GetLoggerLevels,
            "server/get_logger_levels",
            GetLoggerLevels.Request(names=["ns.server", "x"]),
        )
        assert [(each.name, each.level) for each in response.levels] == [
            ("ns.server", 10),
            ("x", 0),
        ]
    finally:
        log_levels.reset()


@pytest.mark.parametrize("type_name", ["geometry_msgs/msg/TransformStamped", "turtlesim/srv/Spawn"])
def test_type_descriptions(ask, type_name):
    request = GetTypeDescription.Request(
        type_name=type_name, type_hash=msg.type_hash(type_name), include_type_sources=True
    )
    response = ask(GetTypeDescription, "server/get_type_description", request)
    assert response.successful
    assert response.type_description.type_description.type_name == type_name
    described = {
        each.type_name: each for each in response.type_description.referenced_type_descriptions
    }
    assert list(described) == sorted(described)
    fields = json.loads((GOLDEN / "wire" / "interface_fields.json").read_text())
    for name, description in described.items():
        if fields.get(name):
            assert [field.name for field in description.fields] == list(fields[name])
    assert response.type_sources[0].encoding == type_name.split("/")[1]
    assert response.type_sources[0].raw_file_contents


def test_unknown_type_descriptions(ask):
    for type_name, type_hash, why in (
        ("geometry_msgs/msg/Twist", "nonsense", "Failed to parse type hash"),
        (
            "geometry_msgs/msg/Twist",
            msg.type_hash("geometry_msgs/msg/Pose"),
            "Type not currently in use by this node",
        ),
        (
            "no_msgs/msg/Nope",
            msg.type_hash("geometry_msgs/msg/Pose"),
            "Type not currently in use by this node",
        ),
    ):
        request = GetTypeDescription.Request(type_name=type_name, type_hash=type_hash)
        response = ask(GetTypeDescription, "server/get_type_description", request)
        assert (response.successful, response.failure_reason) == (False, why)


def test_overrides_of_the_command_line_and_the_constructor(context):
    words = [
        "--ros-args",
        "-r",
        "__node:=renamed",
        "-p",
        "renamed:a:=5",
        "-p",
        "b:=6",
        "-p",
        "c:=[1, 2]",
    ]
    node = Node(
        "original",
        context=context,
        cli_args=words,
        parameter_overrides=[Parameter("b", value=60)],
        automatically_declare_parameters_from_overrides=True,
    )
    values = {name: node.get_parameter(name).value for name in "abc"}
    assert values == {"a": 5, "b": 60, "c": [1, 2]}


def test_the_type_description_service_can_be_left_out(context):
    node = Node(
        "quiet",
        context=context,
        cli_args=["--ros-args", "-p", "start_type_description_service:=false"],
    )
    assert node.get_parameter("start_type_description_service").value is False
    names = [name for name, _ in node.get_service_names_and_types_by_node("quiet", "/")]
    assert "/quiet/get_parameters" in names
    assert "/quiet/get_type_description" not in names


def test_the_client_hears_of_parameter_events(server, spin_until, client):
    events, raw = [], []
    group = ReentrantCallbackGroup()
    subscription = client.on_parameter_event(events.append, callback_group=group)
    assert subscription.callback_group is group
    client.on_parameter_event(raw.append, QoSProfile(depth=10), raw=True)
    server.declare_parameter("a", 1)
    spin_until(lambda: events and raw)
    assert [parameter.name for parameter in events[0].new_parameters] == ["a"]
    assert isinstance(raw[0], bytes)


def test_the_options_of_a_handlers_subscription(server, asker, spin_until):
    group, events = ReentrantCallbackGroup(), []
    handler = ParameterEventHandler(asker, QoSProfile(depth=10), group, raw=True)
    assert handler.parameter_event_subscription.callback_group is group
    handler.add_parameter_event_callback(events.append)
    handler.add_parameter_callback("a", "server", events.append)
    server.declare_parameter("a", 1)
    spin_until(lambda: events)
    assert [type(event) for event in events] == [bytes]
