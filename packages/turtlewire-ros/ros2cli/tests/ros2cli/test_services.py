"""`ros2 service` and `ros2 action`: calls with times, details, messages of all interfaces."""

import re
import sys

import pytest
import yaml
from tests.programs import ROS2, ROS2_IN_SHELL, offered

import rclpy
from example_interfaces.action import Fibonacci
from example_interfaces.srv import AddTwoInts
from rclpy.action import ActionClient
from rclpy.qos import qos_profile_services_default
from rclpy.service_introspection import ServiceIntrospectionState
from ros2action.verb.echo import ActionInterfaces
from ros2cli.main import main
from turtlewire import wire

SERVERS = """
import threading
import rclpy
from std_srvs.srv import SetBool
from nav_msgs.srv import GetPlan
rclpy.init()
node = rclpy.create_node("servers", namespace="/some")
def plan(request, response):
    response.plan.header = request.start.header
    return response
planner = node.create_service(GetPlan, "/plan", plan)
sleeper = node.create_service(SetBool, "/sleep", lambda *_: threading.Event().wait())
client = node.create_client(SetBool, "/sleep")
print("ready", flush=True)
rclpy.spin(node)
"""


def start(run, program):
    """Start the servers, and wait until they have announced which node has which endpoint."""
    run(sys.executable, "-c", program).wait_for("ready")
    context = wire.open_context()
    topic, ours = "rq/sleepRequest", context.graph.endpoints_of

    def are_named():
        ends = [*ours(topic, "publisher"), *ours(topic, "subscription")]
        return len(ends) >= 2 and all(end.node is not None for end in ends)

    assert context.graph.wait_for(are_named, 60_000_000_000), context.graph.endpoints()
    context.close()


@pytest.fixture
def servers(run):
    start(run, SERVERS)


def told(capsys, words, status=0):
    assert main(["service", *words.split()]) == status
    return capsys.readouterr()


def test_a_call_waits_no_longer_than_it_is_told(servers, capsys):
    _, error = told(capsys, "call /sleep std_srvs/srv/SetBool {} --timeout 1", 1)
    assert error == "Timed out waiting for response from service /sleep (timeout: 1.0s)\n"
    with pytest.raises(SystemExit):
        main(["service", "call", "/sleep", "std_srvs/srv/SetBool", "--timeout", "0"])
    assert "argument --timeout: value must be positive" in capsys.readouterr().err


def test_stamps_have_the_time_of_each_call(run, servers):
    words = ("call", "/plan", "nav_msgs/srv/GetPlan", "{start: {header: auto}}", "-r", "20")
    verb = run(*ROS2, "service", *words, "--qos-depth", "3")
    stamp = r"response:\n.*?Time\(sec=(\d+), nanosec=(\d+)\)"
    verb.wait_for("^response:", count=2)
    verb.wait_for("plan=", count=2)
    verb.process.terminate()
    verb.wait()
    first, second = [
        int(seconds) * 10**9 + int(rest) for seconds, rest in re.findall(stamp, verb.text)[:2]
    ]
    assert first > 1e18
    assert first + 0.04e9 < second


def test_wrong_qos_of_a_call(capsys):
    with pytest.raises(SystemExit):
        main(["service", "call", "/x", "std_srvs/srv/Empty", "--qos-reliability", "sometimes"])
    assert "invalid choice: 'sometimes'" in capsys.readouterr().err


HASH = "RIHS01_abe9e4bb6b41b40e6789712c00ec8871923e089af3f667a79992a428cff2da0a"
QOS = """      Reliability: RELIABLE
      History (Depth): KEEP_LAST (10)
      Durability: VOLATILE
      Lifespan: Infinite
      Deadline: Infinite
      Liveliness: AUTOMATIC
      Liveliness lease duration: Infinite
"""


