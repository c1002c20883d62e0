"""Clients that are wrong, foreign, slow or gone: a line, and the server goes on."""

import contextlib
import gc
import json
import os
import socket
import threading
import urllib.error
import urllib.request

import pytest
from hypothesis import given
from hypothesis import strategies as st
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

from turtlewire_view.foxglove.channel import FoxgloveChannel
from turtlewire_view.foxglove.protocol import (
    ClientMessage,
    ProtocolError,
    ServiceRequest,
    parse_binary,
    parse_text,
)
from turtlewire_view.foxglove.server import refusal
from turtlewire_view.foxglove.session import FoxgloveSession

from .conftest import Client


@pytest.mark.parametrize(
    ("frame", "answer"),
    [
        ("nonsense", "a text frame is not JSON: "),
        ("[1]", 'a text frame is a JSON object with a string "op"'),
        ('{"op": 1}', 'a text frame is a JSON object with a string "op"'),
        ('{"op": "dance"}', "there is no operation 'dance'"),
        ("[" * 100_000, "a text frame is not JSON: "),
        ('{"op": "' + "x" * 2_000_000 + '"}', "a text frame of 2000010 characters is too long"),
        ('{"op": "subscribe"}', '"subscriptions" must be a list of objects'),
        ('{"op": "subscribe", "subscriptions": {}}', '"subscriptions" must be a list of objects'),
        ('{"op": "subscribe", "subscriptions": [1]}', '"subscriptions" must be a list of objects'),
        (
            '{"op": "subscribe", "subscriptions": [{"id": 1}]}',
            '"channelId" must be an integer from 0',
        ),
        (
            '{"op": "subscribe", "subscriptions": [{"id": 4294967296, "channelId": 1}]}',
            '"id" must be an integer from 0 to 4294967295',
        ),
        ('{"op": "unsubscribe", "subscriptionIds": [true]}', '"subscriptionIds" must be a list'),
        ('{"op": "unsubscribe", "subscriptionIds": [1e400]}', '"subscriptionIds" must be a list'),
        (
            '{"op": "getParameters", "parameterNames": "x"}',
            '"parameterNames" must be a list of strings',
        ),
        ('{"op": "getParameters", "parameterNames": ["\\ud800.x"]}', "there is no "),
        ('{"op": "setParameters", "parameters": [{"value": 1}]}', '"name" is missing'),
        (
            '{"op": "setParameters", "parameters": [{"name": "/a.b", "type": 1}]}',
            '"type" must be a string',
        ),
        ('{"op": "fetchAsset", "uri": "x"}', '"requestId" must be an integer from 0 to'),
        ('{"op": "fetchAsset", "uri": 5, "requestId": 1}', '"uri" must be a string'),
        (
            '{"op": "subscribeParameterUpdates", "parameterNames": [[]]}',
            '"parameterNames" must be a list',
        ),
        (b"", "a binary frame is empty"),
        (b"\x07abc", "there is no binary operation 7; clients send 1 and 2"),
        (b"\x01ab", "a binary frame of operation 1 ends after 3 bytes, too early"),
        (b"\x02" + 8 * b"\0" + b"\xff\xff\xff\xff", "a binary frame of operation 2 ends after 13"),
    ],
)
def test_wrong_frames_get_a_status_and_the_client_stays(client, frame, answer):
    one = client()
    one.socket.send(frame)
    level, message = one.status()
    assert level in {1, 2}
    assert message.startswith(answer)
    one.sync()


def test_a_message_beyond_all_bounds_ends_only_its_connection(client, log):
    one, two = client(), client()
    with contextlib.suppress(ConnectionClosed, OSError):
        one.socket.send(bytes((64 << 20) + 1))
    with pytest.raises(ConnectionClosed):
        one.next("never")
    two.sync()


@pytest.mark.parametrize(
    "origin",
    ["https://app.foxglove.dev", "http://localhost:8080", "http://127.0.0.1", "https://[::1]:1"],
)
def test_pages_of_foxglove_and_of_this_machine_connect(client, origin):
    client(origin=origin).sync()


@pytest.mark.parametrize(
    "origin",
    [
        "https://evil.example",
        "https://app.foxglove.dev.evil.example",
        "http://app.foxglove.dev",
        "http://localhost.evil.example",
        "http://127.0.0.1.evil.example",
        "null",
        "file://",
    ],
)
def test_other_pages_are_refused_with_one_line(serve, client, log, origin):
    server = serve()
    for _ in range(2):
        with pytest.raises(InvalidStatus) as refused:
            client(server, origin=origin)
        assert refused.value.response.status_code == 403
    assert log.warnings() == [
        (
            f"warning: refused a connection: pages of '{origin}' may not connect; "
            f"--origin {origin} (parameter origins) lets them"
        )
    ]
    client(serve(origins=(origin,)), origin=origin).sync()


