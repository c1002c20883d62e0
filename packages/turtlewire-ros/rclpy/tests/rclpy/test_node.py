"""The node: names, remapping, its entities, and its properties in the graph."""

import gc
import threading
from concurrent.futures import ThreadPoolExecutor

import pytest

from geometry_msgs.msg import TransformStamped
from rcl_interfaces.msg import Log
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.exceptions import InvalidHandle, InvalidNamespaceException, InvalidNodeNameException
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.time import Time
from std_msgs.msg import Int32
from std_srvs.srv import Trigger
from tf2_ros import Buffer, TransformBroadcaster, TransformListener

BUILT_IN_SERVICES = {
    "describe_parameters",
    "get_parameter_types",
    "get_parameters",
    "get_type_description",
    "list_parameters",
    "set_parameters",
    "set_parameters_atomically",
}


@pytest.fixture
def remapped(monkeypatch):
    """Makes a context with a command line, and nodes in it."""
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    contexts = []

    def make(*ros_args, name="original", **arguments):
        context = Context()
        contexts.append(context)
        context.init(args=["program", "--ros-args", *ros_args])
        return Node(name, context=context, **arguments)

    yield make
    for context in contexts:
        context.try_shutdown()


def test_names(context):
    for namespace, full, logger in (
        (None, "/n", "n"),
        ("", "/n", "n"),
        ("a", "/a/n", "a.n"),
        ("/a/b", "/a/b/n", "a.b.n"),
    ):
        node = Node("n", context=context, namespace=namespace)
        assert node.get_name() == "n"
        assert node.get_fully_qualified_name() == full
        assert node.get_namespace() == (full[:-2] or "/")
        assert node.get_logger().name == logger
        node.destroy_node()


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("", "node name must not be empty"),
        ("a/b", "node name must not contain characters other than alphanumerics or '_'"),
        ("1a", "node name must not start with a number"),
    ],
)
def test_a_node_name_is_checked(context, name, text):
    with pytest.raises(InvalidNodeNameException) as caught:
        Node(name, context=context)
    assert str(caught.value).startswith(f"Invalid node name: {text}:\n  '{name}'\n   ")


@pytest.mark.parametrize("namespace", ["/a/", "a//b", "/1", "/a?"])
def test_a_namespace_is_checked(context, namespace):
    with pytest.raises(InvalidNamespaceException, match=r"^Invalid namespace: namespace must not "):
        Node("n", context=context, namespace=namespace)


def test_command_line_renames_the_node_first(remapped):
    node = remapped("-r", "__node:=renamed", "-r", "__ns:=/robot", "-p", "speed:=3")
    assert node.get_fully_qualified_name() == "/robot/renamed"
    assert node.get_logger().name == "robot.renamed"
    assert node.declare_parameter("speed", 1).value == 3
    assert node.create_publisher(Int32, "~/x", 1).topic_name == "/robot/renamed/x"
    assert "/robot/renamed/get_parameters" in {service.service_name for service in node.services}


def test_topics_and_services_are_remapped(remapped):
    node = remapped(
        "-r", "chatter:=talk", "-r", "other_node:quiet:=loud", "-r", "ask:=/answer", namespace="/ns"
    )
    assert node.create_publisher(Int32, "chatter", 1).topic_name == "/ns/talk"
    assert (
        node.create_subscription(Int32, "/ns/chatter", lambda _: None, 1).topic_name == "/ns/talk"
    )
    assert node.create_publisher(Int32, "quiet", 1).topic_name == "/ns/quiet"
    assert node.create_client(Trigger, "ask").service_name == "/answer"
    assert node.resolve_topic_name("chatter") == "/ns/talk"
    assert node.resolve_topic_name("chatter", only_expand=True) == "/ns/chatter"
    assert node.resolve_service_name("ask") == "/answer"
    assert node.resolve_service_name("ask", only_expand=True) == "/ns/ask"


def test_the_nodes_own_arguments_come_before_those_of_the_process(remapped):
    own = ["--ros-args", "-r", "chatter:=mine", "-p", "speed:=5"]
    node = remapped("-r", "chatter:=general", "-r", "other:=there", "-p", "speed:=3", cli_args=own)
    assert node.resolve_topic_name("chatter") == "/mine"
    assert node.resolve_topic_name("other") == "/there"
    assert node.declare_parameter("speed", 1).value == 5
    node = remapped("-r", "chatter:=general", use_global_arguments=False)
    assert node.resolve_topic_name("chatter") == "/chatter"


def test_common_parts_of_every_node(context, node):
    assert {service.service_name for service in node.services} == {
        f"/tested/{name}" for name in BUILT_IN_SERVICES
    }
    published = dict(node.get_publisher_names_and_types_by_node("tested", "/"))
    assert published == {
        "/parameter_events": ["rcl_interfaces/msg/ParameterEvent"],
        "/rosout": ["rcl_interfaces/msg/Log"],
    }
    (rosout,) = node.get_publishers_info_by_topic("/rosout")
    assert (rosout.qos_profile.depth, rosout.qos_profile.durability) == (
        1000,
        DurabilityPolicy.TRANSIENT_LOCAL,
    )
    assert rosout.qos_profile.lifespan.nanoseconds == 10_000_000_000


def test_a_node_can_have_less(context):
    node = Node("bare", context=context, enable_rosout=False, start_parameter_services=False)
    assert {service.service_name for service in node.services} == {"/bare/get_type_description"}
    assert [name for name, _ in node.get_publisher_names_and_types_by_node("bare", "/")] == [
        "/parameter_events"
    ]