def block(kind, writer, reader):
    first, second = f" - Request {writer} :", f" - Response {reader} :"
    return f"""Node name: servers
Node namespace: /some
Service type: std_srvs/srv/SetBool
Service type hash: INVALID
Endpoint type: {kind}
Endpoint count: 2
GIDs:
{first} GID
{second} GID
QoS profiles:
{first}
{QOS}{second}
{QOS}
"""


def test_clients_and_servers_in_detail(servers, capsys):
    shown, _ = told(capsys, "info -v /sleep")
    gids = re.findall(r"(?:[0-9a-f]{2}\.){15}[0-9a-f]{2}", shown)
    assert len(set(gids)) == 4
    client, server = block("CLIENT", "Writer", "Reader"), block("SERVER", "Reader", "Writer")
    text = f"Type: std_srvs/srv/SetBool\nClients count: 1\n{client}Services count: 1\n{server}"
    assert re.sub(r"(?:[0-9a-f]{2}\.){15}[0-9a-f]{2}", "GID", shown) == text
    counts = "Type: std_srvs/srv/SetBool\nClients count: 1\nServices count: 1\n"
    assert told(capsys, "info /sleep").out == counts
    told_of = "Unknown service '/slep'\nDid you mean: /sleep\n"
    assert told(capsys, "info -v /slep", 1) == ("", told_of)


def test_each_client_of_a_node_has_its_own_endpoints(run, capsys):
    program = SERVERS.replace(
        'print("ready"', 'another = node.create_client(SetBool, "/sleep")\nprint("ready"'
    )
    start(run, program)
    shown, _ = told(capsys, "info -v /sleep")
    assert shown.count("Endpoint type: CLIENT\nEndpoint count: 2\n") == 2
    assert len(set(re.findall(r"(?:[0-9a-f]{2}\.){15}[0-9a-f]{2}", shown))) == 6


def details(run, environment):
    """Return what `ros2 service info -v` shows, with servers and command in an environment."""
    run(sys.executable, "-c", SERVERS, environment=environment).wait_for("ready")
    verb = run(*ROS2, "service", "info", "-v", "/sleep", environment=environment)
    assert verb.wait() == 0
    return verb.text


def test_lyrical_announces_the_hash_of_a_service(run):
    assert details(run, {"ROS_DISTRO": "lyrical"}).count(f"Service type hash: {HASH}\n") == 2


def test_on_zenoh_a_client_has_one_endpoint(run):
    text = details(run, {"RMW_IMPLEMENTATION": "rmw_zenoh_cpp"})
    one = "Endpoint count: 1\nGID: GID\nQoS profile:\n  Reliability: RELIABLE\n"
    text = re.sub(r"(?:[0-9a-f]{2}\.){15}[0-9a-f]{2}", "GID", text)
    assert text.count(f"Endpoint type: CLIENT\n{one}") == 1
    assert text.count(f"Endpoint type: SERVER\n{one}") == 1
    assert text.count(f"hash: {HASH}\n") == 2


# `ros2 service echo` with a service that has introspection on.


def add(request, response):
    response.sum = request.a + request.b
    return response


def test_events_of_a_call(run):
    with rclpy.init(args=[]) as context:
        node = rclpy.create_node("adder")
        service = node.create_service(AddTwoInts, "add", add)
        service.configure_introspection(
            node.get_clock(), qos_profile_services_default, ServiceIntrospectionState.CONTENTS
        )
        client = node.create_client(AddTwoInts, "add")
        echo = run(*ROS2, "service", "echo", "/add")
        assert context.wait_for_graph(
            lambda: service._events.wire.subscription_count() == 1, 30_000_000_000
        )
        rclpy.spin_until_future_complete(
            node, client.call_async(AddTwoInts.Request(a=5, b=6)), timeout_sec=60
        )
        echo.wait_for("^---$", count=2)
        lines = echo.text.splitlines()
    assert lines[:2] == ["info:", "  event_type: REQUEST_RECEIVED"]
    assert [line for line in lines if "event_type" in line] == [
        "  event_type: REQUEST_RECEIVED",
        "  event_type: RESPONSE_SENT",
    ]
    received, sent = (part.rstrip("\n") for part in echo.text.removesuffix("---").split("---\n"))
    assert received.endswith("request:\n- a: 5\n  b: 6\nresponse: []")
    assert sent.endswith("request: []\nresponse:\n- sum: 11")