def test_two_origins_are_none():
    assert refusal(["http://localhost", "http://localhost"], ())
    assert refusal([], ()) is None
    assert refusal(["https://x.y"], ["*"]) is None
    assert refusal(["https://X.y"], ["https://x.Y/"]) is None


def handshake(server, *hosts):
    """The status of a handshake without Origin, under these names."""
    port = int(server.url.rpartition(":")[2])
    lines = [
        "GET / HTTP/1.1",
        *(f"Host: {host}" for host in hosts),
        *("Connection: Upgrade", "Upgrade: websocket", "Sec-WebSocket-Version: 13"),
        *("Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==", "Sec-WebSocket-Protocol: foxglove.sdk.v1"),
    ]
    with socket.create_connection(("127.0.0.1", port), timeout=60) as connection:
        connection.sendall("\r\n".join([*lines, "", ""]).encode())
        return int(connection.makefile("rb").readline().split()[1])


@pytest.mark.parametrize("host", ["localhost:8765", "127.0.0.1:1", "127.0.0.9", "[::1]:8765"])
def test_this_machine_has_several_names(serve, host):
    assert handshake(serve(), host) == 101


@pytest.mark.parametrize(
    "hosts", [["evil.example"], ["127.0.0.1.evil.example"], ["10.0.0.1"], ["localhost", "evil"], []]
)
def test_a_foreign_name_is_refused_with_one_line(serve, log, hosts):
    server = serve()
    assert handshake(server, *hosts) == handshake(server, *hosts) == 403
    [line] = log.warnings()
    assert line.startswith("warning: refused a connection: Host is ")
    assert line.endswith("localhost and 127.0.0.1; --address 0.0.0.0 serves the network")


def test_all_names_are_served_to_the_network_and_to_all_pages(serve):
    assert handshake(serve(origins=("*",)), "robot.example") == 101
    assert handshake(serve(address="0.0.0.0"), "robot.example") == 101


@pytest.mark.parametrize("offered", [None, ["foxglove.other"], ["mqtt", "soap"]])
def test_clients_of_other_protocols_are_refused(client, offered):
    with pytest.raises(InvalidStatus) as refused:
        client(subprotocols=offered)
    assert refused.value.response.status_code == 400
    assert refused.value.response.body == b"Missing expected sec-websocket-protocol header\n"


@pytest.mark.parametrize(
    ("offered", "chosen"),
    [
        (["foxglove.websocket.v1"], "foxglove.websocket.v1"),
        (["foxglove.sdk.v1"], "foxglove.sdk.v1"),
        (["foxglove.sdk.v1", "foxglove.websocket.v1"], "foxglove.sdk.v1"),
        (["foxglove.sdk.v9", "foxglove.websocket.v1"], "foxglove.websocket.v1"),
    ],
)
def test_the_first_protocol_that_is_known_is_chosen(client, offered, chosen):
    one = client(subprotocols=offered)
    assert one.socket.subprotocol == chosen
    one.sync()


def test_a_browser_that_opens_the_address_is_told_what_it_is(serve):
    server = serve()
    with pytest.raises(urllib.error.HTTPError) as answer:
        urllib.request.urlopen(server.url.replace("ws:", "http:"))
    assert answer.value.code == 426
    assert f"open a connection to {server.url} there" in answer.value.read().decode()
    answer.value.close()


def test_garbage_on_the_socket_and_half_a_request_do_not_matter(serve, client):
    server = serve()
    port = int(server.url.rpartition(":")[2])
    with socket.create_connection(("127.0.0.1", port)) as half:
        half.sendall(b"GET / HTTP/1.1\r\nHost: x\r\n")
        with socket.create_connection(("127.0.0.1", port)) as garbage:
            garbage.sendall(os.urandom(4096))
        client(server).sync()
        server.close()  # returns although a client says nothing


def test_too_many_requests_at_once_are_refused(serve, client, robot):
    """A client that calls a service that never answers does not fill the memory."""
    service = robot.service("/never", "std_srvs/srv/Empty")
    one = client()
    number = one.service("/never")["id"]
    for call_id in range(101):
        one.call(number, call_id, b"{}")
    failure = one.next("serviceCallFailure")
    assert failure["callId"] == 100
    assert failure["message"] == "100 requests wait for their answers already"
    service.close()
    for _ in range(100):
        assert one.next("serviceCallFailure")["message"] == "service /never went away"


