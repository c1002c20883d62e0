"""Parts of rclpy's API that `tests/surface` does not cover.

Values of enumerations of ROS 2's C extension, base classes of errors, aliases, and attributes that
constructors set.
"""

import ast
import importlib
import json
import subprocess
import sys
from pathlib import Path

import pytest

import rclpy.node
import rclpy.qos
from rclpy.lifecycle import LifecycleNode
from rclpy.node import Node
from tests import places

GOLDEN = places.GOLDEN / "surface.json"

CONSTANTS = """
rclpy.signals.SignalHandlerOptions: NO=0 SIGINT=1 SIGTERM=2 ALL=3
rclpy.qos.QoSCompatibility: OK=0 WARNING=1 ERROR=2
rclpy.parameter.Parameter.Type: NOT_SET=0 BOOL=1 INTEGER=2 DOUBLE=3 STRING=4 BYTE_ARRAY=5 BOOL_ARRAY=6 INTEGER_ARRAY=7 DOUBLE_ARRAY=8 STRING_ARRAY=9
rclpy.service_introspection.ServiceIntrospectionState: OFF=0 METADATA=1 CONTENTS=2
rclpy.lifecycle.TransitionCallbackReturn: SUCCESS=97 FAILURE=98 ERROR=99
rclpy.event_handler.QoSPublisherEventType: RCL_PUBLISHER_OFFERED_DEADLINE_MISSED=0 RCL_PUBLISHER_LIVELINESS_LOST=1 RCL_PUBLISHER_OFFERED_INCOMPATIBLE_QOS=2 RCL_PUBLISHER_INCOMPATIBLE_TYPE=3 RCL_PUBLISHER_MATCHED=4
rclpy.event_handler.QoSSubscriptionEventType: RCL_SUBSCRIPTION_REQUESTED_DEADLINE_MISSED=0 RCL_SUBSCRIPTION_LIVELINESS_CHANGED=1 RCL_SUBSCRIPTION_REQUESTED_INCOMPATIBLE_QOS=2 RCL_SUBSCRIPTION_MESSAGE_LOST=3 RCL_SUBSCRIPTION_INCOMPATIBLE_TYPE=4 RCL_SUBSCRIPTION_MATCHED=5
action_msgs.msg.GoalStatus: STATUS_UNKNOWN=0 STATUS_ACCEPTED=1 STATUS_EXECUTING=2 STATUS_CANCELING=3 STATUS_SUCCEEDED=4 STATUS_CANCELED=5 STATUS_ABORTED=6
"""

# Errors of the C extension, with their base classes.
ERRORS = """
rclpy._rclpy_pybind11.RCLError: RuntimeError
rclpy._rclpy_pybind11.RMWError: RuntimeError
rclpy._rclpy_pybind11.InvalidHandle: RuntimeError
rclpy._rclpy_pybind11.UnknownROSArgsError: RuntimeError
rclpy._rclpy_pybind11.RCLInvalidROSArgsError: RCLError
rclpy._rclpy_pybind11.NodeNameNonExistentError: RCLError
rclpy._rclpy_pybind11.UnsupportedEventTypeError: RCLError
rclpy._rclpy_pybind11.TimerCancelledError: RCLError
"""

