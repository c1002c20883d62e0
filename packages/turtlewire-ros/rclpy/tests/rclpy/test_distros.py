"""Changes of rclpy in Kilted and Lyrical; each program runs in a process of a distribution."""

import pytest
from tests.programs import OUTCOME, lines_in

START = """
import rclpy
from example_interfaces.action import Fibonacci
from example_interfaces.srv import AddTwoInts
from rclpy.action import ActionClient, ActionServer
from rclpy.duration import Duration, Infinite
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import InvalidQoSProfileException, QoSProfile

rclpy.init(args=["program", "--ros-args", "--log-level", "fatal"])
node = rclpy.create_node("node")
"""


def said(distro, program):
    return lines_in(distro, OUTCOME + START + program)


ACTION = """
server = ActionServer(node, Fibonacci, "fibonacci", execute)
client = ActionClient(node, Fibonacci, "fibonacci")
client.wait_for_server()
heard = []
hear = lambda message: heard.append(list(message.feedback.sequence))
sending = client.send_goal_async(Fibonacci.Goal(), hear)
rclpy.spin_until_future_complete(node, sending)
result = sending.result().get_result_async()
rclpy.spin_until_future_complete(node, result)
"""

FEEDBACK = """
def execute(goal):
    goal.publish_feedback(Fibonacci.Feedback(sequence=[1]))
    goal.succeed()
    goal.publish_feedback(Fibonacci.Feedback(sequence=[2]))
    return Fibonacci.Result()
""" + ACTION.replace("result = sending", "rclpy.spin_once(node, timeout_sec=0.5); result = sending")
SHUTDOWN = """
other = rclpy.context.Context()
other.init(args=[])
kept = rclpy.create_node("kept", context=other)
executor = SingleThreadedExecutor()
executor.add_node(node)
rclpy.shutdown()
print(outcome(node.get_name))
is_alive = outcome(node.get_name).startswith("node")
print(kept.get_name(), executor.get_nodes() == ([node] if is_alive else []))
node.destroy_node()
"""
CLOCKS = """
from rclpy.clock import Clock, ClockType, ROSClock
clock = Clock(clock_type=ClockType.ROS_TIME)
print(type(clock).__name__, clock, clock.ros_time_is_active)
print(outcome(ROSClock))
print(type(node.get_clock()).__name__)
"""
SHAPE = "callback should be either be callable with one argument(to get only the message) or two"

