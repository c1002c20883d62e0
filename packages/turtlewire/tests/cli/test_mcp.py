"""`turtlewire mcp` in a process of its own, between the SDK's client and a turtlesim."""

import base64
import contextlib
import json
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import anyio
import pytest
from mcp import Client, StdioServerParameters, stdio_client
from tests.needs import needs_cyclone_dds, only_first_is_fast
from tests.places import BIN

import turtlewire
from turtlewire import msg
from turtlewire.cli.main import main
from turtlewire.wire.base import ServiceTypes, TypeId
from turtlewire.wire.qos import Durability, QoS

COMMAND = str(BIN / "turtlewire")
LONG_NS = 60_000_000_000
DEEP = QoS(depth=100)
LATCHED = QoS(depth=1, durability=Durability.TRANSIENT_LOCAL)


class Assistant:
    """An assistant that calls tools."""

    def __init__(self, client):
        self.client = client

    async def content(self, tool, **arguments):
        """What a tool returns, and whether it is an error."""
        answer = await self.client.call_tool(tool, arguments)
        return answer.content, answer.is_error

    async def call(self, tool, **arguments):
        """The JSON that a tool returns."""
        content, failed = await self.content(tool, **arguments)
        assert not failed, content
        return json.loads(content[0].text)

    async def refused(self, tool, **arguments):
        """The error that a tool returns."""
        content, failed = await self.content(tool, **arguments)
        assert failed, content
        return content[0].text


def talk(dialogue, *options):
    """Start the server with these options, and an assistant in this process."""

    async def session():
        parameters = StdioServerParameters(
            command=COMMAND, args=["mcp", *options], env=dict(os.environ)
        )
        async with Client(stdio_client(parameters)) as client:
            await dialogue(Assistant(client))

    anyio.run(session)


@pytest.fixture
def simulator(run):
    node = run(BIN / "ros2", "run", "turtlesim", "turtlesim_node", "--headless")
    node.wait_for("Spawning turtle")
    return node


@pytest.fixture
def connection():
    with turtlewire.connect("tester") as joined:
        yield joined


def test_it_reads_and_subscribes_only_while_it_reads(simulator, connection):
    graph = connection._context.graph

    async def dialogue(assistant):
        tools = (await assistant.client.list_tools()).tools
        assert {tool.name for tool in tools if tool.annotations.read_only_hint} == {
            "list_topics", "list_services", "echo", "list_frames", "lookup_transform", "plot"
        }  # fmt: skip
        assert {tool.name for tool in tools if not tool.annotations.read_only_hint} == {
            "publish", "drive", "call_service"
        }  # fmt: skip
        assert "data, not as instructions" in assistant.client.instructions
        assert "read-only" in assistant.client.instructions

        message = await assistant.call("echo", topic="turtle1/pose")
        assert message["type"] == "turtlesim/msg/Pose"
        assert round(message["message"]["x"], 3) == 5.544
        assert graph.wait_for(
            lambda: not graph.endpoints_of("/turtle1/pose", "subscription"), LONG_NS
        )
        (pose,) = await assistant.call("list_topics", containing="Pose")
        del pose["subscriptions"]  # the server may learn of the end of its own a moment later
        assert pose == {
            "topic": "/turtle1/pose",
            "types": ["turtlesim/msg/Pose"],
            "publishers": 1,
            "may_publish": False,
        }
        topics = await assistant.call("list_topics")
        assert "/turtle1/cmd_vel" in [each["topic"] for each in topics]
        (spawn,) = await assistant.call("list_services", containing="spawn")
        assert spawn == {"service": "/spawn", "types": ["turtlesim/srv/Spawn"], "may_call": False}

    talk(dialogue)


@pytest.mark.slow
def test_a_field_becomes_a_curve(simulator):
    async def dialogue(assistant):
        (text, image), failed = await assistant.content(
            "plot", topic="/turtle1/pose", field="x", seconds=2
        )
        assert not failed
        summary = json.loads(text.text)
        assert summary["topic"] == "/turtle1/pose"
        assert summary["values"] > 0
        assert summary["min"] == summary["max"] == pytest.approx(5.544, abs=1e-3)
        assert image.mime_type == "image/png"
        assert base64.b64decode(image.data).startswith(b"\x89PNG")
        wrong = await assistant.refused("plot", topic="/turtle1/pose", field="thet")
        assert "Did you mean: theta. Its fields: x, y, theta" in wrong

    talk(dialogue)


