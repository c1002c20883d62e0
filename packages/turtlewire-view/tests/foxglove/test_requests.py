"""Services, parameters, connections, files and time."""

import base64
import json
import struct

import pytest

from turtlewire import msg
from turtlewire.wire.qos import Reliability

SET_BOOL = "std_srvs/srv/SetBool"


@pytest.fixture
def switch(ros):
    """A node with the service /switch, which tells what it got."""
    from std_srvs.srv import SetBool

    def answer(request, response):
        response.success = request.data
        response.message = "on" if request.data else "off"
        return response

    node = ros("switch")
    node.create_service(SetBool, "/switch", answer)
    return node


def failure(client):
    frame = client.next("serviceCallFailure")
    return frame["callId"], frame["message"]


# -- services


def test_a_service_is_offered_with_its_definitions(client, switch):
    service = client().service("/switch")
    assert service["type"] == SET_BOOL
    assert service["request"] == {
        "encoding": "cdr",
        "schemaName": f"{SET_BOOL}_Request",
        "schemaEncoding": "ros2msg",
        "schema": "bool data\n",
    }
    assert service["response"]["schema"] == "bool success\nstring message\n"
    assert service["requestSchema"] == "bool data\n"


def test_services_are_called_in_both_encodings(client, switch):
    one = client()
    number = one.service("/switch")["id"]
    one.call(number, 11, b'{"data": true}')
    response = one.next_binary(3)
    assert response[:17] == struct.pack("<BIII", 3, number, 11, 4) + b"json"
    assert json.loads(response[17:]) == {"success": True, "message": "on"}
    request = msg.serialize(msg.get_service(SET_BOOL).Request(data=False))
    one.call(number, 12, request, "cdr")
    response = one.next_binary(3)
    assert response[:16] == struct.pack("<BIII", 3, number, 12, 3) + b"cdr"
    answer = msg.deserialize(msg.get_service(SET_BOOL).Response, response[16:])
    assert (answer.success, answer.message) == (False, "off")


def test_many_calls_at_once_are_answered_each(client, switch):
    one = client()
    number = one.service("/switch")["id"]
    for call_id in range(50):
        one.call(number, call_id, b'{"data": true}' if call_id % 3 else b"{}")
    answers = {}
    for _ in range(50):
        response = one.next_binary(3)
        answers[struct.unpack_from("<I", response, 5)[0]] = json.loads(response[17:])["success"]
    assert answers == {call_id: bool(call_id % 3) for call_id in range(50)}


def test_wrong_calls_are_answered_with_a_reason(client, switch):
    one = client()
    number = one.service("/switch")["id"]
    one.call(number + 99, 1, b"{}")
    assert failure(one) == (1, f"there is no service {number + 99}")
    one.call(number, 2, b'{"data": 1}')
    assert failure(one) == (2, f"{SET_BOOL}_Request.data: expected true or false, got 1")
    one.call(number, 3, b"nonsense")
    assert failure(one)[1].startswith("no JSON: ")
    one.call(number, 4, b"", "cdr")
    assert failure(one)[1].startswith("the request's 0 bytes are not little-endian CDR")
    one.call(number, 5, b"", "xml")
    assert failure(one) == (5, "there is no encoding 'xml'; choose from cdr, json")


def test_a_call_fails_when_its_service_goes(client, robot):
    silent = robot.service("/silent", SET_BOOL)
    waiting = robot.context.create_wait_set()
    waiting.attach(silent)
    one = client()
    number = one.service("/silent")["id"]
    one.call(number, 1, b"{}")
    assert waiting.wait(60_000_000_000) == [silent]
    silent.close()
    assert failure(one) == (1, "service /silent went away")
    assert one.next("unadvertiseServices")["serviceIds"] == [number]
    waiting.close()


