"""Actions in bags: recorded, shown and played as such."""

import sys

import pytest
from tests.programs import lines_in

from rosbag2_py import PlayOptions, RecordOptions
from rosbag2_transport.play_filter import mistakes, played_topics
from rosbag2_transport.topic_filter import TopicFilter, action_topic
from turtlewire.bag import BagWriter, open_bag

from .conftest import end

FIBONACCI = "example_interfaces/action/Fibonacci"
ADD = "example_interfaces/srv/AddTwoInts"
ACTION = {
    "/fib/_action/feedback": f"{FIBONACCI}_FeedbackMessage",
    "/fib/_action/status": "action_msgs/msg/GoalStatusArray",
    "/fib/_action/send_goal/_service_event": f"{FIBONACCI}_SendGoal_Event",
    "/fib/_action/cancel_goal/_service_event": "action_msgs/srv/CancelGoal_Event",
    "/fib/_action/get_result/_service_event": f"{FIBONACCI}_GetResult_Event",
}
OTHERS = {
    "/chat": "std_msgs/msg/String",
    "/add/_service_event": f"{ADD}_Event",
    "/x/_action/status": "std_msgs/msg/String",  # not of an action
}

SERVER = """
import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionServer
from rclpy.qos import qos_profile_system_default
from rclpy.service_introspection import ServiceIntrospectionState
rclpy.init()
node = rclpy.create_node("server")
def execute(handle):
    feedback = Fibonacci.Feedback(sequence=[0, 1])
    handle.publish_feedback(feedback)
    handle.succeed()
    print("executed", handle.request.order, flush=True)
    return Fibonacci.Result(sequence=[0, 1, 1])
server = ActionServer(node, Fibonacci, "/fib", execute)
contents = ServiceIntrospectionState.CONTENTS
for service in (server._goal_service, server._cancel_service, server._result_service):
    service.configure_introspection(node.get_clock(), qos_profile_system_default, contents)
print("ready", flush=True)
rclpy.spin(node)
"""


def test_parts_of_an_action_have_its_names_and_types():
    found = [action_topic(name, kind) for name, kind in ACTION.items()]
    assert [each.action for each in found] == ["/fib"] * 5
    assert [each.part for each in found] == [
        *("feedback", "status", "send_goal", "cancel_goal", "get_result")
    ]
    assert {each.type for each in found} == {FIBONACCI, ""}
    assert [action_topic(name, kind) for name, kind in OTHERS.items()] == [None] * 3


@pytest.mark.parametrize(
    ("options", "taken"),
    [
        ({"all_actions": True}, ACTION),
        ({"actions": ["/fib"]}, ACTION),
        ({"actions": ["/nope"]}, ()),
        ({"all_actions": True, "exclude_actions": ["/fib"]}, ()),
        ({"all_actions": True, "exclude_regex": "^/fi"}, ()),
        ({"regex": "^/fib$", "actions": ["/nope"]}, ACTION),
        # In Jazzy, only the events count, as those of services.
        (
            {"all_services": True},
            [name for name in ACTION if "event" in name] + ["/add/_service_event"],
        ),
        ({"all_topics": True}, ["/chat"]),
    ],
)
def test_recorded_topics_of_actions(options, taken):
    chosen = TopicFilter(RecordOptions(**options), lambda *_: None)
    found = {
        name
        for name, kind in {**ACTION, **OTHERS}.items()
        if chosen.takes(name, [kind], published=True, heard=True)
    }
    assert found == set(taken)


PROGRAM = f"""
from rosbag2_py import Info, PlayOptions, RecordOptions
from rosbag2_transport.topic_filter import TopicFilter
from ros2cli.main import main
topics = {ACTION!r} | {OTHERS!r}
for options in ({{"all_services": True}}, {{"all_topics": True, "include_hidden_topics": True}}):
    chosen = TopicFilter(RecordOptions(**options), print)
    print(sorted(n for n, k in topics.items() if chosen.takes(n, [k], published=True, heard=True)))
"""


def test_from_kilted_on_actions_are_neither_topics_nor_services():
    services, topics = lines_in("kilted", PROGRAM)
    assert services == "['/add/_service_event']"
    assert topics == "['/chat', '/x/_action/status']"


