"""Foxglove's own client (npm: @foxglove/ws-protocol) as a peer that knows nothing of us."""

import base64
import contextlib
import json
import queue
import shutil
import subprocess
import threading
from pathlib import Path

import pytest
from tests.places import ROOT

from turtlewire import msg
from turtlewire.wire.qos import Durability

CLIENT = ROOT / "build" / "npm-tools" / "foxglove"
pytestmark = pytest.mark.skipif(
    shutil.which("node") is None or not (CLIENT / "node_modules").is_dir(),
    reason="needs Foxglove's client: scripts/npm-tools (Debian: apt install nodejs npm)",
)


class Peer:
    """The program `npm/peer.mjs`."""

    def __init__(self, url, subprotocol):
        program = Path(__file__).parent / "npm" / "peer.mjs"
        self._process = subprocess.Popen(
            ["node", program, CLIENT, url, subprotocol],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        self._events = queue.SimpleQueue()
        self._kept = []
        self._reader = threading.Thread(target=self._read)
        self._reader.start()

    def _read(self):
        for line in self._process.stdout:
            self._events.put(json.loads(line))
        self._events.put(("error", "the client has ended"))

    def do(self, name, *words):
        """Call a method of the client; its result."""
        self._process.stdin.write(json.dumps([name, *words]) + "\n")
        self._process.stdin.flush()
        return self.next("done")

    def next(self, name, matches=lambda _: True):
        """The first event of a name for which ``matches`` is true; others are kept."""
        for index, (kept, value) in enumerate(self._kept):
            if kept == name and matches(value):
                del self._kept[index]
                return value
        while True:
            found, value = self._events.get(timeout=60)
            assert found != "error" or name == "error", value
            if found == name and matches(value):
                return value
            self._kept.append([found, value])

    def close(self):
        self._process.kill()
        self._process.wait()
        self._reader.join()
        self._process.stdin.close()
        self._process.stdout.close()


@pytest.fixture(params=["foxglove.sdk.v1", "foxglove.websocket.v1"])
def subprotocol(request):
    return request.param


@pytest.fixture
def peer(subprotocol):
    with contextlib.ExitStack() as stack:

        def connect(server):
            one = Peer(server.url, subprotocol)
            stack.callback(one.close)
            one.next("open")
            return one

        yield connect


def named(name, key="topic"):
    """Whether a list of channels or services has one of this name."""
    return lambda items: any(item[key] == name for item in items)


def of(items, name, key="topic"):
    return next(item for item in items if item[key] == name)


def encoded(message):
    return base64.b64encode(msg.serialize(message)).decode()


def test_topics_both_ways(serve, peer, robot):
    keeper = robot.publisher("/description", durability=Durability.TRANSIENT_LOCAL)
    robot.say(keeper, "kept")
    one = peer(serve())
    info = one.next("serverInfo")
    assert "clientPublish" in info["capabilities"]
    channel = of(one.next("advertise", named("/description")), "/description")
    assert channel["schema"] == "string data\n"
    number = one.do("subscribe", channel["id"])
    message = one.next("message")
    assert message["subscriptionId"] == number
    assert int(message["timestamp"]) > 10**18
    string = msg.get_message("std_msgs/msg/String")
    assert msg.deserialize(string, base64.b64decode(message["data"])).data == "kept"
    one.do("unsubscribe", number)
    robot.wait_until(lambda: keeper.subscription_count() == 0)

    heard = robot.hear("/said")
    (subscription,) = robot.subscriptions
    for count, encoding in enumerate(("cdr", "json"), start=1):
        number = one.do(
            "advertise", {"topic": "/said", "encoding": encoding, "schemaName": "std_msgs/String"}
        )
        robot.wait_until(lambda count=count: subscription.publisher_count() == count)
        payload = encoded(string(data="cdr"))
        if encoding == "json":
            payload = base64.b64encode(b'{"data": "json"}').decode()
        one.do("sendMessage", number, payload)
        assert heard.get(timeout=60) == encoding
    one.do("unadvertise", number)
    robot.wait_until(lambda: subscription.publisher_count() == 1)
    one.do("close")
    robot.wait_until(lambda: subscription.publisher_count() == 0)


def test_services(serve, peer, ros):
    from std_srvs.srv import SetBool

    def answer(request, response):
        response.message = f"got {request.data}"
        return response

    ros("switch").create_service(SetBool, "/switch", answer)
    one = peer(serve())
    service = of(one.next("advertiseServices", named("/switch", "name")), "/switch", "name")
    assert service["request"]["schema"] == "bool data\n"
    call = {"serviceId": service["id"], "callId": 5, "encoding": "cdr"}
    one.do("sendServiceCallRequest", {**call, "data": encoded(SetBool.Request(data=True))})
    response = one.next("serviceCallResponse")
    assert {key: response[key] for key in call} == call
    answered = msg.deserialize(SetBool.Response, base64.b64decode(response["data"]))
    assert answered.message == "got True"
    call = {"serviceId": service["id"], "callId": 6, "encoding": "json"}
    one.do("sendServiceCallRequest", {**call, "data": base64.b64encode(b"{}").decode()})
    response = one.next("serviceCallResponse")
    assert json.loads(base64.b64decode(response["data"]))["message"] == "got False"
    one.do("sendServiceCallRequest", {**call, "serviceId": 9999, "data": ""})
    failed = one.next("serviceCallFailure")
    assert (failed["callId"], failed["message"]) == (6, "there is no service 9999")


def test_parameters(serve, peer, ros):
    node = ros("tuned")
    node.declare_parameter("gain", 2.0)
    one = peer(serve())
    one.next("advertiseServices", named("/tuned/set_parameters", "name"))
    one.do("getParameters", ["/tuned.gain"], "first")
    got = one.next("parameterValues")
    assert got["id"] == "first"
    assert got["parameters"] == [{"name": "/tuned.gain", "value": 2, "type": "float64"}]
    one.do("subscribeParameterUpdates", ["/tuned.gain"])
    one.do("setParameters", [{"name": "/tuned.gain", "value": 3}], "second")
    told = one.next("parameterValues", lambda frame: frame.get("id") == "second")
    assert told["parameters"][0]["value"] == 3
    assert node.get_parameter("gain").value == 3.0


def test_files_and_connections(serve, peer, robot, tmp_path):
    (tmp_path / "a.stl").write_bytes(bytes(range(256)))
    one = peer(serve(find_share=lambda _: str(tmp_path)))
    one.do("fetchAsset", "package://robot/a.stl", 1)
    got = one.next("fetchAssetResponse")
    assert (got["requestId"], got["status"]) == (1, 0)
    assert base64.b64decode(got["data"]) == bytes(range(256))
    one.do("fetchAsset", "package://../../etc/passwd", 2)
    got = one.next("fetchAssetResponse")
    assert (got["requestId"], got["status"]) == (2, 1)
    assert "does not allow package://../../etc/passwd" in got["error"]
    robot.publisher("/chatter")
    one.do("subscribeConnectionGraph")

    def tells(frame):
        return {"name": "/chatter", "publisherIds": ["/robot"]} in frame["publishedTopics"]

    one.next("connectionGraphUpdate", tells)


def test_time(serve, peer, robot):
    server = serve(use_sim_time=True)
    clock = robot.publisher("/clock", "rosgraph_msgs/msg/Clock")
    robot.wait_until(lambda: clock.subscription_count() == 1)
    message = msg.get_message("rosgraph_msgs/msg/Clock")()
    message.clock.sec = 7
    clock.publish(msg.serialize(message))
    assert peer(server).next("time") == "7000000000"