#: By subject: a program, and the lines that it prints in each distribution.
CHANGES = {
    "warn() of a logger": (
        "print(outcome(lambda: node.get_logger().warn('text')))",
        {
            "jazzy": "False []",
            "kilted": "False ['DeprecationWarning: Deprecated in favor of "
            ":py:classmethod:RcutilsLogger.warning:.']",
            "lyrical": "AttributeError: 'RcutilsLogger' object has no attribute 'warn'",
        },
    ),
    "arguments of a QoSProfile": (
        (
            "print(outcome(lambda: QoSProfile(1, 5).depth))\n"
            "print(outcome(lambda: QoSProfile(depth=5, reliability=None).reliability))\n"
            "print(outcome(lambda: QoSProfile(depth=5, foo=1)))"
        ),
        {
            "jazzy": (
                "TypeError: QoSProfile.__init__() takes 1 positional argument but 3 were given\n"
                "AssertionError: expected an object of type int, got None\n"
                "AssertionError: Invalid arguments passed to constructor: dict_keys(['depth', "
                "'foo'])"
            ),
            "kilted": (
                "5 []\n1 []\n"
                "TypeError: QoSProfile.__init__() got an unexpected keyword argument 'foo'"
            ),
            "lyrical": (
                "5 []\n1 []\n"
                "TypeError: QoSProfile.__init__() got an unexpected keyword argument 'foo'"
            ),
        },
    ),
    "a transition that the state does not have": (
        (
            "from rclpy.lifecycle import LifecycleNode\n"
            "managed = LifecycleNode('managed')\n"
            "managed.get_logger().error = print\n"
            "print(outcome(managed.trigger_activate).split(':')[0])\n"
            "print(managed.trigger_configure())"
        ),
        {
            "jazzy": "RCLError\nTransitionCallbackReturn.SUCCESS",
            "kilted": (
                "Unable to start transition 3 from current state (1, 'unconfigured')\n"
                "TransitionCallbackReturn.ERROR []\nTransitionCallbackReturn.SUCCESS"
            ),
        },
    ),
    "a context in a with statement": (
        (
            "from rclpy.context import Context\n"
            "ready, fresh = Context(), Context()\n"
            "ready.init(args=[])\n"
            "with ready: print(ready.ok())\n"
            "print(ready.ok())\n"
            "print(outcome(lambda: fresh.__enter__().ok()))"
        ),
        {
            "jazzy": "True\nFalse\nTrue []",
            "kilted": (
                "True\nFalse\nTrue ['UserWarning: init() must be called on a Context before using "
                "it in a Python context manager. Calling init() with no arguments, this usage is "
                "deprecated']"
            ),
        },
    ),
    "types of parameters": (
        (
            "from rclpy.parameter import Parameter\n"
            "node.declare_parameter('speed', 1.5)\n"
            "print(Parameter.Type.INTEGER == 2, Parameter('speed', value=2))\n"
            "print(node.set_parameters([Parameter('speed', value='x')])[0].reason)\n"
            "print(outcome(lambda: Parameter('speed', Parameter.Type.INTEGER, 'x')))"
        ),
        {
            "jazzy": (
                "False Parameter(name='speed', type_=Type.INTEGER, value=2)\n"
                "Wrong parameter type, expected 'Type.DOUBLE' got 'Type.STRING'\n"
                "ValueError: Type 'Type.INTEGER' and value 'x' do not agree"
            ),
            "kilted": (
                "True Parameter(name='speed', type_=Type.INTEGER, value=2)\n"
                "Wrong parameter type, expected '3' got '4'\n"
                "ValueError: Type '2' and value 'x' do not agree"
            ),
        },
    ),
    "names of policies in rmw": (
        (
            "from rclpy.qos import LivelinessPolicy, QoSHistoryPolicy\n"
            "print(outcome(lambda: QoSHistoryPolicy.RMW_QOS_POLICY_HISTORY_KEEP_LAST.name))\n"
            "print(hasattr(LivelinessPolicy, 'RMW_QOS_POLICY_DURABILITY_UNKNOWN'))"
        ),
        {
            "jazzy": (
                "KEEP_LAST ['UserWarning: HistoryPolicy.RMW_QOS_POLICY_HISTORY_KEEP_LAST is "
                "deprecated. Use HistoryPolicy.KEEP_LAST instead.']\nTrue"
            ),
            "lyrical": ("AttributeError: RMW_QOS_POLICY_HISTORY_KEEP_LAST\nFalse"),
        },
    ),
    "a call that takes too long": (
        (
            "client = node.create_client(AddTwoInts, 'add')\n"
            "print(outcome(lambda: client.call(AddTwoInts.Request(), timeout_sec=0.01)))"
        ),
        {"jazzy": "None []", "kilted": "TimeoutError: ", "lyrical": "TimeoutError: "},
    ),
    "a node after the shutdown of its context": (
        SHUTDOWN,
        {
            "jazzy": "node []\nkept True",
            "kilted": "InvalidHandle: cannot use Destroyable because destruction was requested\n"
            "kept True",
        },
    ),
    "a profile without history and depth": (
        "print(outcome(QoSProfile))",
        {
            "jazzy": "InvalidQoSProfileException: "
            "('Invalid QoSProfile', 'History and/or depth settings are required.')",
            "kilted": "InvalidQoSProfileException: History and/or depth settings are required.",
        },
    ),
    "how long the results of actions are kept": (
        (
            "server = ActionServer(node, Fibonacci, 'fibonacci', lambda goal: Fibonacci.Result())\n"
            "print(server._result_timeout_ns / 1e9)"
        ),
        {"jazzy": "900.0", "kilted": "10.0", "lyrical": "10.0"},
    ),
    "feedback after the end of a goal": (
        FEEDBACK + "print(heard)",
        {"jazzy": "[[1], [2]]", "kilted": "[[1], [2]]", "lyrical": "[[1]]"},
    ),
    "a goal of another type": (
        (
            "client = ActionClient(node, Fibonacci, 'fibonacci')\n"
            "print(outcome(lambda: client.send_goal_async(Fibonacci.Result())))"
        ),
        {
            "jazzy": "TypeError: ",
            "kilted": "TypeError: Expected goal type (<class "
            "'example_interfaces.action._fibonacci.Metaclass_Fibonacci_Goal'>) but received "
            "(<class 'example_interfaces.action._fibonacci.Fibonacci_Result'>)",
        },
    ),
    "the last preset": (
        "from rclpy.qos import QoSPresetProfiles; print(QoSPresetProfiles.short_keys()[-1])",
        {"jazzy": "best_available", "kilted": "rosout_default"},
    ),
    "clocks of ROS time": (
        CLOCKS,
        {
            "kilted": "ROSClock Clock(clock_type=ROS_TIME) False\n"
            "Clock(clock_type=ROS_TIME) []\nROSClock",
            "lyrical": "Clock Clock(clock_type=ROS_TIME) False\n"
            "ROSClock(clock_type=ROS_TIME) ['DeprecationWarning: Use "
            "Clock(clock_type=ClockType.ROS_TIME) instead']\nClock",
        },
    ),
    "a callback of a wrong shape": (
        (
            "from std_msgs.msg import String\n"
            "print(outcome(lambda: node.create_subscription(String, 't', lambda: None, 1)))"
        ),
        {
            "kilted": f"RuntimeError: Subscription.__init__(): {SHAPE} "
            "(to get message and message info)",
            "lyrical": f"RuntimeError: Subscription {SHAPE} (to get message and message info)",
        },
    ),
}


