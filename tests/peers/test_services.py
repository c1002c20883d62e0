"""Services, parameters and actions work with real nodes on Fast DDS, in both directions.

Where they do not, no request of ours ever reaches a server on Fast DDS, and each command says why:
such a server reads the 16 bytes in front of the fields as fields. The node then allocates gigabytes
or never answers again.
"""

import re
from pathlib import Path

import pytest

import rclpy
import rclpy.task
from action_msgs.msg import GoalStatus
from rclpy.action import ActionClient
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter_client import AsyncParameterClient
from turtlewire import msg
from turtlewire.errors import UncallableServiceError
from turtlewire.wire import report
from turtlewire.wire.base import ServiceTypes, TypeId
from turtlewire.wire.cyclone.fast_dds import FAST_DDS
from turtlewire.wire.cyclone.samples import NO_IDENTITY
from turtlewire.wire.qos import QoS
from turtlewire.wire.services import RequestId, join_header, require_callable

pytestmark = pytest.mark.slow

LONG = 60_000_000_000
MOST_RSS_KB = 200_000
ADVICE = (
    "Start the {} with RMW_IMPLEMENTATION=rmw_cyclonedds_cpp, or both ends with "
    "RMW_IMPLEMENTATION=rmw_zenoh_cpp."
)
#: One datagram in twenty is not sent.
LOSSY = (
    "<CycloneDDS><Domain><Internal><Test><XmitLossiness>50</XmitLossiness></Test></Internal>"
    "</Domain></CycloneDDS>"
)
#: Participants that are killed are missed after two seconds, not after 10 (Cyclone DDS) and 20.
SHORT_LEASE = "<Discovery><LeaseDuration>2s</LeaseDuration></Discovery>"
SHORT_LEASE_PROFILE = """<profiles xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles">
  <participant profile_name="short" is_default_profile="true"><rtps><builtin><discovery_config>
    <leaseDuration><sec>2</sec></leaseDuration>
    <leaseAnnouncement><sec>1</sec></leaseAnnouncement>
  </discovery_config></builtin></rtps></participant>
</profiles>"""
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


def assert_sound(peer, real, called=()):
    """The node was not harmed: it got no request of ours but ``called``, and answers a client."""
    client = real("client", "3")
    assert client.wait() == 0, client.text
    assert re.findall(r"answer: (\w+)", client.text) == ["0", "1", "2"]
    assert re.findall(r"called (-?\d+)", peer.text) == [*called, "0", "1", "2"]
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


@pytest.fixture
def ours(context):
    return context.create_node("ours")


@pytest.fixture
def obstacle(monkeypatch):
    """Services with Fast DDS do not work in this process."""
    monkeypatch.setattr(report, "_said", set())
    monkeypatch.setattr(FAST_DDS, "obstacle", "they need Linux")


def taken(context, entity, count):
    """Wait for requests to a server, or replies to a client; return them with their CDR."""
    wait_set, found = context.create_wait_set(), []
    wait_set.attach(entity)
    # Without anything to take, an entity becomes ready when DDS misses the last peer that sent.
    while len(found) < count:
        assert wait_set.wait(LONG) == [entity]
        found += entity.take()
    wait_set.close()
    return found


def test_commands_call_services_parameters_and_actions(peer, real, command, tmp_path):
    values = tmp_path / "values.yaml"
    values.write_text("/peer:\n  ros__parameters:\n    speed: 4.5\n")
    goal = ["/fibonacci", "test_msgs/action/Fibonacci"]
    for words, told in (
        (["param", "list", "/peer"], "  speed\n"),
        (["param", "list"], "/peer:\n  speed\n"),
        (["param", "get", "/peer", "speed"], "Double value is: 1.5"),
        (["param", "set", "/peer", "speed", "2.5"], "Set parameter successful"),
        (["param", "describe", "/peer", "speed"], "  Type: double"),
        (["param", "dump", "/peer"], "    speed: 2.5\n"),
        (["param", "load", "/peer", str(values)], "Set parameter speed successful"),
        (["param", "get", "/peer", "speed"], "Double value is: 4.5"),
        (["lifecycle", "get", "/peer"], "[0]"),
        (
            ["service", "call", "/echo", "test_msgs/srv/BasicTypes", "{int64_value: 77}"],
            "int64_value=77",
        ),
        (
            ["action", "send_goal", "-f", *goal, "{order: 4}"],
            "Goal finished with status: SUCCEEDED",
        ),
    ):
        status, text = command("ros2", *words)
        assert (status, told in text) == (0, True), text
    assert "Feedback:\n    sequence:\n- 0\n- 1\n- 1\n" in text
    assert_sound(peer, real, ["77"])