ALIASES = """
rclpy.qos.QoSHistoryPolicy = rclpy.qos.HistoryPolicy
rclpy.qos.QoSReliabilityPolicy = rclpy.qos.ReliabilityPolicy
rclpy.qos.QoSDurabilityPolicy = rclpy.qos.DurabilityPolicy
rclpy.qos.QoSLivelinessPolicy = rclpy.qos.LivelinessPolicy
rclpy.lifecycle.Node = rclpy.lifecycle.LifecycleNode
rclpy.lifecycle.NodeMixin = rclpy.lifecycle.LifecycleNodeMixin
rclpy.lifecycle.Publisher = rclpy.lifecycle.LifecyclePublisher
rclpy.lifecycle.State = rclpy.lifecycle.LifecycleState
rclpy.clock.ClockType = rclpy.clock_type.ClockType
rclpy.exceptions.InvalidHandle = rclpy._rclpy_pybind11.InvalidHandle
rclpy.node.NodeNameNonExistentError = rclpy._rclpy_pybind11.NodeNameNonExistentError
rclpy.event_handler.UnsupportedEventTypeError = rclpy._rclpy_pybind11.UnsupportedEventTypeError
rclpy.executors.TimerCancelledError = rclpy._rclpy_pybind11.TimerCancelledError
rclpy.exceptions.TimerCancelledError = rclpy._rclpy_pybind11.TimerCancelledError
rclpy.executors.SignalHandlerGuardCondition = rclpy.signals.SignalHandlerGuardCondition
rclpy.node.NotInitializedException = rclpy.exceptions.NotInitializedException
rclpy.node.ParameterService = rclpy.parameter_service.ParameterService
rclpy.node.ROSClock = rclpy.clock.ROSClock
rclpy.node.TimeSource = rclpy.time_source.TimeSource
rclpy.node.TypeDescriptionService = rclpy.type_description_service.TypeDescriptionService
rclpy.node.qos_profile_parameter_events = rclpy.qos.qos_profile_parameter_events
rclpy.parameter.ParameterType = rcl_interfaces.msg.ParameterType
rclpy.parameter.ParameterValue = rcl_interfaces.msg.ParameterValue
rclpy.node.S_TO_NS = rclpy.constants.S_TO_NS
rclpy.node.MsgType = rclpy.publisher.MsgType
rclpy.node.MsgType = rclpy.subscription.MsgType
rclpy.node.SrvType = rclpy.client.SrvType
rclpy.node.SrvTypeRequest = rclpy.service.SrvTypeRequest
rclpy.node.SrvTypeResponse = rclpy.service.SrvTypeResponse
tf2_ros.TransformStamped = geometry_msgs.msg.TransformStamped
tf2_ros.TFMessage = tf2_msgs.msg.TFMessage
tf2_geometry_msgs.PoseStamped = geometry_msgs.msg.PoseStamped
rclpy.impl.logging_severity.LoggingSeverity = rclpy.logging.LoggingSeverity
rclpy.impl.implementation_singleton.rclpy_implementation = rclpy._rclpy_pybind11
"""


def find(path):
    """What a dotted path names: modules first, then attributes."""
    parts = path.split(".")
    for count in range(len(parts), 0, -1):
        try:
            found = importlib.import_module(".".join(parts[:count]))
        except ModuleNotFoundError:
            continue
        for name in parts[count:]:
            found = getattr(found, name)
        return found
    raise ModuleNotFoundError(path)


def rows(table):
    return [line.split(": ") for line in table.strip().splitlines()]


@pytest.mark.parametrize(
    ("owner", "members"), rows(CONSTANTS), ids=[owner for owner, _ in rows(CONSTANTS)]
)
def test_constants(owner, members):
    for name, number in (member.split("=") for member in members.split()):
        value = getattr(find(owner), name)
        assert getattr(value, "value", value) == int(number), name


@pytest.mark.parametrize(("path", "base"), rows(ERRORS), ids=[path for path, _ in rows(ERRORS)])
def test_errors(path, base):
    error = find(path)
    assert [each.__name__ for each in error.__mro__][1] == base
    assert error.__name__ == path.rpartition(".")[2]


def test_errors_have_the_bases_that_ros_2_gives_them():
    modules = json.loads(GOLDEN.read_text())["rclpy"]
    expected = {
        f"{module}.{name}": [base.rpartition(":")[2] for base in entry["bases"]]
        for module, members in modules.items()
        for name, entry in members.items()
        if name.endswith(("Exception", "Error")) and "bases" in entry
    }
    assert len(expected) > 20
    found = {path: [base.__name__ for base in find(path).__bases__] for path in expected}
    assert found == expected


@pytest.mark.parametrize("alias", ALIASES.strip().splitlines())
def test_aliases(alias):
    one, other = alias.split(" = ")
    assert find(one) is find(other)


def test_common_attributes_of_created_entities(node):
    """Attributes that constructors set, which no class shows."""
    from rclpy.clock import JumpThreshold
    from std_msgs.msg import String
    from std_srvs.srv import Empty

    made = {
        node.create_publisher(String, "t", 1): "msg_type topic qos_profile event_handlers",
        node.create_subscription(
            String, "t", print, 1
        ): "msg_type topic callback callback_group raw qos_profile event_handlers",
        node.create_client(Empty, "s"): "srv_type srv_name qos_profile callback_group",
        node.create_service(
            Empty, "s", print
        ): "srv_type srv_name callback callback_group qos_profile",
        node.create_timer(1, print): "callback callback_group",
        node.create_guard_condition(print): "callback callback_group",
        JumpThreshold(
            min_forward=None, min_backward=None
        ): "min_forward min_backward on_clock_change",
    }
    for thing, names in made.items():
        for name in names.split():
            assert hasattr(thing, name), f"{thing}: {name}"