def test_without_introspection_there_is_a_word_of_advice(run):
    echo = run(*ROS2, "service", "echo", "/nothing", "example_interfaces/srv/AddTwoInts")
    echo.wait_for(
        "^No publishers on topic '/nothing/_service_event'; is service introspection on the "
        "client or server enabled\\?$"
    )


def test_unechoable_topics_are_rejected(run, capsys):
    unknown = run(*ROS2, "service", "echo", "/nothing")
    assert (unknown.wait(), unknown.text) == (1, "Could not load the type for the passed service")
    assert main(["service", "echo", "/add", "no/srv/Such"]) == 1
    assert capsys.readouterr().err == "The service type 'no/srv/Such' is invalid\n"


# `ros2 action find` and `ros2 action echo` with a server and a client.

COUNTER = """
import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionServer
rclpy.init()
node = rclpy.create_node("counter")
def count(goal):
    goal.publish_feedback(Fibonacci.Feedback(sequence=range(200)))
    goal.succeed()
    return Fibonacci.Result(sequence=[0, 1])
counter = ActionServer(node, Fibonacci, "count", count)
print("ready", flush=True)
rclpy.spin(node)
"""


@pytest.fixture
def counter(run):
    run(sys.executable, "-c", COUNTER).wait_for("ready")


@pytest.fixture
def count_to(counter):
    """Send a goal and wait for its result, after a subscription to the topic has come."""
    with rclpy.init(args=[]) as context:
        node = rclpy.create_node("customer")
        client = ActionClient(node, Fibonacci, "count")
        client._goal_client.configure_introspection(
            node.get_clock(), qos_profile_services_default, ServiceIntrospectionState.CONTENTS
        )

        def send(order, topic=None):
            own = topic in ("/count/_action/status", "/count/_action/feedback")
            assert topic is None or context.wait_for_graph(
                lambda: node.count_subscribers(topic) == 1 + own, 60_000_000_000
            )
            assert client.wait_for_server(60)
            future = client.send_goal_async(Fibonacci.Goal(order=order))
            rclpy.spin_until_future_complete(node, future, timeout_sec=60)
            result = future.result().get_result_async()
            rclpy.spin_until_future_complete(node, result, timeout_sec=60)
            return result.result().status

        yield send
        client.destroy()


def blocks(text):
    """Return the interface and the YAML of each message that was printed."""
    parts = [part.strip("\n") for part in (text + "\n").split("---\n")]
    heads = [part.partition("\n") for part in parts if part]
    return [(head.removeprefix("interface: "), yaml.safe_load(rest)) for head, _, rest in heads]


def test_names_of_a_type(counter, capsys):
    assert main(["action", "find", "example_interfaces/action/Fibonacci"]) == 0
    assert main(["action", "find", "example_interfaces/action/Fibonacci", "-c"]) == 0
    assert main(["action", "find", "turtlesim/action/RotateAbsolute"]) == 0
    assert capsys.readouterr() == ("/count\n1\n", "")
    assert main(["action", "find", "turtlesim/action/RotatAbsolute", "--count-actions"]) == 0
    near = "Did you mean: turtlesim/action/RotateAbsolute\n"
    assert capsys.readouterr() == ("0\n", near)