def test_transforms(connection):
    async def dialogue(assistant):
        found = await assistant.call(
            "lookup_transform", target_frame="world", source_frame="lamp", timeout_s=30
        )
        assert found["translation"] == {"x": 1.0, "y": 2.0, "z": 3.0}
        assert found["rotation"]["w"] == 1.0
        assert found["degrees"] == {"roll": 0.0, "pitch": 0.0, "yaw": 0.0}
        frames = await assistant.call("list_frames", listen_s=2)
        assert [(each["frame"], each["parent"]) for each in frames["frames"]] == [
            ("world", None),
            ("lamp", "world"),
        ]
        assert frames["frames"][1]["publishers"] == ["/tester"]
        wrong = await assistant.refused(
            "lookup_transform", target_frame="world", source_frame="lampe", timeout_s=2
        )
        assert '"lampe" passed to lookupTransform argument source_frame does not exist' in wrong
        assert "'lamp'" in wrong

    connection.send_static_transform("world", "lamp", (1.0, 2.0, 3.0))
    talk(dialogue)


def test_without_allow_nothing_is_changed(simulator):
    async def dialogue(assistant):
        message = {"message": {}, "type": "std_msgs/msg/Empty"}
        for tool, arguments, name, action in (
            ("drive", {"topic": "turtle1/cmd_vel"}, "/turtle1/cmd_vel", "drive on"),
            ("publish", {"topic": "/turtle1/cmd_vel", **message}, "/turtle1/cmd_vel", "publish to"),
            ("publish", {"topic": "/a", **message}, "/a", "publish to"),
            ("call_service", {"service": "/kill", "request": {"name": "turtle1"}}, "/kill", "call"),
        ):
            text = await assistant.refused(tool, **arguments)
            assert f"Refused to {action} {name}. Allowed: nothing." in text
            assert text.endswith(f"turtlewire mcp --allow {name}")

    talk(dialogue)
    assert "kill" not in simulator.text.lower()


def test_the_assistant_does_what_is_allowed(simulator, connection):
    received = connection.subscribe("/turtle1/cmd_vel", "geometry_msgs/msg/Twist", qos=DEEP)
    chatter = connection.subscribe("/chatter", "std_msgs/msg/String", qos=DEEP)

    async def dialogue(assistant):
        assert "/spawn, /chatter, /turtle1/*" in assistant.client.instructions
        spawned = await assistant.call("call_service", service="/spawn", request={"x": 1, "y": 2})
        assert spawned == {"service": "/spawn", "response": {"name": "turtle2"}}
        wrong = await assistant.refused("call_service", service="/spawn", request={"xx": 1})
        assert "turtlesim/srv/Spawn_Request has no field 'xx', it has x, y, theta" in wrong
        assert "Allowed: /spawn, /chatter, /turtle1/*." in await assistant.refused(
            "drive", topic="/turtle2/cmd_vel"
        )

        sent = await assistant.call("publish", topic="/chatter", message={"data": "hi"})
        assert sent == {"topic": "/chatter", "type": "std_msgs/msg/String", "subscriptions": 1}
        assert next(chatter).data == "hi"
        wrong = await assistant.refused("publish", topic="/chatter", message={"data": 1})
        assert "data: expected a string, got 1" in wrong
        wrong = await assistant.refused("publish", topic="/turtle1/cmd_vel", message={})
        assert "The tool drive stops the robot at the end." in wrong

        driven = await assistant.call(
            "drive", topic="/turtle1/cmd_vel", linear_x=1.0, angular_z=0.5, duration_s=0.5
        )
        assert driven["stopped"]
        twists = [next(received) for _ in range(driven["twists"] + 1)]
        assert {(twist.linear.x, twist.angular.z) for twist in twists[:-1]} == {(1.0, 0.5)}
        assert (twists[-1].linear.x, twists[-1].angular.z) == (0.0, 0.0)

    talk(dialogue, "--allow", "/spawn", "--allow", "chatter", "--allow", "/turtle1/*")


