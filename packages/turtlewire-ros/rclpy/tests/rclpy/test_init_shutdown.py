"""init, ok, shutdown and contexts."""

import math
import threading

import pytest
from tests.needs import needs_cyclone_dds
from tests.programs import run_python

import rclpy
from rclpy._rclpy_pybind11 import RCLError
from rclpy.context import Context
from rclpy.exceptions import NotInitializedException
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.utilities import get_default_context, remove_ros_args, timeout_sec_to_nsec
from std_msgs.msg import Int32
from std_srvs.srv import Empty
from turtlewire.errors import WireError
from turtlewire.wire.local.context import LocalContext


@pytest.fixture(autouse=True)
def _local(monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    yield
    rclpy.try_shutdown()


def test_init_and_shutdown_can_be_repeated():
    for _ in range(3):
        assert not rclpy.ok()
        rclpy.init(args=[])
        assert rclpy.ok()
        rclpy.shutdown()
        assert not rclpy.ok()


def test_init_twice_raises():
    rclpy.init(args=[])
    with pytest.raises(RuntimeError, match=r"^Context.init\(\) must only be called once$"):
        rclpy.init(args=[])


def test_shutdown_twice_raises_and_try_shutdown_does_not():
    rclpy.init(args=[])
    rclpy.shutdown()
    with pytest.raises(RuntimeError):
        rclpy.shutdown()
    rclpy.try_shutdown()


def test_a_context_is_shut_down_once():
    context = Context()
    with pytest.raises(RuntimeError, match="Context must be initialized before it can be shutdown"):
        context.shutdown()
    context.try_shutdown()
    context.init(args=[])
    context.shutdown()
    text = r"^failed to shutdown: rcl_shutdown already called on the given context$"
    with pytest.raises(RCLError, match=text):
        context.shutdown()
    context.try_shutdown()
    with pytest.raises(RuntimeError, match="must only be called once"):
        context.init(args=[])


def test_with_statement():
    with rclpy.init(args=[]) as context:
        assert context is get_default_context()
        assert rclpy.ok()
    assert not rclpy.ok()
    with rclpy.init(args=[]):
        rclpy.shutdown()
    with Context() as context:
        assert context.ok()
    assert not context.ok()
    with pytest.raises(RuntimeError, match="must only be called once"), context:
        pass


def test_a_destroyed_context_is_shut_down():
    context = Context()
    context.destroy()
    context.init(args=[])
    ended = []
    context.on_shutdown(lambda: ended.append(True))
    context.destroy()
    context.destroy()
    assert ended == [True]
    assert not context.ok()


def test_arguments_that_are_not_utf_8():
    with pytest.raises(UnicodeEncodeError):
        rclpy.init(args=["program", "Ragnar\udcc3\udcb6k"])
    assert not rclpy.ok()


def test_a_node_needs_init():
    text = r"^rclpy.init\(\) has not been called. msg:cannot create node$"
    with pytest.raises(NotInitializedException, match=text):
        Node("early")
    rclpy.init(args=[])
    context = get_default_context()
    rclpy.shutdown()
    with pytest.raises(NotInitializedException, match=text):
        Node("late", context=context)


def test_domain_ids(monkeypatch):
    monkeypatch.setenv("ROS_DOMAIN_ID", "17")
    for asked, expected in ((None, 17), (4, 4)):
        with rclpy.init(context=Context(), args=[], domain_id=asked) as context:
            assert context.get_domain_id() == expected
    with pytest.raises(RuntimeError, match=r"^Domain id \(-1\) should not be lower than zero.$"):
        Context().init(args=[], domain_id=-1)


def test_arguments_that_are_wrong_leave_the_context_uninitialized():
    with pytest.raises(RuntimeError):
        rclpy.init(args=["program", "--ros-args", "-r", "nonsense"])
    assert not rclpy.ok()
    rclpy.init(args=[])


@pytest.mark.parametrize(
    "step",
    [
        "turtlewire.wire.local.context.LocalContext.graph",
        "rclpy.impl.arguments.Arguments.configure_logging",
    ],
)
def test_an_init_that_fails_half_way_can_be_repeated(monkeypatch, step):
    def fail(_self):
        raise RuntimeError("can't start new thread")

    closed, close = [], LocalContext.close
    monkeypatch.setattr(LocalContext, "close", lambda wire: closed.append(wire) or close(wire))
    monkeypatch.setattr(rclpy.context, "g_logging_ref_count", 0)
    context = Context()
    with monkeypatch.context() as patched:
        patched.setattr(step, property(fail) if step.endswith("graph") else fail)
        with pytest.raises(RuntimeError, match="can't start"):
            context.init(args=[])
    assert len(closed) == 1
    assert rclpy.context.g_logging_ref_count == 0
    context.init(args=[])
    assert context.ok()
    context.shutdown()
    assert len(closed) == 2


class Told:
    def __init__(self):
        self.times = 0

    def tell(self):
        self.times += 1


def test_shutdown_callbacks():
    calls = []
    told, forgotten = Told(), Told()
    context = Context()
    context.init(args=[])
    context.on_shutdown(told.tell)
    context.on_shutdown(forgotten.tell)
    context.on_shutdown(lambda: calls.append(context.ok()))
    del forgotten
    context.shutdown()
    assert told.times == 1
    assert calls == [False]
    context.on_shutdown(told.tell)
    assert told.times == 2
    with pytest.raises(TypeError):
        context.on_shutdown(3)


def test_a_shutdown_callback_that_raises_does_not_stop_the_shutdown():
    def fail():
        raise ValueError("no goodbye")

    calls = []
    logging_before = rclpy.context.g_logging_ref_count
    context = Context()
    context.init(args=[])
    publisher = Node("n", context=context).create_publisher(Int32, "words", 1)
    context.on_shutdown(fail)
    context.on_shutdown(lambda: calls.append(context.ok()))
    with pytest.raises(ValueError, match="no goodbye"):
        context.shutdown()
    assert calls == [False]
    assert rclpy.context.g_logging_ref_count == logging_before
    with pytest.raises(RCLError, match="already called"):
        context.shutdown()
    with pytest.raises(WireError, match="closed"):
        context.wire.create_node("late")
    del publisher


def test_shutdown_ends_a_wait_for_the_graph():
    rclpy.init(args=[])
    node = Node("waiting")
    ending = threading.Timer(0.05, rclpy.shutdown)
    ending.start()
    with pytest.raises(RCLError, match="rcl node's context is invalid"):
        node.wait_for_node("/nobody", math.inf)
    ending.join()
    assert not rclpy.ok()


def test_the_global_executor_belongs_to_the_default_context():
    rclpy.init(args=[])
    first = rclpy.get_global_executor()
    assert rclpy.get_global_executor() is first
    rclpy.shutdown()
    rclpy.init(args=[])
    second = rclpy.get_global_executor()
    assert second is not first
    assert second.context is get_default_context()


def test_spin_returns_when_another_thread_shuts_down(later):
    rclpy.init(args=[])
    node = rclpy.create_node("spinning")
    later(rclpy.shutdown)
    rclpy.spin(node)
    node.destroy_node()


def test_spin_once_and_spin_until_future_complete():
    rclpy.init(args=[])
    node = rclpy.create_node("spinning")
    future = rclpy.task.Future()
    node.create_guard_condition(lambda: future.set_result(5)).trigger()
    rclpy.spin_once(node, timeout_sec=60)
    assert future.result() == 5
    task = node.executor.create_task(lambda: 6)
    rclpy.spin_once(node, timeout_sec=60)
    assert task.result() == 6
    rclpy.spin_until_future_complete(node, future, timeout_sec=60)


def test_a_spin_within_a_callback_leaves_the_node_where_it_was():
    rclpy.init(args=[])
    node = rclpy.create_node("spinning")
    calls = []

    def inner():
        rclpy.spin_once(node, timeout_sec=0)
        calls.append("inner")
        node.create_guard_condition(lambda: (calls.append("outer"), rclpy.shutdown())).trigger()

    node.create_guard_condition(inner).trigger()
    rclpy.spin(node)
    assert calls == ["inner", "outer"]


def test_destroying_after_shutdown_is_fine():
    rclpy.init(args=[])
    node = Node("late")
    publisher = node.create_publisher(Int32, "topic", 1)
    node.create_timer(1.0, None)
    rclpy.shutdown()
    node.get_logger().info("last words")
    with pytest.raises(RCLError, match="publisher's context is invalid"):
        publisher.publish(b"\x00\x01\x00\x00\x00\x00\x00\x00")
    with pytest.raises(RCLError, match="publisher's context is invalid"):
        publisher.publish(Int32())
    node.destroy_node()
    node.destroy_node()


CREATORS = {
    "publisher": lambda node: node.create_publisher(Int32, "topic", 1),
    "subscription": lambda node: node.create_subscription(Int32, "topic", print, 1),
    "client": lambda node: node.create_client(Empty, "other"),
    "service": lambda node: node.create_service(Empty, "other", print),
}


@pytest.mark.parametrize("middleware", ["rmw_cyclonedds_cpp", "rmw_zenoh_cpp"])
@pytest.mark.parametrize("what", CREATORS)
def test_concurrent_shutdown_creates_nothing(monkeypatch, middleware, what):
    monkeypatch.setenv("RMW_IMPLEMENTATION", middleware)
    rclpy.init(args=[])
    node = Node("hasty")
    wire = node._rclpy_endpoints._core.wire
    create = getattr(wire, f"create_{what}")

    def shut_down_and_create(*arguments, **options):
        rclpy.shutdown()
        return create(*arguments, **options)

    monkeypatch.setattr(wire, f"create_{what}", shut_down_and_create)
    with pytest.raises(
        RCLError, match=f"(?i)failed to create {what}: rcl node's context is invalid"
    ):
        CREATORS[what](node)
    node.destroy_node()


@pytest.mark.parametrize("middleware", ["local", "rmw_cyclonedds_cpp"])
def test_after_shutdown_nothing_more_is_created_or_called(monkeypatch, middleware):
    monkeypatch.setenv("RMW_IMPLEMENTATION", middleware)
    rclpy.init(args=[])
    node = Node("late")
    client = node.create_client(Empty, "service")
    rclpy.shutdown()
    for what, create in CREATORS.items():
        with pytest.raises(
            RCLError, match=f"(?i)failed to create {what}: rcl node's context is invalid"
        ):
            create(node)
    with pytest.raises(RCLError, match="failed to send request"):
        client.call_async(Empty.Request())
    node.destroy_node()


#: What each call says after a shutdown, as a real Jazzy does (without its file and line).
AFTER_SHUTDOWN = {
    "Failed to create publisher: rcl node's": CREATORS["publisher"],
    "Failed to create subscription: rcl node's": CREATORS["subscription"],
    "failed to create client: rcl node's": CREATORS["client"],
    "failed to create service: rcl node's": CREATORS["service"],
    "failed to create timer: the given": lambda node: node.create_timer(1.0, print),
    "failed to create guard_condition: the given": lambda node: node.create_guard_condition(print),
    "Failed to get node names: rcl node's": lambda node: node.get_node_names(),
    "failed to get topic names and types: rcl": lambda node: node.get_topic_names_and_types(),
    "failed to get service names and types: rcl": lambda node: node.get_service_names_and_types(),
    "failed to get publisher names and types: rcl": lambda node: (
        node.get_publisher_names_and_types_by_node("late", "/")
    ),
    "failed to get subscriber names and types: rcl": lambda node: (
        node.get_subscriber_names_and_types_by_node("late", "/")
    ),
    "failed to get client names and types: rcl": lambda node: (
        node.get_client_names_and_types_by_node("late", "/")
    ),
    "Error in rcl_count_publishers: rcl": lambda node: node.count_publishers("topic"),
    "Error in rcl_count_subscribers: rcl": lambda node: node.count_subscribers("topic"),
    "Error in rcl_count_clients: rcl": lambda node: node.count_clients("other"),
    "Error in rcl_count_services: rcl": lambda node: node.count_services("other"),
    "Failed to get information by topic for publishers: rcl": lambda node: (
        node.get_publishers_info_by_topic("topic")
    ),
    "Failed to get information by topic for subscriptions: rcl": lambda node: (
        node.get_subscriptions_info_by_topic("topic")
    ),
}
PUBLISHER_AFTER_SHUTDOWN = {
    "failed to get subscription count": Publisher.get_subscription_count,
    "Failed to assert liveliness on the Publisher": Publisher.assert_liveliness,
    "Failed to wait for all acknowledgements": Publisher.wait_for_all_acked,
}


def test_calls_after_shutdown_raise_what_ros_2_raises():
    rclpy.init(args=[])
    node = Node("late")
    publisher = node.create_publisher(Int32, "early", 1)
    rclpy.shutdown()
    for text, call in AFTER_SHUTDOWN.items():
        with pytest.raises(RCLError) as caught:
            call(node)
        assert str(caught.value).startswith(text)
    with pytest.raises(RCLError, match="failed to create timer"):
        node.create_rate(1.0)
    for text, call in PUBLISHER_AFTER_SHUTDOWN.items():
        with pytest.raises(RCLError) as caught:
            call(publisher)
        assert str(caught.value) == f"{text}: publisher's context is invalid"
    node.destroy_node()


def test_every_module_is_an_attribute_of_the_package():
    names = (
        "time duration clock qos executors logging parameter callback_groups action node task "
        "timer exceptions"
    )
    lines = [f"assert rclpy.{name}.__name__ == 'rclpy.{name}'" for name in names.split()]
    program = "\n".join(["import rclpy", *lines, "print(rclpy.time.Time().nanoseconds)"])
    assert run_python(program).stdout == "0\n"
    assert rclpy.Parameter is rclpy.parameter.Parameter
    assert rclpy.Future is rclpy.task.Future
    assert rclpy.Context is Context
    with pytest.raises(AttributeError, match="module 'rclpy' has no attribute 'no_such_module'"):
        _ = rclpy.no_such_module


def test_the_import_and_a_node_load_nothing_heavy():
    program = """
import rclpy, sys
from rclpy.node import Node
from rclpy.publisher import Publisher
rclpy.init()
node = Node("light")
heavy = {"numpy", "asyncio.events", "inspect", "concurrent.futures", "dataclasses",
         "subprocess", "uuid", "http", "yaml"}
print(sorted(heavy & set(sys.modules)))
"""
    assert run_python(program).stdout == "[]\n"


@needs_cyclone_dds
def test_helpers():
    assert timeout_sec_to_nsec(None) == -1
    assert timeout_sec_to_nsec(-0.5) == -1
    assert timeout_sec_to_nsec(0) == 0
    assert timeout_sec_to_nsec(1.5) == 1_500_000_000
    assert remove_ros_args(["program", "a", "--ros-args", "-r", "x:=y", "--", "b"]) == [
        "program",
        "a",
        "b",
    ]
    assert rclpy.utilities.get_rmw_implementation_identifier() == "local"
    assert rclpy.utilities.get_available_rmw_implementations() == {
        "rmw_cyclonedds_cpp",
        "rmw_zenoh_cpp",
    }


@pytest.mark.parametrize("middleware", ["local", "rmw_cyclonedds_cpp"])
def test_a_callback_may_shut_down_while_others_wait_for_it(context, node, executor):
    got_there = []
    node.create_subscription(Int32, "number", got_there.append, 10)
    publisher = node.create_publisher(Int32, "number", 10)

    def end():
        publisher.publish(Int32())
        publisher.wait_for_all_acked()
        # Finds the message, whose callback has to wait for this one.
        executor.spin_once(timeout_sec=0.1)
        context.shutdown()

    assert context.wait_for_graph(lambda: publisher.get_subscription_count() == 1, 60_000_000_000)
    node.create_guard_condition(end).trigger()
    executor.spin_once()
    with pytest.raises(ExternalShutdownException):
        executor.spin_once()
    assert got_there == []


@pytest.mark.parametrize("middleware", ["rmw_cyclonedds_cpp", "rmw_zenoh_cpp"])
def test_shutdown_callbacks_at_exit_find_the_middleware_open(program, monkeypatch, middleware):
    monkeypatch.setenv("RMW_IMPLEMENTATION", middleware)
    ended = program(
        """
        import rclpy
        from std_msgs.msg import Int32

        rclpy.init()
        node = rclpy.create_node("ends")
        publisher = node.create_publisher(Int32, "words", 1)
        node.create_subscription(Int32, "words", lambda _: None, 1)
        is_heard = lambda: publisher.get_subscription_count() == 1
        assert node.context.wait_for_graph(is_heard, 60_000_000_000)

        def speak():
            publisher.publish(Int32(data=1))
            print("said")

        node.context.on_shutdown(speak)
        """
    )
    assert ended.finish() == (0, "said\n", "")


def test_the_first_context_with_logging_configures_it():
    program = """
import rclpy.context
from rclpy.context import Context
from rclpy.logging import get_logger

silent, loud, later = Context(), Context(), Context()
count = lambda: rclpy.context.g_logging_ref_count
silent.init(args=["p", "--ros-args", "--log-level", "error"], initialize_logging=False)
print(count(), get_logger("a").get_effective_level().name)
loud.init(args=["p", "--ros-args", "--log-level", "debug"])
later.init(args=["p", "--ros-args", "--log-level", "fatal"])
print(count(), get_logger("a").get_effective_level().name)
for context in (silent, loud, later):
    context.shutdown()
    print(count())
Context().init(args=["p", "--ros-args", "--log-level", "warn"])
print(get_logger("a").get_effective_level().name)
"""
    done = run_python(program, timeout=60)
    assert done.stdout.split() == ["0", "INFO", "2", "DEBUG", "2", "1", "0", "WARN"]


def test_a_context_has_no_domain_before_init():
    with pytest.raises(RuntimeError, match="must be initialized before it can have a domain id"):
        Context().get_domain_id()