def test_a_service_whose_server_would_misread_the_call_is_not_called(client, foreign_server):
    foreign_server("/silent", SET_BOOL)
    one = client()
    one.call(one.service("/silent")["id"], 1, b"{}")
    number, text = failure(one)
    assert number == 1
    assert text.startswith("service /silent is not called: its server runs on ")
    assert "Start the server with RMW_IMPLEMENTATION=rmw_cyclonedds_cpp" in text


# -- parameters


@pytest.fixture
def tuned(ros):
    """A node with a parameter of each kind."""
    node = ros("tuned", namespace="/arm")
    for name, value in {
        "flag": True,
        "count": 3,
        "gain": 2.0,
        "limit": float("inf"),
        "label": "grün",
        "gains": [1.0, 2.5],
        "names": ["a", "b"],
        "blob": [b"\x00", b"\xff"],
        "joint.max": 5,
    }.items():
        node.declare_parameter(name, value)
    return node


def values(frame):
    return {each["name"]: each["value"] for each in frame["parameters"]}


def test_parameters_are_read_by_name_and_all_of_them(client, tuned):
    one = client()
    one.service("/arm/tuned/get_parameters")
    names = [f"/arm/tuned.{name}" for name in ("flag", "gain", "limit", "joint.max", "label")]
    one.send("getParameters", parameterNames=names, id="some")
    frame = one.next("parameterValues")
    assert frame["id"] == "some"
    assert values(frame) == dict(zip(names, [True, 2.0, "Infinity", 5, "grün"], strict=True))
    assert {each["name"]: each.get("type") for each in frame["parameters"]}[names[1]] == "float64"
    one.send("getParameters", parameterNames=[], id="all")
    found = values(one.next("parameterValues"))
    assert found["/arm/tuned.gains"] == [1.0, 2.5]
    assert found["/arm/tuned.names"] == ["a", "b"]
    assert base64.b64decode(found["/arm/tuned.blob"]) == b"\x00\xff"
    assert found["/arm/tuned.use_sim_time"] is False


def test_parameters_are_set_and_keep_their_type(client, tuned):
    one = client()
    one.service("/arm/tuned/set_parameters")
    wanted = {
        "flag": False,
        "count": 7,
        "gain": 3,  # as JavaScript writes 3.0
        "gains": [1, 2],
        "names": [],
        "label": "x",
        "blob": base64.b64encode(b"\x01").decode(),
    }
    parameters = [{"name": f"/arm/tuned.{name}", "value": value} for name, value in wanted.items()]
    parameters[-1]["type"] = "byte_array"
    one.send("setParameters", parameters=parameters, id="set")
    frame = one.next("parameterValues")
    assert frame["id"] == "set"
    assert values(frame) == {f"/arm/tuned.{name}": value for name, value in wanted.items()}
    assert tuned.get_parameter("gain").value == 3.0
    assert isinstance(tuned.get_parameter("gain").value, float)
    assert tuned.get_parameter("names").value == []


def test_changes_of_parameters_are_told_to_those_who_follow_them(client, tuned):
    one, two = client(), client()
    one.service("/arm/tuned/set_parameters")
    one.send("subscribeParameterUpdates", parameterNames=["/arm/tuned.count"])
    two.send("subscribeParameterUpdates", parameterNames=[])
    for each in (one, two):
        each.sync()
    for value in (8, 9):
        parameters = [
            {"name": "/arm/tuned.gain", "value": 0.5},
            {"name": "/arm/tuned.count", "value": value},
        ]
        two.send("setParameters", parameters=parameters)
    assert values(one.next("parameterValues")) == {"/arm/tuned.count": 8}
    assert values(one.next("parameterValues")) == {"/arm/tuned.count": 9}
    seen = {}
    while seen != {"/arm/tuned.gain": 0.5, "/arm/tuned.count": 9}:
        seen.update(values(two.next("parameterValues")))
    one.send("unsubscribeParameterUpdates", parameterNames=["/arm/tuned.count"])
    one.sync()
    two.send("setParameters", parameters=[{"name": "/arm/tuned.count", "value": 1}])
    assert values(two.next("parameterValues")) == {"/arm/tuned.count": 1}
    one.sync()
    assert not any(frame["op"] == "parameterValues" for frame in one.frames if type(frame) is dict)