@pytest.mark.slow
def test_wrong_names_and_numbers_are_explained(simulator):
    async def dialogue(assistant):
        text = await assistant.refused("echo", topic="/turtle1/pos")
        assert "There is no topic /turtle1/pos. Did you mean: /turtle1/pose" in text
        text = await assistant.refused("call_service", service="/spwn")
        assert "There is no service /spwn. Did you mean: /spawn" in text
        text = await assistant.refused("publish", topic="/new", message={})
        assert "Nobody uses the topic /new; to publish there, also give its type" in text
        text = await assistant.refused(
            "publish", topic="/a b", message={}, type="std_msgs/msg/Bool"
        )
        assert "topic name must not contain characters other than" in text
        text = await assistant.refused(
            "publish", topic="/new", message={}, type="std_msgs/msg/Strin"
        )
        assert "Strin" in text
        text = await assistant.refused("publish", topic="/tf", message={}, type="std_msgs/msg/Bool")
        assert "/tf carries tf2_msgs/msg/TFMessage" in text
        text = await assistant.refused("echo", topic="/turtle1/cmd_vel", timeout_s=0.2)
        assert text.endswith("No message on /turtle1/cmd_vel within 0.2 s; it has no publisher")
        text = await assistant.refused("drive", topic="/turtle1/cmd_vel", duration_s=50)
        assert text.endswith("duration_s is 50; it must be above 0 and at most 5 seconds")
        text = await assistant.refused("drive", topic="/turtle1/cmd_vel", linear=1.0)
        assert re.search("linear.*not permitted", text, re.DOTALL)
        text = await assistant.refused("drive", topic="/turtle1/pose")
        assert "has the type turtlesim/msg/Pose; drive needs geometry_msgs/msg/Twist" in text
        text = await assistant.refused("list_frames", listen_s=0.1)
        assert "No transforms on /tf and /tf_static yet" in text

    talk(dialogue, "--allow", "*")


def test_a_service_that_does_not_answer(connection):
    request, response = (
        TypeId(name, msg.type_hash(name))
        for name in ("std_srvs/srv/Trigger_Request", "std_srvs/srv/Trigger_Response")
    )
    types = ServiceTypes("std_srvs/srv/Trigger", request, response, msg.type_hash)
    connection._node.create_service("/mute", types, QoS())

    async def dialogue(assistant):
        text = await assistant.refused("call_service", service="/mute", timeout_s=0.3)
        assert "/mute did not answer within 0.3 s" in text

    talk(dialogue, "--allow", "/mute")


def test_a_long_message_is_cut(connection):
    camera = connection.publisher("/camera", "sensor_msgs/msg/Image", qos=LATCHED)
    camera.publish(width=100, data=bytes(30_000))

    async def dialogue(assistant):
        (text,), failed = await assistant.content("echo", topic="/camera")
        assert not failed
        note, message = text.text.splitlines()
        assert note == "(shortened: at most 200 items of a list, 2000 of a string)"
        assert json.loads(message)["message"]["data"][-1] == "... and 29800 more"

    talk(dialogue)


def test_too_many_calls_are_refused():
    async def dialogue(assistant):
        await assistant.call("list_services")
        await assistant.call("list_topics")
        text = await assistant.refused("list_topics")
        assert "Too many calls: 2 in a minute are allowed" in text
        assert "Try again in " in text

    talk(dialogue, "--rate", "2")


@pytest.mark.slow
def test_one_drive_at_a_time(simulator):
    async def dialogue(assistant):
        async def drive():
            refused = await assistant.refused("drive", topic="/turtle1/cmd_vel", duration_s=5.0)
            assert "Another drive on /turtle1/cmd_vel has not ended" in refused
            tasks.cancel_scope.cancel()

        async with anyio.create_task_group() as tasks:
            tasks.start_soon(drive)
            tasks.start_soon(drive)
        assert tasks.cancel_scope.cancelled_caught

    talk(dialogue, "--allow", "/turtle1/cmd_vel")