def test_each_reply_comes_to_its_request_beside_other_clients(peer, real, context, ours, echo):
    types, service = echo
    neighbour = real("client", "1000", "1000")
    # Each client receives the replies to all clients: with the usual depth of 10, those to others
    # push out its own before a busy machine comes to read it.
    clients = [ours.create_client("/echo", types, QoS(depth=1000)) for _ in range(2)]
    for client in clients:
        assert context.graph.wait_for(client.is_ready, LONG)
    for number in range(500):
        text = f"{number}" + "x" * (100_000 if number % 100 == 0 else 10)
        sent = {}
        for client, value in zip(clients, (number, -number), strict=True):
            request = service.Request(int64_value=value, string_value=text)
            sent[client] = client.send_request(msg.serialize(request)), value
        for client, (sequence_number, value) in sent.items():
            ((found, cdr),) = taken(context, client, 1)
            response = msg.deserialize(service.Response, cdr)
            assert (found, response.int64_value) == (sequence_number, value)
            assert response.string_value == text
    assert neighbour.wait() == 0
    assert re.findall(r"answer: (\w+)", neighbour.text) == [str(n) for n in range(1000)]


def test_many_services_of_one_type_work_in_both_directions(real, venv, context):
    crowd = real("crowd")
    crowd.wait_for("up")
    with rclpy.init():
        executor, nodes = SingleThreadedExecutor(), []
        for number in range(20):
            nodes.append(rclpy.create_node(f"ours{number}"))
            nodes[-1].declare_parameter("number", number)
            executor.add_node(nodes[-1])
        clients = [AsyncParameterClient(node, f"peer{number}") for number, node in enumerate(nodes)]
        for client in clients:
            assert client.wait_for_services(LONG / 1e9)
        found = []
        for client in clients:
            future = client.get_parameters(["number"])
            executor.spin_until_future_complete(future, LONG / 1e9)
            found.append(future.result().values[0].integer_value)
        assert found == list(range(20))
        asker = real("ask", *(f"ours{number}" for number in range(20)))
        while asker.process.poll() is None:
            executor.spin_once(0.1)
    assert asker.wait() == 0, asker.text
    assert f"numbers: {' '.join(map(str, range(20)))}" in asker.text


def test_an_action_client_gets_feedback_and_cancels(peer, venv, monkeypatch):
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(venv))
    fibonacci = msg.get_action("test_msgs/action/Fibonacci")
    with rclpy.init():
        node = rclpy.create_node("ours")
        client, heard = ActionClient(node, fibonacci, "fibonacci"), rclpy.task.Future()

        def result(future):
            rclpy.spin_until_future_complete(node, future, timeout_sec=LONG / 1e9)
            return future.result()

        def feedback(message):
            if not heard.done():
                heard.set_result(message.feedback.sequence)

        assert client.wait_for_server(LONG / 1e9)
        handle = result(client.send_goal_async(fibonacci.Goal(order=10_000), feedback))
        assert list(result(heard)) == [0, 1, 1]
        assert len(result(handle.cancel_goal_async()).goals_canceling) == 1
        for _ in range(2):  # the second asks for a result that is there
            answer = result(handle.get_result_async())
            assert answer.status == GoalStatus.STATUS_CANCELED
            assert list(answer.result.sequence[:3]) == [0, 1, 1]


