"""`turtlewire foxglove`: its words, its address, and its end."""

import json
import signal
import socket

import pytest
from tests.places import TURTLEWIRE
from websockets.sync.client import connect


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