def test_wrong_parameters_are_answered_with_a_reason(serve, client, tuned):
    one = client(serve(param_whitelist=("/arm/tuned\\..*",)))
    one.service("/arm/tuned/set_parameters")
    for name, reason in {
        "nonsense": "there is no parameter nonsense here; names are /node.parameter",
        "/secret.x": "there is no parameter /secret.x here; names are /node.parameter",
        "/arm/tuned.missing": "node /arm/tuned has no parameter missing",
    }.items():
        one.send("getParameters", parameterNames=[name, "/arm/tuned.count"], id="q")
        assert one.status() == (1, reason)
        assert values(one.next("parameterValues")) == {"/arm/tuned.count": 3}
    for value, reason in {
        '"text"': "parameter /arm/tuned.count was not set: Wrong parameter type",
        "1e999": "parameter /arm/tuned.count was not set: Wrong parameter type",
        "99999999999999999999": "parameter /arm/tuned.count: 99999999999999999999 does not fit",
        '[1, "a"]': "parameter /arm/tuned.count: the items of a list are of different types",
        '{"a": 1}': (
            "parameter /arm/tuned.count: a parameter must be a bool, a number, a string or a list"
        ),
    }.items():
        one.socket.send(
            '{"op": "setParameters", "parameters": [{"name": "/arm/tuned.count", "value": '
            f"{value}}}]}}"
        )
        level, message = one.status()
        assert level == 2
        assert message.startswith(reason)
    assert tuned.get_parameter("count").value == 3


# -- connections


def test_the_connections_and_their_changes(client, robot):
    robot.publisher("/chatter")
    one = client()
    one.subscribe("/chatter", 1)
    one.send("subscribeConnectionGraph")

    def told(kind, name, ids):
        one.next(
            "connectionGraphUpdate",
            lambda frame: any(
                each["name"] == name and ids in each.values() for each in frame[kind]
            ),
        )

    told("publishedTopics", "/chatter", ["/robot"])  # first perhaps by its GID
    robot.hear("/new")
    told("subscribedTopics", "/new", ["/robot"])
    for subscription in robot.subscriptions:
        subscription.close()
    one.next("connectionGraphUpdate", lambda frame: "/new" in frame["removedTopics"])
    one.send("unsubscribeConnectionGraph")
    one.sync()
    one.frames.clear()
    robot.publisher("/more")
    one.channel("/more")
    one.sync()
    assert not any(frame["op"] == "connectionGraphUpdate" for frame in one.frames)


# -- files


@pytest.fixture
def share(tmp_path):
    (tmp_path / "secret.stl").write_bytes(b"secret")
    folder = tmp_path / "robot" / "meshes"
    folder.mkdir(parents=True)
    (folder / "arm 1.stl").write_bytes(b"solid" * 100_000)
    (folder / "notes.txt").write_bytes(b"")
    (folder / "folder.stl").mkdir()
    return lambda package: str(tmp_path / package) if package == "robot" else None


def asset(client, uri, number):
    client.send("fetchAsset", uri=uri, requestId=number)
    frame = client.next_binary(4)
    request, status, length = struct.unpack_from("<IBI", frame, 1)
    assert request == number
    return frame[10:] if status == 0 else frame[10 : 10 + length].decode()


def test_files_of_packages_are_read(serve, client, share):
    one = client(serve(share))
    assert asset(one, "package://robot/meshes/arm%201.stl", 5) == b"solid" * 100_000