def test_a_with_block_destroys_an_entity_at_its_end(node):
    from rclpy._rclpy_pybind11 import InvalidHandle
    from std_msgs.msg import String
    from std_srvs.srv import Empty

    for make, kept in [
        (lambda: node.create_publisher(String, "t", 1), "publishers"),
        (lambda: node.create_subscription(String, "t", print, 1), "subscriptions"),
        (lambda: node.create_client(Empty, "s"), "clients"),
        (lambda: node.create_service(Empty, "s", print), "services"),
        (lambda: node.create_timer(1, print), "timers"),
    ]:
        with make() as entity:
            assert entity in list(getattr(node, kept))
            with node.handle, entity.handle:  # as rclpy itself does; that destroys nothing
                pass
            assert entity in list(getattr(node, kept))
        assert entity not in list(getattr(node, kept))
        with pytest.raises(InvalidHandle):
            _ = entity.handle


def test_a_publisher_class_with_a_constructor_as_in_ros_2(node):
    from rclpy.event_handler import PublisherEventCallbacks
    from rclpy.publisher import Publisher
    from std_msgs.msg import String

    class Counting(Publisher):
        def __init__(
            self, publisher_impl, msg_type, topic, qos_profile, event_callbacks, callback_group
        ):
            super().__init__(
                publisher_impl, msg_type, topic, qos_profile, event_callbacks, callback_group
            )
            self.given = topic, event_callbacks, callback_group
            self.count = 0

        def publish(self, msg):
            self.count += 1
            super().publish(msg)

    events = PublisherEventCallbacks(incompatible_qos=print)
    publisher = node.create_publisher(
        String, "t", 1, publisher_class=Counting, event_callbacks=events
    )
    publisher.publish(String())
    assert publisher.count == 1
    assert publisher.given == ("t", events, node.default_callback_group)
    assert (publisher.topic_name, len(publisher.event_handlers)) == ("/t", 1)
    assert list(node.publishers)[-1] is publisher


def test_content_filters_are_refused(node):
    from rclpy._rclpy_pybind11 import RCLError
    from rclpy.subscription_content_filter_options import ContentFilterOptions
    from std_msgs.msg import String

    options = ContentFilterOptions(filter_expression="data = %0", expression_parameters=["'x'"])
    subscription = node.create_subscription(String, "t", print, 1, content_filter_options=options)
    assert subscription.is_cft_enabled is False
    with pytest.raises(RCLError, match="the middleware does not filter") as caught:
        subscription.set_content_filter(filter_expression="data = %0", expression_parameters=["x"])
    assert caught.value.hint == "All messages of '/t' arrive: filter them in the callback"
    with pytest.raises(RCLError, match="the middleware does not filter"):
        subscription.get_content_filter()


def test_events_of_some_nodes_are_not_filtered(node):
    from rclpy.parameter_event_handler import ParameterEventHandler

    handler = ParameterEventHandler(node)
    assert handler.configure_nodes_filter(["/talker"]) is False
    assert handler.configure_nodes_filter() is False


def test_asynchronous_and_other_entities_have_bases_in_common():
    from rclpy import client, experimental, node, publisher, service, subscription, timer

    for module, name in [
        (client, "Client"),
        (node, "Node"),
        (publisher, "Publisher"),
        (service, "Service"),
        (subscription, "Subscription"),
        (timer, "Timer"),
    ]:
        base, kind = getattr(module, f"Base{name}"), getattr(module, name)
        asynchronous = getattr(experimental, f"Async{name}")
        assert issubclass(kind, base)
        assert issubclass(asynchronous, base)
        assert not issubclass(asynchronous, kind)


# Private attributes that ROS 2's nodes have as well; programs know better than to take these names.
OF_ROS_2 = {
    "_callbacks",
    "_clock",
    "_context",
    "_logger",
    "_managed_entities",
    "_parameter_service",
    "_parameters",
    "_state_machine",
}
OF_ROS_2 |= {"_time_source", "_type_description_service"}