@pytest.fixture
def bag(tmp_path):
    path = tmp_path / "actions"
    with BagWriter(path) as writer:
        for number, (name, kind) in enumerate({**ACTION, **OTHERS}.items(), 1):
            writer.add_topic(name, kind)
            for _ in range(number):
                writer.append(name, b"\0\1\0\0" + bytes(60), number, number)
    return path


TYPE = "Type: std_msgs/msg/String"
CDR = "Serialization Format: cdr"
INFO = f"""Messages:          14
Topic information: Topic: /chat | {TYPE} | Count: 6 | {CDR}
                   Topic: /x/_action/status | {TYPE} | Count: 8 | {CDR}
Services:          1
Service information: Service: /add | Type: {ADD} | Event Count: 7 | {CDR}
Actions:           1
Action information:
  Action: /fib | Type: {FIBONACCI} | Topics: 2 | Service: 3 | {CDR}
    Topic: feedback | Count: 1
    Topic: status | Count: 2
    Service: send_goal | Event Count: 3
    Service: cancel_goal | Event Count: 4
    Service: get_result | Event Count: 5
"""


def test_the_text_about_a_bag_from_kilted_on(bag):
    program = f"from rosbag2_py import Info; print(Info().read_metadata({str(bag)!r}))"
    shown = lines_in("kilted", program)
    start = next(i for i, line in enumerate(shown) if line.startswith("Messages:"))
    assert "\n".join(shown[start:]) == INFO
    program = f"from ros2cli.main import main; main(['bag', 'info', '-t', {str(bag)!r}])"
    assert lines_in("lyrical", program) == ["/chat", "/x/_action/status"]
    program = f"from ros2cli.main import main; main(['bag', 'info', '-v', {str(bag)!r}])"
    assert "    Service: cancel_goal | Request Count: 4 | Response Count: 0" in lines_in(
        "lyrical", program
    )


def test_the_text_about_a_bag_in_jazzy(bag):
    program = f"from rosbag2_py import Info; print(Info().read_metadata({str(bag)!r}))"
    shown = "\n".join(lines_in("jazzy", program))
    assert "Service:           4\n" in shown
    assert "Topic: /fib/_action/feedback | " in shown
    assert "Action" not in shown.replace("_action", "").replace("/action/", "")


def test_played_topics_of_actions(bag):
    def played(**options):
        return set(played_topics(opened, PlayOptions(**options)))

    with open_bag(bag) as opened:
        assert played() == {*ACTION, *OTHERS}
        assert played(actions_to_filter=["/fib"], topics_to_filter=["/chat"]) == {
            *ACTION,
            *("/chat", "/add/_service_event"),
        }
        assert played(exclude_actions_to_filter=["/fib"]) == {*OTHERS}
        assert list(mistakes(opened, PlayOptions(actions_to_filter=["/fob"]))) == [
            "The bag has no action '/fob'. Did you mean: /fib"
        ]


def test_an_action_is_recorded_and_its_goals_are_sent_again(run, bag_verb, tmp_path):
    server = run(sys.executable, "-c", SERVER)
    server.wait_for("ready")
    recorder = bag_verb("record", "--actions", "/fib", "-o", "bag")
    recorder.wait_for("Subscribed to topic", count=5)
    program = "import sys; from ros2cli.main import main; sys.exit(main(sys.argv[1:]))"
    words = ("action", "send_goal", "/fib", FIBONACCI, "{order: 7}", "--feedback")
    client = run(sys.executable, "-c", program, *words)
    assert client.wait() == 0
    assert end(recorder) == 0
    with open_bag(tmp_path / "bag") as opened:
        assert set(opened.topics) == set(ACTION)
    # Another server, because one does not accept a goal of the same id again.
    server.process.terminate()
    server.wait()
    another = run(sys.executable, "-c", SERVER)
    another.wait_for("ready")
    player = bag_verb("play", "bag", "--send-actions-as-client")
    another.wait_for("executed 7")
    assert player.wait() == 0


def test_an_unknown_action_is_told(bag_verb, run):
    run(sys.executable, "-c", SERVER).wait_for("ready")
    recorder = bag_verb("record", "--actions", "/fob", "-o", "bag")
    recorder.wait_for("There is no action '/fob' yet. Did you mean: /fib")
    assert end(recorder) == 0