@pytest.mark.parametrize(
    ("subject", "distro"), [(each, distro) for each in CHANGES for distro in CHANGES[each][1]]
)
def test_changes(subject, distro):
    program, expected = CHANGES[subject]
    assert said(distro, program) == expected[distro].split("\n")


@pytest.mark.parametrize(
    ("distro", "kind"), [("jazzy", "UserWarning"), ("kilted", "UserWarning"), ("lyrical", None)]
)
def test_a_declaration_of_a_name_alone(distro, kind):
    (first, *_) = said(distro, "print(outcome(lambda: node.declare_parameter('speed').value))")
    if kind:
        assert first.startswith(f"None ['{kind}: when declaring parameter named ")
    else:
        assert first == (
            "TypeError: when declaring parameter named 'speed', declaring a parameter only "
            "providing its name is not allowed. You have to either:"
        )


def test_a_goal_that_the_program_ends_by_its_handle():
    program = """
def accepted(goal):
    print(goal.status)
    goal.executing()
    goal.executing()
    print(goal.status)
    goal.succeed(Fibonacci.Result(sequence=[7]))
    goal.succeed if goal.is_active else print("done")

server = ActionServer(node, Fibonacci, "fibonacci", handle_accepted_callback=accepted)
""" + ACTION.replace('server = ActionServer(node, Fibonacci, "fibonacci", execute)', "")
    program += "print(result.result().status, list(result.result().result.sequence))"
    assert said("jazzy", program) == ["1", "2", "done", "4 [7]"]


@pytest.mark.parametrize("module", ["qos_event", "topic_endpoint_info"])
def test_modules_that_lyrical_dropped(module):
    program = f"import importlib; print(outcome(lambda: importlib.import_module('rclpy.{module}')))"
    assert said("kilted", program)[0].startswith("<module")
    assert said("lyrical", program) == [f"ModuleNotFoundError: No module named 'rclpy.{module}'"]