def test_rosout_carries_what_is_logged_also_to_late_joiners(context, node, executor, spin_until):
    node.get_logger().warning("before")
    node.get_logger().get_child("part").error("of a child")
    other = Node("listening", context=context, enable_rosout=False)
    executor.add_node(other)
    got = []
    latched = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    other.create_subscription(Log, "/rosout", got.append, latched)
    node.get_logger().info(
        "after \udce9.txt"
    )  # as on the console, what UTF-8 cannot hold is escaped
    spin_until(lambda: len(got) == 3)
    assert [(log.level, log.name, log.msg) for log in got] == [
        (30, "tested", "before"),
        (40, "tested.part", "of a child"),
        (20, "tested", "after \\udce9.txt"),
    ]
    assert got[0].file.endswith("test_node.py")
    assert got[0].function == "test_rosout_carries_what_is_logged_also_to_late_joiners"


def test_endpoints_of_a_node(node):
    group = MutuallyExclusiveCallbackGroup()
    timer = node.create_timer(1.0, None, callback_group=group)
    guard = node.create_guard_condition(lambda: None)
    assert list(node.timers) == [timer]
    assert list(node.guards) == [guard]
    assert list(node.waitables) == []
    assert node.destroy_guard_condition(guard)
    assert not node.destroy_guard_condition(guard)
    assert list(node.guards) == []


def test_destroying_a_node_closes_everything(context, executor):
    node = Node("short", context=context)
    executor.add_node(node)
    publisher = node.create_publisher(Int32, "number", 1)
    node.create_timer(1.0, lambda: None)
    node.destroy_node()
    node.destroy_node()
    assert node not in executor.get_nodes()
    assert publisher not in list(node.publishers)
    for use in (
        lambda: node.create_publisher(Int32, "number", 1),
        node.get_topic_names_and_types,
        lambda: node.handle,
    ):
        with pytest.raises(InvalidHandle):
            use()
    assert ("short", "/", "/") not in [tuple(each) for each in context.wire.graph.nodes()]
    assert not any(endpoint.topic == "/number" for endpoint in context.wire.graph.endpoints())
    with Node("with", context=context) as other:
        assert "with" in other.get_node_names()


def test_nodes_can_be_made_and_destroyed_by_many_threads(context, executor, spinning):
    spinning(executor)

    def live(number):
        for round_number in range(5):
            node = Node(f"node_{number}_{round_number}", context=context)
            executor.add_node(node)
            called = threading.Event()
            node.create_timer(0.001, called.set)
            assert called.wait(60)
            node.destroy_node()

    with ThreadPoolExecutor(4) as pool:
        list(pool.map(live, range(4)))


def gone(observer, name):
    """Wait until the garbage collector and the graph have let go of a node."""
    gc.collect()

    def is_gone():
        return name not in observer.get_node_names()

    return observer.context.wait_for_graph(is_gone, 60_000_000_000)


@pytest.mark.parametrize("middleware", ["local", "rmw_cyclonedds_cpp"])
def test_a_node_that_is_dropped_leaves_the_graph(context):
    observer = Node("observer", context=context)
    client = observer.create_client(Trigger, "serve")
    executor = SingleThreadedExecutor(context=context)

    def use_a_node():
        node = Node("dropped", context=context)
        node.create_service(Trigger, "serve", lambda _, response: response)
        node.create_timer(3600.0, lambda: None)
        TransformListener(Buffer(), node)
        executor.add_node(node)
        executor.spin_once(timeout_sec=0)
        executor.remove_node(node)
        assert client.wait_for_service(60)

    use_a_node()
    assert gone(observer, "dropped")
    assert not client.service_is_ready()
    executor.shutdown()


def test_a_node_that_is_dropped_after_the_shutdown_frees_its_logger(monkeypatch, capfd):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    for _ in range(2):
        with Context() as context:
            Node("again", context=context)
        gc.collect()
    assert "Publisher already registered" not in capfd.readouterr().err


def test_an_endpoint_that_is_kept_keeps_its_node(context):
    observer = Node("observer", context=context)
    received = []
    observer.create_subscription(Int32, "numbers", received.append, 10)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(observer)
    publisher = Node("dropped", context=context).create_publisher(Int32, "numbers", 10)
    gc.collect()
    publisher.publish(Int32(data=1))
    executor.spin_once(timeout_sec=60)
    assert [message.data for message in received] == [1]
    assert "dropped" in observer.get_node_names()
    del publisher
    assert gone(observer, "dropped")
    executor.shutdown()


def test_a_listener_of_a_dropped_node_leaves_the_others_their_subscription(context):
    kept = TransformListener(Buffer(), Node("kept", context=context))
    first = Node("dropped", context=context)
    TransformListener(Buffer(), first)
    kept.unregister()  # the subscription they shared is now one of the node to be dropped
    second = TransformListener(Buffer(), kept.node)
    del first
    assert gone(kept.node, "dropped")
    talker = Node("talker", context=context)
    message = TransformStamped(child_frame_id="robot")
    message.header.frame_id = "world"
    message.transform.rotation.w = 1.0
    TransformBroadcaster(talker).sendTransform(message)
    assert second.buffer.can_transform("world", "robot", Time(), Duration(seconds=60))


def test_timers_that_come_and_go_leave_nothing_in_the_executor(context, node, executor):
    node.create_timer(3600.0, lambda: None)
    executor.remove_node(node)
    for _ in range(100):
        executor.add_node(node)
        executor.remove_node(node)
    assert len(executor._rclpy_scheduler.wait.timers._heap) < 5