@pytest.mark.parametrize("kind", [Node, LifecycleNode])
def test_a_program_may_have_attributes_of_its_own(context, kind):
    """A class derived from Node may use any attribute name, for example `_name` or `_executor`."""
    node = kind("tested", context=context, enable_logger_service=True)
    private = {
        name
        for name in (*vars(node), *dir(kind))
        if name.startswith("_") and not name.startswith(("__", "_rclpy"))
    }
    assert {
        name
        for name in private - OF_ROS_2
        if not name.startswith(("_Node__", "_BaseNode__", "_LifecycleNodeMixin__"))
    } == set()
    public = {name for name in dir(Node) if not name.startswith("_")}
    of_ros_2 = json.loads(GOLDEN.read_text())["rclpy"]["rclpy.node"]["Node"]["members"]
    of_lyrical = {
        "get_action_client_names_and_types_by_node",
        "get_action_names_and_types",
        "get_action_server_names_and_types_by_node",
        "get_clients_info_by_service",
        "get_servers_info_by_service",
    }
    assert public - of_ros_2.keys() == of_lyrical


def test_node_is_a_facade():
    """Each method of a node is one line onto the part that does the work."""
    (node_class,) = [
        each
        for each in ast.parse(Path(rclpy.node.__file__).read_text()).body
        if getattr(each, "name", "") == "Node"
    ]
    longer = set()
    for method in (each for each in node_class.body if isinstance(each, ast.FunctionDef)):
        work = [each for each in method.body if not isinstance(each, ast.ImportFrom)]
        if len(work) - (ast.get_docstring(method) is not None) != 1:
            longer.add(method.name)
    assert longer == {"destroy_node", "executor"}


@pytest.mark.parametrize(
    "line",
    [
        "from rclpy.action.client import GoalStatus",
        "from rclpy.action.server import GoalStatus, ServerGoalHandle",
        "from rclpy.node import Parameter, ParameterDescriptor, ParameterType, QoSProfile",
        "from rclpy.node import ReentrantCallbackGroup, Publisher, Subscription, Timer, Clock",
        "from rclpy.executors import Timer, Clock, Node",
        "import std_msgs; std_msgs.msg.String",
        "import tf2_ros, geometry_msgs; geometry_msgs.msg.Pose",
    ],
)
def test_names_that_modules_hand_on(line):
    """Third-party packages import them from there; each line in a fresh process."""
    subprocess.run([sys.executable, "-c", line], check=True)


@pytest.mark.parametrize(
    "module", ["rclpy.node", "rclpy.executors", "rclpy.action.client", "rclpy.action.server"]
)
def test_a_name_that_a_module_does_not_hand_on(module):
    with pytest.raises(AttributeError, match=f"module '{module}' has no attribute 'Nothing'"):
        importlib.import_module(module).Nothing  # noqa: B018 -- the access is tested


def test_bases_of_interfaces_for_annotations():
    from example_interfaces.action import Fibonacci
    from rclpy.type_support import Action, Msg, Srv
    from std_msgs.msg import String
    from std_srvs.srv import Empty

    kinds = {String: Msg, Empty: Srv, Fibonacci: Action}
    for interface, kind in kinds.items():
        assert [each for each in (Msg, Srv, Action) if issubclass(interface, each)] == [kind]


def test_callbacks_of_parameter_events():
    from rcl_interfaces.msg import Parameter, ParameterEvent
    from rclpy.parameter_event_handler import (
        ParameterCallbackHandle,
        ParameterEventCallbackHandle,
        ParameterEventHandler,
    )

    called = []
    callbacks = ParameterEventHandler.Callbacks()
    for name in ("a", "b"):
        handle = ParameterCallbackHandle(name, "/n", lambda message: called.append(message.name))
        callbacks.parameter_callbacks.append(handle)
    callbacks.event_callbacks.append(ParameterEventCallbackHandle(called.append))
    event = ParameterEvent(node="/n", changed_parameters=[Parameter(name="b")])
    callbacks.event_callback(event)
    assert called == ["b", event]
    callbacks.event_callback(b"raw")
    assert called == ["b", event, b"raw"]