def test_a_slow_client_loses_old_messages_and_others_lose_none(serve, client, robot, log):
    publisher = robot.publisher("/points", depth=1000)
    quiet = robot.publisher("/quiet")
    server = serve(send_buffer_limit=2_000_000)
    slow = client(server, max_queue=1)  # reads nothing until it is asked
    fast = client(server)
    for each in (slow, fast):
        each.subscribe("/points", 1)
        each.subscribe("/quiet", 2)
        each.sync()
    robot.wait_until(lambda: publisher.subscription_count() + quiet.subscription_count() == 2)
    robot.say(quiet, "still there")
    count = 100
    for number in range(count):
        robot.say(publisher, f"{number} " + 1_000_000 * "x")
        assert fast.text(1).startswith(f"{number} ")
    assert fast.text(2) == "still there"
    got = []
    while not got or got[-1] != count - 1:
        got.append(int(slow.text(1).partition(" ")[0]))
    assert len(got) < count
    assert got == sorted(got)
    assert slow.text(2) == "still there"
    (warning,) = log.warnings()
    assert "messages of /points are lost: this connection is too slow for it" in warning
    assert slow.status()[1] in warning
    slow.sync()
    assert not [each for each in slow.frames if isinstance(each, dict) and each["op"] == "status"]


@pytest.mark.slow
def test_a_client_that_reads_nothing_is_asked_for_no_more(serve, client):
    """Its requests wait, and the server's memory does not grow."""
    server = serve()
    one, two = client(server, max_queue=1), client(server)
    stopped = threading.Event()

    def flood():
        with contextlib.suppress(ConnectionClosed, OSError):
            while not stopped.is_set():
                one.socket.send(json.dumps({"op": "x" * 1000}))

    thread = threading.Thread(target=flood)
    thread.start()
    for _ in range(100):
        two.sync()
    stopped.set()
    one.socket.socket.shutdown(socket.SHUT_RDWR)
    thread.join()
    two.sync()


@pytest.mark.slow
def test_nothing_stays_of_clients_and_topics_that_have_gone(serve, client, robot):
    server = serve()
    for number in range(30):
        with connect(server.url, subprotocols=["foxglove.sdk.v1"], compression=None) as socket:
            publisher = robot.publisher(f"/t{number}")
            one = Client(socket)
            one.subscribe(f"/t{number}", 1)
            one.publish_on("/c")
            one.send("subscribeParameterUpdates", parameterNames=[])
            one.send("subscribeConnectionGraph")
            one.sync()
        publisher.close()

    def is_left(end):
        mine = end.kind == "subscription" and end.topic == "/parameter_events"
        return mine or end.topic == "/c" or end.topic.startswith("/t")

    robot.wait_until(lambda: not any(map(is_left, robot.context.graph.endpoints())))
    robot.publisher("/last")
    client(server).channel("/last")  # the server has seen all that came before
    gc.collect()
    kinds = [type(each) for each in gc.get_objects()]
    assert kinds.count(FoxgloveSession) == kinds.count(FoxgloveChannel) == 1


def test_a_server_is_closed_twice_and_with_clients(serve, client):
    server = serve()
    one = client(server)
    one.sync()
    server.close()
    server.close()
    with pytest.raises(ConnectionClosed):
        one.next("never")


@given(st.binary(max_size=40))
def test_no_binary_frame_is_misread(frame):
    try:
        parsed = parse_binary(frame)
    except ProtocolError:
        return
    if isinstance(parsed, ClientMessage):
        assert frame == b"\x01" + parsed.channel_id.to_bytes(4, "little") + parsed.payload
    else:
        assert isinstance(parsed, ServiceRequest)
        assert frame.endswith(parsed.payload)


@given(st.text(max_size=40) | st.from_regex(r"\{.{0,30}\}"))
def test_no_text_frame_raises_anything_else(frame):
    with contextlib.suppress(ProtocolError):
        assert isinstance(parse_text(frame)["op"], str)


# A real browser: pages of Foxglove and of this machine connect, and others do not.


PAGE = """
<!doctype html><title>page</title><script>
  const socket = new WebSocket(%s, %s);
  socket.onmessage = (event) => { document.title = JSON.parse(event.data).op; };
  socket.onerror = () => { document.title = "refused"; };
</script>
"""


@pytest.mark.parametrize(
    ("url", "protocols", "title", "warnings"),
    [
        ("http://localhost:8080/", ["foxglove.sdk.v1", "foxglove.websocket.v1"], "serverInfo", 0),
        ("http://127.0.0.1:8080/", ["foxglove.websocket.v1"], "serverInfo", 0),
        ("https://app.foxglove.dev/", ["foxglove.sdk.v1"], "serverInfo", 0),
        ("https://evil.example/", ["foxglove.sdk.v1"], "refused", 1),
        ("http://localhost:8080/", ["other"], "refused", 0),
    ],
)
def test_pages_of_a_browser(serve, log, browser, url, protocols, title, warnings):
    server = serve()
    # What the user grants when the browser asks whether a page may reach programs of this machine.
    context = browser.new_context(permissions=["local-network-access"])
    try:
        page = context.new_page()
        body = PAGE % (json.dumps(server.url), json.dumps(protocols))
        page.route("**/*", lambda route: route.fulfill(body=body, content_type="text/html"))
        page.goto(url)
        page.wait_for_function("() => document.title != 'page'", timeout=120_000)
        assert page.title() == title
        assert len(log.warnings()) == warnings
    finally:
        context.close()