def test_nodes_on_fast_dds_are_served(real, serve):
    def told(*words):
        client = real(*words)
        assert client.wait() == 0, client.text
        return client.text

    serve()
    small = real("client", "30", "100")
    small.wait_for("answer: 0")  # a client that joins during replies of 100 kB may lose step
    for client in (small, real("client", "30", "100000")):
        assert client.wait() == 0
        assert re.findall(r"answer: (\w+)", client.text) == [str(n) for n in range(30)]
    text = told("parameters", "/ours")
    assert re.search(r"names: .*\bspeed\b", text)
    assert text.endswith("set: True\nspeed: 2.5")
    text = told("action", "5")
    result = "result: 4 [0, 1, 1, 2, 3, 5]"
    assert text.endswith(f"accepted: True\nfeedback: [0, 1, 1]\n{result}\n{result}")
    text = told("action", "10000", "cancel")
    assert "cancelled: 1\nresult: 5 [0, 1, 1" in text


def test_a_killed_server_is_noticed_by_both_sides(real, serve, context, ours, echo, tmp_path):
    profile = tmp_path / "profile.xml"
    profile.write_text(SHORT_LEASE_PROFILE)
    variables = ("FASTRTPS_DEFAULT_PROFILES_FILE", "FASTDDS_DEFAULT_PROFILES_FILE")
    server, seer = serve(CYCLONEDDS_URI=SHORT_LEASE), real("gone")
    seer.wait_for("server: True")
    server.process.kill()
    seer.wait_for("gone")
    graph = context.graph  # else the client would be ready for the server that was killed
    assert graph.wait_for(lambda: "/echo" not in graph.service_names_and_types(), LONG)
    client = ours.create_client("/echo", echo[0], QoS())
    peer = real("node", **dict.fromkeys(variables, profile))
    assert context.graph.wait_for(client.is_ready, LONG)
    request = msg.serialize(echo[1].Request(int64_value=5))
    client.send_request(request)
    taken(context, client, 1)
    peer.process.kill()
    client.send_request(request)  # nothing answers
    assert context.graph.wait_for(lambda: not client.is_ready(), LONG)
    real("node")
    assert context.graph.wait_for(client.is_ready, LONG)
    number = client.send_request(request)
    assert [found for found, _ in taken(context, client, 1)] == [number]


def test_not_even_the_first_request_of_a_new_client_is_lost(real, serve):
    serve()
    for _ in range(10):
        client = real("client", "1")
        assert client.wait() == 0
        assert re.findall(r"answer: (\w+)", client.text) == ["0"]


def test_identities_hold_when_datagrams_get_lost(real, serve):
    serve(CYCLONEDDS_URI=LOSSY)
    client = real("client", "40", "100000")  # each answer takes two datagrams
    assert client.wait() == 0
    assert re.findall(r"answer: (\w+)", client.text) == [str(n) for n in range(40)]


def test_a_client_that_dies_before_its_reply_does_no_harm(real, context, ours, echo):
    server = ours.create_service("/echo", echo[0], QoS())
    client = real("client", "1")
    ((request_id, cdr),) = taken(context, server, 1)
    client.process.kill()
    client.wait()
    server.send_response(request_id, msg.serialize(echo[1].Response()))
    client = real("client", "1")
    ((request_id, cdr),) = taken(context, server, 1)
    request = msg.deserialize(echo[1].Request, cdr)
    response = echo[1].Response(string_value=request.string_value)
    server.send_response(request_id, msg.serialize(response))
    client.wait_for("answer: 0")


def test_each_command_says_why_and_does_no_harm(peer, real, command):
    for words, service in COMMANDS:
        status, text = command("ros2", *words, TURTLEWIRE_CORE="python")
        assert status == 1, text
        assert "no services with Fast DDS here: they need the compiled core" in text
        assert reason(service) in text
        assert ADVICE.format("server") in text
    assert_sound(peer, real)


def test_not_even_a_request_sent_at_the_moment_of_discovery_is_read(
    peer, real, context, ours, echo, obstacle
):
    types, service = echo
    client = ours.create_client("/echo", types, QoS())
    assert context.graph.wait_for(lambda: client.requests.subscription_count() == 1, LONG)
    assert not client.is_ready()
    cdr = msg.serialize(service.Request(int64_value=7, string_value="y" * 100))
    with pytest.raises(UncallableServiceError, match=re.escape(reason("/echo"))):
        client.send_request(cdr)
    for number in range(10):  # as a thread does that looked before the server matched
        client.requests.publish(join_header(RequestId(client.client_id, number), cdr))
    assert_sound(peer, real)