def test_jazzy_has_the_names_that_came_later():
    program = """
from rclpy.endpoint_info import EndpointTypeEnum
from rclpy.timer import TimerInfo
print([kind.name for kind in EndpointTypeEnum])
second = Duration(seconds=1)
print((second + second * 0.5 - Duration(nanoseconds=1)).nanoseconds)
print(second * float("inf") == Infinite)
print(outcome(lambda: second * float("nan")))
print(outcome(lambda: second * float("-inf")))
for wrong in (lambda: 2 * second, lambda: -second, lambda: second + 1):
    print(outcome(wrong)[:9])
told = []
def tick(info: TimerInfo): told.append(info)
timer = node.create_timer(0.01, tick)
while not told:
    rclpy.spin_once(node)
timer.callback = lambda: told.append("plain")
while "plain" not in told:
    rclpy.spin_once(node)
late = told[0].actual_call_time - told[0].expected_call_time
print(late.nanoseconds >= 0, told[0].actual_call_time.clock_type.name)
with rclpy.init(context=rclpy.context.Context()) as context:
    print(context.ok())
print(context.ok())
"""
    assert said("jazzy", program) == [
        "['INVALID', 'PUBLISHER', 'SUBSCRIPTION', 'CLIENT', 'SERVER']",
        "1499999999",
        "True",
        "ValueError: Can't multiply duration with nan",
        "ValueError: Can't multiply duration with nan",
        *["TypeError"] * 3,
        "True ROS_TIME",
        "True",
        "False",
    ]


def test_jazzy_has_the_members_that_came_later():
    program = """
from datetime import datetime
from rclpy.clock import ClockType
from rclpy.task import FutureState
from rclpy.time import Time

moment = Time(seconds=1_700_000_000, nanoseconds=250_000_000)
print(moment.to_datetime() == datetime.fromtimestamp(1_700_000_000.25))
print(outcome(lambda: Time(clock_type=ClockType.STEADY_TIME).to_datetime()))
print([state.name for state in FutureState])
server = ActionServer(node, Fibonacci, "fibonacci", lambda goal: Fibonacci.Result())
print(node.get_action_names_and_types())
print(node.get_action_server_names_and_types_by_node("node", "/"))
print(node.get_action_client_names_and_types_by_node("node", "/"))
rclpy.try_shutdown(uninstall_handlers=True)
rclpy.try_shutdown()
print(rclpy.ok())
"""
    fibonacci = "[('/fibonacci', ['example_interfaces/action/Fibonacci'])]"
    assert said("jazzy", program) == [
        "True",
        "TypeError: Time object's clock type should be either ROS_TIME or SYSTEM_TIME",
        "['PENDING', 'CANCELLED', 'FINISHED']",
        fibonacci,
        fibonacci,
        "[]",
        "False",
    ]


@pytest.mark.parametrize(
    ("given", "depth", "durability"),
    [("", 1000, "TRANSIENT_LOCAL"), (", rosout_qos_profile=7", 7, "VOLATILE")],
)
def test_the_quality_of_service_of_rosout(given, depth, durability):
    program = f"""
loud = rclpy.create_node("loud"{given})
(info,) = [i for i in node.get_publishers_info_by_topic("/rosout") if i.node_name == "loud"]
print(info.qos_profile.depth, info.qos_profile.durability.name)
"""
    assert said("jazzy", program) == [f"{depth} {durability}"]