def test_messages_of_all_interfaces(run, count_to):
    echo = run(*ROS2, "action", "echo", "/count")
    assert count_to(5, "/count/_action/status") == 4
    echo.wait_for("^  status: 4$")
    echo.wait_for("^interface: FEEDBACK_TOPIC$")
    echo.wait_for("  event_type: RESPONSE_RECEIVED")
    echo.process.terminate()
    echo.wait()
    found = blocks(echo.text)
    events = [value for name, value in found if name == "GOAL_SERVICE"]
    assert [event["info"]["event_type"] for event in events] == [
        "REQUEST_SENT",
        "RESPONSE_RECEIVED",
    ]
    assert [event["request"] and event["request"][0]["goal"] for event in events] == [
        {"order": 5},
        [],
    ]
    assert [event["response"] and event["response"][0]["accepted"] for event in events] == [
        [],
        True,
    ]
    assert {name for name, _ in found} == {"GOAL_SERVICE", "FEEDBACK_TOPIC", "STATUS_TOPIC"}
    (feedback,) = (value for name, value in found if name == "FEEDBACK_TOPIC")
    assert feedback["feedback"]["sequence"] == [*range(128), "..."]


def test_only_the_interfaces_that_are_asked_for(run, count_to):
    words = ("-i", "FEEDBACK_TOPIC | CANCEL_SERVICE", "--csv", "-l", "3")
    echo = run(*ROS2, "action", "echo", "count", "example_interfaces/action/Fibonacci", *words)
    count_to(5, "/count/_action/feedback")
    (line,) = echo.wait_for("_TOPIC|_SERVICE")
    assert line.string.startswith("FEEDBACK_TOPIC,")
    assert line.string.endswith(",0,1,2,...")
    assert len(echo.text.splitlines()) == 1


def test_a_reader_of_an_action_that_ends_early_is_no_error(run, count_to):
    command = f"{ROS2_IN_SHELL} action echo /count -i FEEDBACK_TOPIC | head -1"
    reader = run("bash", "-c", command)
    count_to(5, "/count/_action/feedback")
    reader.wait_for("^interface: FEEDBACK_TOPIC$")
    count_to(5)  # the first line ends `head`; now at the latest a message finds the pipe closed
    assert reader.wait() == 0
    assert reader.text == "interface: FEEDBACK_TOPIC"


@pytest.mark.parametrize(
    ("words", "told", "hint"),
    [
        ("/none", "Cannot find type for '/none'", ""),
        ("/count -i=", "Input action interface name is empty.", ""),
        (
            "/count -i FEEDBACK_TOPIC|STATE_TOPIC",
            '"STATE_TOPIC" is incorrect interface name.',
            "Did you mean: STATUS_TOPIC",
        ),
        (
            "/count -i xyz",
            '"xyz" is incorrect interface name.',
            f"Interfaces: {', '.join(ActionInterfaces.__members__)}",
        ),
        (
            "/count turtlesim/action/RotatAbsolute",
            "The action name '/count' is invalid",
            "Did you mean: turtlesim/action/RotateAbsolute",
        ),
        (
            "/count qq/action/Zzz",
            "The action name '/count' is invalid",
            "There is no action type 'qq/action/Zzz'",
        ),
    ],
)
def test_wrong_words_of_action_echo(capsys, words, told, hint):
    assert main(["action", "echo", *words.split()]) == 1
    assert capsys.readouterr() == ("", f"{told}\n{hint}\n" if hint else f"{told}\n")


def test_a_name_that_is_near(counter, capsys):
    assert main(["action", "echo", "/coumt"]) == 1
    assert capsys.readouterr().err == "Cannot find type for '/coumt'\nDid you mean: /count\n"


def test_an_action_without_a_server_is_told_of(run):
    words = ("/nothing", "example_interfaces/action/Fibonacci", "-i", "STATUS_TOPIC")
    echo = run(*ROS2, "action", "echo", *words)
    echo.wait_for("^No publishers on '/nothing/_action/status'; is a server of the action running")


def test_completion_of_actions():
    assert offered("ros2 action ec") == {"echo"}
    assert offered("ros2 action find example_interfaces/action/Fib") == {
        "example_interfaces/action/Fibonacci"
    }
