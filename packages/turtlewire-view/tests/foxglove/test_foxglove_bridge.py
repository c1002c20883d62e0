"""The node `foxglove_bridge` and its launch file, with the parameters of ROS 2's."""

import signal
import socket

import pytest
from tests.places import ROS2

from foxglove_bridge.foxglove_bridge import FoxgloveBridge
from rclpy.context import Context
from rclpy.parameter import Parameter


@pytest.fixture
def bridge():
    """Makes nodes with parameters."""
    context = Context()
    context.init([])
    nodes = []

    def start(**parameters):
        overrides = [
            Parameter(name, value=value) for name, value in {"port": 0, **parameters}.items()
        ]
        nodes.append(FoxgloveBridge(context=context, parameter_overrides=overrides))
        return nodes[-1]

    yield start
    for node in nodes:
        node.destroy_node()
    context.try_shutdown()


def test_the_node_serves_and_its_parameters_count(bridge, client, robot):
    robot.publisher("/camera/_raw")
    node = bridge(topic_whitelist=["/camera/.*"], include_hidden=True, capabilities=["assets"])
    one = client(node)
    assert one.next("serverInfo")["capabilities"] == ["assets"]
    assert one.channel("/camera/_raw")
    assert node.get_parameter("send_buffer_limit").value == 10_000_000
    assert node.get_parameter("num_threads").value == 0


def test_options_without_effect_are_reported(bridge, capfd):
    bridge(num_threads=4, use_compression=True, max_qos_depth=25)
    assert (
        "Parameters without effect here: num_threads, use_compression\n" in capfd.readouterr().err
    )


def test_meshes_of_installed_packages_are_found(bridge, client):
    one = client(bridge(asset_uri_allowlist=["package://.*"]))
    one.send("fetchAsset", uri="package://foxglove_bridge/package.xml", requestId=1)
    assert b"<name>foxglove_bridge</name>" in one.next_binary(4)


@pytest.mark.parametrize(
    ("parameters", "reason"),
    [
        ({"tls": True}, "tls is not supported"),
        ({"port": 70_000}, "port 70000 does not exist"),
        ({"topic_whitelist": ["("]}, r"topic_whitelist '\(' is not a regular expression"),
        ({"capabilities": ["fly"]}, "there is no capability 'fly'; choose from clientPublish"),
    ],
)
def test_wrong_parameters_are_refused(bridge, parameters, reason):
    with pytest.raises(ValueError, match=reason):
        bridge(**parameters)


def test_an_empty_origin_in_a_launch_file_allows_none(bridge, client):
    from websockets.exceptions import InvalidStatus

    node = bridge(origins=[""])
    with pytest.raises(InvalidStatus):
        client(node, origin="https://evil.example")
    client(bridge(origins=["https://my.page"]), origin="https://my.page").sync()


def test_the_launch_file(run, client):
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    launch = ["launch", "foxglove_bridge", "foxglove_bridge_launch.xml"]
    program = run(ROS2, *launch, f"port:={port}", "max_qos_depth:=9")
    url = program.wait_for(rf"connect to (ws://127\.0\.0\.1:{port})$")[0][1]
    one = client(type("Server", (), {"url": url}))
    assert one.channel("/rosout")["schemaName"] == "rcl_interfaces/msg/Log"
    one.send("fetchAsset", uri="package://foxglove_bridge/no.stl", requestId=1)
    assert b"there is no file package://foxglove_bridge/no.stl" in one.next_binary(4)
    second = run(ROS2, *launch, f"port:={port}")
    second.wait_for(rf"foxglove_bridge: port {port} of 127\.0\.0\.1 is in use, perhaps by another")
    second.wait()
    program.signal_group(signal.SIGINT)
    program.wait_for("process has finished cleanly")
    assert program.wait() == 0