@pytest.mark.parametrize("middleware", ["local", "rmw_cyclonedds_cpp"])
@pytest.mark.parametrize(
    ("distro", "type_hash"),
    [
        ("kilted", "INVALID"),
        ("lyrical", "RIHS01_e118de6bf5eeb66a2491b5bda11202e7b68f198d6f67922cf30364858239c81a"),
    ],
)
def test_services_announce_their_hash(middleware, distro, type_hash):
    program = """
service = node.create_service(AddTwoInts, "add", print)
client = node.create_client(AddTwoInts, "add")
client.wait_for_service()
for infos in (node.get_servers_info_by_service("add"), node.get_clients_info_by_service("add")):
    print(*(info.service_type_hash for info in infos))
"""
    choice = f"import os; os.environ['RMW_IMPLEMENTATION'] = '{middleware}'"
    assert lines_in(distro, choice + START + program) == [type_hash] * 2


# Tags in parameter files, which choose the type of a value in Lyrical.

VALUES = {
    "!!str true": "'true'",
    "!!str 1": "'1'",
    "!!str": "''",
    "!!float 10": "10.0",
    '!!float "1e3"': "1000.0",
    "!!float abc": "Error parsing value abc at line 1",
    "!!int 0x10": "16",
    "!!int '7'": "7",
    "!!int 1.5": "Error parsing value 1.5 at line 1",
    "!!int 9223372036854775808": "Error parsing value 9223372036854775808 at line 1",
    "!!bool yes": "True",
    "!!bool 'off'": "False",
    "!!bool 1": "Error parsing value 1 at line 1",
    "!!binary aGk=": "[b'h', b'i']",
    "!!binary aGk": "Error parsing value aGk at line 1",
    "!!binary '*'": "Error parsing value * at line 1",
    "!!null x": 'Unsupport tag "tag:yaml.org,2002:null" at line 1',
    "!!timestamp 2026-01-01": 'Unsupport tag "tag:yaml.org,2002:timestamp" at line 1',
    "!own 1": 'Unsupport tag "!own" at line 1',
    "! 1": "1",
    "!!seq 1": "Error parsing value 1 at line 1",
    "!!seq [1, !!int '2']": "[1, 2]",
    "[!!float 1, 2.5]": "[1.0, 2.5]",
    "[!!str 1, 2]": "Sequence should be of same type. Value type 'integer' do not belong "
    "at line_num 1",
    "!!int [1]": 'Unsupport tag "tag:yaml.org,2002:int" at line 1',
    "!!binary [aGk=]": "Byte array must be encoded as a base64 string, not a sequence, "
    "cannot parse value aGk= at line 1",
}  # fmt: skip

READ = """
from rclpy.impl.rcl_yaml_param_parser import parse_value
for text in TEXTS:
    try:
        print(repr(parse_value(text)))
    except ValueError as error:
        print(error)
"""

NODE = """
import pathlib, rclpy, tempfile
with tempfile.TemporaryDirectory() as folder:
    file = pathlib.Path(folder, "p.yaml")
    parameters = "key: !!binary aGk=\\n    speed: !!float 2"
    file.write_text(f"n:\\n  ros__parameters: !!map\\n    {parameters}\\n")
    rclpy.init(args=["--ros-args", "--params-file", str(file), "-p", "name:=!!str 5"])
    node = rclpy.create_node("n", automatically_declare_parameters_from_overrides=True)
    for name in ("key", "speed", "name"):
        print(node.get_parameter(name).type_.name, node.get_parameter(name).value)
"""


def test_tags_choose_the_type_in_lyrical():
    program = READ.replace("TEXTS", repr(list(VALUES)))
    assert lines_in("lyrical", program) == list(VALUES.values())


def test_up_to_kilted_only_the_tag_of_strings_counts():
    texts = ["!!str true", "!!float 10", "!!bool 'off'", "!!null x", "!!binary aGk="]
    program = READ.replace("TEXTS", repr(texts))
    assert lines_in("kilted", program) == ["'true'", "10", "'off'", "'x'", "'aGk='"]


def test_a_node_has_the_parameters_of_tagged_values():
    values = ["BYTE_ARRAY [b'h', b'i']", "DOUBLE 2.0", "STRING 5"]
    assert lines_in("lyrical", NODE) == values