def test_a_layout_that_is_not_understood_brings_the_refusal_back(
    peer, real, context, ours, echo, monkeypatch, capfd
):
    monkeypatch.setattr(report, "_said", set())
    monkeypatch.setattr(FAST_DDS, "obstacle", "")  # it is set below
    client = ours.create_client("/echo", echo[0], QoS())
    assert context.graph.wait_for(client.is_ready, LONG)
    cdr = msg.serialize(echo[1].Request(int64_value=5))
    writer = client._identified.requests

    class Refused:
        """A writer whose messages take no identity; they are right requests all the same."""

        def write_identified(self, sent, *_):
            writer._write(sent)
            return NO_IDENTITY

    sound, writer._writer = writer._writer, Refused()
    number = client.send_request(cdr)
    assert [found for found, _ in taken(context, client, 1)] == [number]
    with pytest.raises(UncallableServiceError, match=re.escape(reason("/echo"))):
        client.send_request(cdr)
    assert not client.is_ready()
    assert capfd.readouterr().err.count("has an unexpected layout of messages") == 1
    writer._writer = sound
    assert_sound(peer, real, ["5"])


def test_servers_on_two_middlewares_are_refused_until_one_leaves(peer, context, ours, echo):
    types, service = echo
    client = ours.create_client("/echo", types, QoS())
    graph = context.graph
    assert graph.wait_for(client.is_ready, LONG)
    server = ours.create_service("/echo", types, QoS())
    assert graph.wait_for(lambda: not client.is_ready(), LONG)
    cdr = msg.serialize(service.Request())
    twice = r"it has servers on Cyclone DDS \(.*\) and Fast DDS \(rmw_fastrtps_cpp\), and a request"
    with pytest.raises(UncallableServiceError, match=twice):
        client.send_request(cdr)
    with pytest.raises(UncallableServiceError, match=twice):
        require_callable(graph, "/echo")
    assert server.take() == []
    peer.process.terminate()
    assert graph.wait_for(client.is_ready, LONG)
    assert graph.wait_for(lambda: graph.foreign_servers() == [], LONG)
    number = client.send_request(cdr)
    ((request_id, request),) = taken(context, server, 1)
    assert request_id.sequence_number == number
    assert msg.deserialize(service.Request, request) == service.Request()


def test_requests_of_clients_on_fast_dds_are_dropped_with_one_line(
    real, context, ours, echo, capfd, obstacle
):
    server = ours.create_service("/echo", echo[0], QoS())
    wait_set = context.create_wait_set()
    wait_set.attach(server)
    client = real("client", "2", "100", "3")
    client.wait_for("server: True")
    assert wait_set.wait(LONG) == [server]
    assert server.take() == []
    client.wait()
    assert server.take() == []
    assert re.findall(r"answer: (\w+)", client.text) == ["None", "None"]
    said = capfd.readouterr().err
    assert said.count("no services with Fast DDS here: they need Linux") == 1
    assert said.count("dropped a request of service /echo: its client runs on Fast DDS") == 1
    assert ADVICE.format("client") in said


def test_rclpy_logs_why_it_waits_and_its_futures_fail(peer, echo, capfd, obstacle):
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
    for core in ("native", "python"):
        status, text = command("ros2", "node", "info", "/peer", TURTLEWIRE_CORE=core)
        assert status == 0
        assert "    /echo: test_msgs/srv/BasicTypes\n" in text
        told = (
            "The services of /peer, including parameters and actions, cannot be called from here: "
            f"it runs on Fast DDS (rmw_fastrtps_cpp). {ADVICE.format('node')}"
        )
        assert (told in text) == (core == "python")
        status, text = command("turtlewire", "doctor", TURTLEWIRE_CORE=core)
        told = re.search(
            r"note: \d+ services of nodes on Fast DDS \(rmw_fastrtps_cpp\) cannot be called "
            r"from here, including parameters and actions; topics work. Nodes: /peer.\n"
            rf"    {ADVICE.format('nodes')}",
            text,
        )
        assert bool(told) == (core == "python"), text
        assert re.search(
            r"participants of this domain: .*1 on Fast DDS \(rmw_fastrtps_cpp\)\.", text
        )