@pytest.mark.parametrize(
    ("uri", "reason"),
    [
        ("package://robot/meshes/none.stl", "there is no file package://robot/meshes/none.stl"),
        ("package://robot/meshes/folder.stl", "there is no file "),
        ("package://other/x.stl", "there is no package 'other' in AMENT_PREFIX_PATH"),
        ("package://robot/../secret.stl", "asset_uri_allowlist does not allow "),
        ("package://robot/%2e%2e/secret.stl", "package://robot/%2e%2e/secret.stl leads out"),
        ("package://robot/x%2f..%2f..%2fsecret.stl", "package://robot/x%2f..%2f..%2fsecret.stl"),
        ("package://robot//etc/passwd.stl", "asset_uri_allowlist does not allow "),
        ("package://../../etc/passwd", "asset_uri_allowlist does not allow "),
        ("package://robot/meshes/notes.txt", "asset_uri_allowlist does not allow "),
        ("package://robot/%00.stl", "package://robot/%00.stl leads out of a package"),
        ("package://robot", "asset_uri_allowlist does not allow package://robot"),
        ("file:///etc/passwd", "only package:// addresses are served, not file:///etc/passwd"),
        ("http://example.org/x.stl", "only package:// addresses are served, not http://"),
        ("package://robot/" + 5000 * "x" + ".stl", "an address of 5020 characters is too long"),
        ("\ud800", "only package:// addresses are served"),
    ],
)
def test_nothing_else_is_read(serve, client, share, uri, reason):
    answer = asset(client(serve(share)), uri, 1)
    assert isinstance(answer, str)
    assert answer.startswith(reason)


def test_packages_are_found_in_the_prefixes_of_the_environment(client, tmp_path, monkeypatch):
    folder = tmp_path / "share" / "robot"
    folder.mkdir(parents=True)
    (folder / "a.png").write_bytes(b"png")
    monkeypatch.setenv("AMENT_PREFIX_PATH", f"{tmp_path / 'none'}:{tmp_path}")
    assert asset(client(), "package://robot/a.png", 1) == b"png"


# -- time


def test_the_time_of_the_simulation(serve, client, robot):
    server = serve(use_sim_time=True)
    clock = robot.publisher("/clock", "rosgraph_msgs/msg/Clock")
    publisher = robot.publisher("/chatter")
    robot.wait_until(lambda: clock.subscription_count() == 1)
    one = client(server)
    assert "time" in one.next("serverInfo")["capabilities"]
    time = msg.get_message("rosgraph_msgs/msg/Clock")()
    time.clock.sec, time.clock.nanosec = 12, 34
    clock.publish(msg.serialize(time))
    assert one.next_binary(2) == struct.pack("<BQ", 2, 12_000_000_034)
    one.subscribe("/chatter", 1)
    robot.wait_until(lambda: publisher.subscription_count() == 1)
    robot.say(publisher, "now")
    assert one.message(1)[0] == 12_000_000_034
    assert client(server).next_binary(2) == struct.pack("<BQ", 2, 12_000_000_034)


def test_missing_capability_is_rejected(serve, client, robot):
    one = client(serve(capabilities=("connectionGraph",)))
    info = one.next("serverInfo")
    assert info["capabilities"] == ["connectionGraph"]
    assert "supportedEncodings" not in info
    for op in ("advertise", "getParameters", "subscribeParameterUpdates", "fetchAsset"):
        one.send(op)
        assert one.status()[1].startswith(f"{op} is not supported: ")
    one.socket.send(b"\x01\x01\0\0\0{}")
    assert one.status() == (
        2,
        "publishing is not supported: the server does not have the capability clientPublish",
    )
    one.call(1, 1, b"{}")
    assert one.status() == (
        2,
        "calling services is not supported: the server does not have the capability services",
    )


def test_a_reliable_clock_is_not_needed(serve, client, robot):
    server = serve(use_sim_time=True)
    clock = robot.publisher(
        "/clock", "rosgraph_msgs/msg/Clock", reliability=Reliability.BEST_EFFORT
    )
    robot.wait_until(lambda: clock.subscription_count() == 1)
    clock.publish(msg.serialize(msg.get_message("rosgraph_msgs/msg/Clock")()))
    client(server).next("serverInfo")