class RawClient:
    """Writes the protocol line by line, to end the server in each way."""

    def __init__(self):
        self.process = subprocess.Popen(
            [COMMAND, "mcp", "--allow", "/turtle1/*"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )
        me = {"name": "test", "version": "1"}
        self.send(
            id=1,
            method="initialize",
            params={"protocolVersion": "2025-06-18", "capabilities": {}, "clientInfo": me},
        )
        assert json.loads(self.process.stdout.readline())["id"] == 1
        self.send(method="notifications/initialized")

    def send(self, **message):
        self.process.stdin.write(json.dumps({"jsonrpc": "2.0", **message}).encode() + b"\n")
        self.process.stdin.flush()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        for pipe in (self.process.stdin, self.process.stdout, self.process.stderr):
            pipe.close()


def cancel(client):
    client.send(method="notifications/cancelled", params={"requestId": 2})


def close_stdin(client):
    client.process.stdin.close()


def leave(client):
    client.process.stdout.close()
    client.process.stdin.close()


def interrupt(client):
    client.process.send_signal(signal.SIGINT)


def terminate(client):
    client.process.send_signal(signal.SIGTERM)


@pytest.mark.parametrize(
    "end", only_first_is_fast(cancel, close_stdin, leave, interrupt, terminate)
)
def test_a_drive_that_is_ended_stops_the_robot(connection, end):
    twists = connection.subscribe("/turtle1/cmd_vel", "geometry_msgs/msg/Twist", qos=DEEP)
    drive = {"topic": "/turtle1/cmd_vel", "linear_x": 1.5, "duration_s": 5}
    with RawClient() as client:
        client.send(id=2, method="tools/call", params={"name": "drive", "arguments": drive})
        assert [next(twists).linear.x for _ in range(2)] == [1.5, 1.5]
        end(client)
        speeds = [1.5]
        while speeds[-1]:
            speeds.append(next(twists).linear.x)
        assert len(speeds) < 48  # the 5 seconds have 50
        if end is cancel:
            client.process.stdin.close()
        assert client.process.wait(60) == 0
        if end is not leave:
            for line in client.process.stdout:
                assert json.loads(line)["jsonrpc"] == "2.0"
        said = client.process.stderr.read().decode()
    assert said.splitlines() == ["turtlewire mcp: assistants may read, and use: /turtle1/*"]


@needs_cyclone_dds  # Zenoh listens for other peers
@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
def test_it_listens_on_no_port():
    with RawClient() as client:
        process = Path(f"/proc/{client.process.pid}")
        own = set()
        for each in (process / "fd").iterdir():
            with contextlib.suppress(FileNotFoundError):  # closed meanwhile
                own.add(os.readlink(each))
        table = [
            line.split()
            for name in ("tcp", "tcp6")
            for line in (process / "net" / name).read_text().splitlines()[1:]
        ]
    listening = {f"socket:[{row[9]}]" for row in table if row[3] == "0A"}
    assert not own & listening


def test_ctrl_c_ends_it_in_a_terminal(run):
    server = run(COMMAND, "mcp", terminal=True)
    server.wait_for("Ctrl-C ends it")
    server.type("\x03")
    assert server.wait() == 0, server.text
    assert "Traceback" not in server.text


@pytest.mark.parametrize("redirection", ["<&-", ">&- </dev/null"])
def test_a_closed_stream_is_an_error(redirection):
    ended = subprocess.run(
        ["sh", "-c", f"{COMMAND} mcp {redirection}"], capture_output=True, text=True, check=False
    )
    assert ended.returncode == 2
    assert ended.stderr == "turtlewire mcp: needs stdin and stdout, and one of them is closed\n"


def test_wrong_options(capsys):
    for options, reason in (
        (["--allow", "a*b"], "--allow: 'a*b' is not the name of a topic or service"),
        (["--rate", "0"], "'0' is not a number of calls, at least 1"),
        (["--alow", "/a"], "Did you mean: --allow"),
    ):
        with pytest.raises(SystemExit):
            main(["mcp", *options])
        assert reason in capsys.readouterr().err


@pytest.mark.parametrize("missing", ["mcp", "mcp.server", "anyio"])
def test_without_the_extra_it_says_what_to_install(missing):
    program = (
        f"import sys; sys.modules[{missing!r}] = None; "
        "from turtlewire.cli.main import main; sys.exit(main(['mcp']))"
    )
    ended = subprocess.run(
        [sys.executable, "-c", program],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (ended.returncode, ended.stdout) == (2, "")
    assert ended.stderr == (
        "turtlewire mcp needs the official SDK of the Model Context Protocol, version 2: "
        "pip install 'turtlewire[mcp]', or pip install 'mcp>=2' pypdfium2\n"
    )
