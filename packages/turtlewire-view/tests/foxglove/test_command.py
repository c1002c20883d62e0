"""`turtlewire foxglove`: its words, its address, and its end.

docs/how-to/foxglove.md does what it says.

The node `foxglove_bridge` and its launch file, with the parameters of ROS 2's.
"""

import json
import re
import shlex
import signal
import socket
import sys

import pytest
from tests.how_to import blocks_of
from tests.places import BIN, HOW_TO, ROS2, TURTLEWIRE
from websockets.sync.client import connect

from foxglove_bridge.foxglove_bridge import FoxgloveBridge
from rclpy.context import Context
from rclpy.parameter import Parameter
from turtlewire.wire.qos import Durability


@pytest.fixture
def foxglove(run):
    def start(*words, **options):
        return run(TURTLEWIRE, "foxglove", *words, **options)

    return start


def test_it_tells_its_address_serves_and_ends_at_ctrl_c(foxglove):
    program = foxglove("--port", "0", terminal=True)
    url = program.wait_for(r"connect to (ws://127\.0\.0\.1:\d+) \(Ctrl-C ends\)")[0][1]
    with connect(url, subprotocols=["foxglove.websocket.v1"]) as client:
        assert '"serverInfo"' in client.recv()
        program.wait_for(r"client 127\.0\.0\.1:\d+ connected \(foxglove\.websocket\.v1\)")
        program.type("\x03")
        assert program.wait() == 130
    assert "Traceback" not in program.text


def test_files_of_a_named_package_are_served(foxglove, tmp_path):
    (tmp_path / "tip.stl").write_text("tip")
    program = foxglove("--port", "0", "--package", f"arm={tmp_path}")
    url = program.wait_for(r"connect to (ws://127\.0\.0\.1:\d+) ")[0][1]
    with connect(url, subprotocols=["foxglove.websocket.v1"]) as client:
        uri = "package://arm/tip.stl"
        client.send(json.dumps({"op": "fetchAsset", "uri": uri, "requestId": 7}))
        answer = next(each for each in client if isinstance(each, bytes) and each[0] == 4)
    assert answer.endswith(b"tip")
    program.process.send_signal(signal.SIGTERM)
    assert program.wait() == 0


def test_sigterm_ends_it_cleanly_although_a_client_does_not_answer(foxglove):
    program = foxglove("--port", "0")
    port = int(program.wait_for(r"ws://127\.0\.0\.1:(\d+) ")[0][1])
    with socket.create_connection(("127.0.0.1", port)) as silent:
        silent.sendall(
            b"GET / HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            b"Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\nSec-WebSocket-Version: 13\r\n"
            b"Sec-WebSocket-Protocol: foxglove.sdk.v1\r\n\r\n"
        )
        program.wait_for("connected")
        program.signal_group(signal.SIGTERM)
        assert program.wait() == 0
    assert "Traceback" not in program.text


def test_a_port_in_use_is_named_with_the_way_out(foxglove):
    with socket.create_server(("127.0.0.1", 0)) as other:
        port = other.getsockname()[1]
        program = foxglove("--port", port)
        assert program.wait() == 2
    assert program.text == (
        f"turtlewire foxglove: port {port} of 127.0.0.1 is in use, perhaps by another Foxglove "
        "server.\n--port N uses another port, --port 0 a free one."
    )


@pytest.mark.parametrize(
    ("words", "answer"),
    [
        (["--port", "99999"], "port 99999 does not exist: ports are 0 (a free one) to 65535"),
        (["--port", "x"], "argument --port: invalid int value: 'x'"),
        (["--topic", "("], "topic_whitelist '(' is not a regular expression: missing )"),
        (["--send-buffer-limit", "0"], "send_buffer_limit is at least 1 byte, got 0"),
        (["--topics", "x"], "Did you mean: --topic"),
        (
            ["--address", "no.such.host.invalid"],
            "cannot listen on no.such.host.invalid, port 8765: ",
        ),
        (["--address", "192.0.2.1"], "cannot listen on 192.0.2.1, port 8765: "),
        (["extra"], "unrecognized arguments: extra"),
    ],
)
def test_wrong_words(foxglove, words, answer):
    program = foxglove(*words)
    assert program.wait() == 2
    assert answer in program.text
    assert "Traceback" not in program.text


def test_an_address_for_others_is_said_plainly(foxglove):
    program = foxglove("--port", "0", "--address", "0.0.0.0", "--read-only")
    program.wait_for(r"^Anyone who can reach 0\.0\.0\.0 can read all topics\.$")
    program.signal_group(signal.SIGINT)
    assert program.wait() == 130
    program = foxglove("--port", "0", "--address", "::")
    program.wait_for(r"connect to ws://\[::\]:\d+ ")
    program.wait_for(r"^Anyone who can reach :: can read all topics, publish, call services\.$")


def test_without_a_network_it_says_so(foxglove):
    program = foxglove("--port", "0", environment={"ROS_DOMAIN_ID": "9999"})
    assert program.wait() == 2
    assert "turtlewire foxglove: " in program.text
    assert "Traceback" not in program.text


PAGE = (HOW_TO / "foxglove.md").read_text()


def test_the_commands_of_the_page_start(run):
    commands = [shlex.split(line) for block in blocks_of(PAGE, "sh") for line in block.splitlines()]
    commands += [shlex.split(line) for line in re.findall(r"`(turtlewire foxglove [^`]+)`", PAGE)]
    assert len(commands) == 8
    first = commands[0]
    for words in commands:
        if words[0] == "ros2":
            continue  # a test below launches it
        program = run(BIN / words[0], *words[1:], *([] if "--port" in words else ["--port", "0"]))
        (said,) = program.wait_for(
            r"^Foxglove and Lichtblick connect to ws://.*:\d+ \(Ctrl-C ends\)$"
        )
        if words == first:
            assert re.sub(r":\d+ ", ":8765 ", said[0]) + "\n" == blocks_of(PAGE, "text")[0]
        program.kill()


def test_the_client_of_the_page(serve, robot, run, tmp_path):
    robot.say(robot.publisher("/greeting", durability=Durability.TRANSIENT_LOCAL), "hello")
    (tmp_path / "client.py").write_text(blocks_of(PAGE, "python")[0])
    program = run(sys.executable, tmp_path / "client.py", serve().url, "/greeting")
    program.wait_for("^hello$")
    assert program.wait() == 0


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
