"""tf2_ros.TransformListener on nodes: its arguments, its thread, its end."""

import threading

import pytest

import rclpy
import turtlewire
from rclpy.duration import Duration
from rclpy.exceptions import InvalidParameterTypeException
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import QoSProfile
from rclpy.task import Future
from rclpy.time import Time
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage
from tf2_ros import (
    Buffer,
    StaticTransformBroadcaster,
    StaticTransformListener,
    TransformBroadcaster,
    TransformListener,
)

LONG = Duration(seconds=60)


def subscriptions(node, topic):
    return [info.node_name for info in node.get_subscriptions_info_by_topic(topic)]


def test_it_needs_no_executor(make_node, stamped):
    buffer = Buffer()
    TransformListener(buffer, make_node("listener"))
    TransformBroadcaster(make_node("talker")).sendTransform(stamped(x=1.0))
    assert buffer.lookup_transform("world", "robot", Time(), LONG).transform.translation.x == 1.0


def test_the_graph_shows_its_subscriptions_as_the_node_s(node):
    listener = TransformListener(Buffer(), node)
    assert subscriptions(node, "/tf") == subscriptions(node, "/tf_static") == ["node"]
    listener.unregister()
    listener.unregister()
    assert subscriptions(node, "/tf") == subscriptions(node, "/tf_static") == []


def test_topics_follow_remappings_and_arguments(make_node, stamped):
    remapped = make_node("remapped", cli_args=["--ros-args", "-r", "/tf:=/robot1/tf"])
    buffer, named = Buffer(), Buffer()
    TransformListener(buffer, remapped)
    TransformListener(
        named, make_node("named"), tf_topic="/robot1/tf", tf_static_topic="/robot1/tf_static"
    )
    talker = make_node("talker")
    talker.create_publisher(TFMessage, "/robot1/tf", 10).publish(TFMessage(transforms=[stamped()]))
    for each in (buffer, named):
        each.lookup_transform("world", "robot", Time(), LONG)
    assert subscriptions(talker, "/robot1/tf_static") == ["named"]


def test_qos(node):
    TransformListener(Buffer(), node, qos=3, static_qos=QoSProfile(depth=4))
    (dynamic,) = node.get_subscriptions_info_by_topic("/tf")
    (static,) = node.get_subscriptions_info_by_topic("/tf_static")
    assert dynamic.qos_profile.depth == 3
    assert static.qos_profile.depth == 4


def test_swapped_arguments(node):
    with pytest.raises(TypeError, match=r"takes the buffer first, not <class 'rclpy\.node\.Node'>"):
        TransformListener(node, Buffer())


def test_static_listeners(make_node, stamped):
    buffer, other = Buffer(), Buffer()
    node = make_node("static")
    StaticTransformListener(buffer, node)
    TransformListener(other, node, static_only=True)
    assert subscriptions(node, "/tf") == []
    StaticTransformBroadcaster(make_node("talker")).sendTransform(stamped())
    for each in (buffer, other):
        each.lookup_transform("world", "robot", Time(), LONG)


def test_it_ends_with_its_node_and_leaves_others_alone(make_node, stamped):
    first, second = make_node("first"), make_node("second")
    buffers = Buffer(), Buffer()
    for buffer, node in zip(buffers, (first, second), strict=True):
        TransformListener(buffer, node)
    assert subscriptions(second, "/tf") == [
        "first"
    ]  # one subscription in this process, of the node that came first
    first.destroy_node()
    assert subscriptions(second, "/tf") == ["second"]
    TransformBroadcaster(second).sendTransform(stamped())
    buffers[1].lookup_transform("world", "robot", Time(), LONG)
    assert not buffers[0]._frameExists("robot")


def test_spin_thread_serves_the_node_s_other_callbacks(node):
    heard = threading.Event()
    node.create_subscription(String, "chatter", lambda _message: heard.set(), 1)
    listener = TransformListener(Buffer(), node, spin_thread=True)
    node.create_publisher(String, "chatter", 1).publish(String(data="hello"))
    assert heard.wait(60)
    thread = listener.dedicated_listener_thread
    listener.unregister()
    assert not thread.is_alive()


def test_spin_thread_ends_with_the_context(context, node):
    thread = TransformListener(Buffer(), node, spin_thread=True).dedicated_listener_thread
    context.shutdown()
    thread.join(60)
    assert not thread.is_alive()


def test_rclpy_spin_takes_over_while_the_listener_s_thread_runs_a_callback(context, node):
    started, may_end, served = threading.Event(), threading.Event(), Future()

    def hold():
        started.set()
        assert may_end.wait(60)

    node.create_guard_condition(hold).trigger()
    listener = TransformListener(Buffer(), node, spin_thread=True)
    assert started.wait(60)
    executor = SingleThreadedExecutor(context=context)
    node.create_guard_condition(lambda: served.set_result(None)).trigger()
    rclpy.spin_once(node, executor=executor, timeout_sec=0)  # it finds the callback group busy
    may_end.set()
    rclpy.spin_until_future_complete(node, served, executor, timeout_sec=60)
    assert served.done()
    executor.shutdown()
    listener.unregister()


def test_a_callback_may_unregister_the_listener_that_spins_it(node):
    done = threading.Event()
    listener = TransformListener(Buffer(), node, spin_thread=True)

    def on_timer():
        listener.unregister()
        done.set()

    node.create_timer(0.001, on_timer)
    assert done.wait(60)
    listener.dedicated_listener_thread.join(60)
    assert not listener.dedicated_listener_thread.is_alive()


def test_messages_from_elsewhere_can_be_handed_in(node, stamped):
    buffer = Buffer()
    listener = TransformListener(buffer, node)
    listener.callback(TFMessage(transforms=[stamped(child="moves")]))
    listener.static_callback(TFMessage(transforms=[stamped(child="stays")]))
    assert buffer.can_transform("moves", "stays", Time())
    assert listener.buffer is buffer
    assert listener.node is node


def test_no_message_is_decoded_on_the_way(make_node, stamped, monkeypatch):
    buffer, broadcaster = Buffer(), TransformBroadcaster(make_node("talker"))
    TransformListener(buffer, make_node("listener"))
    monkeypatch.setattr(TFMessage, "_from_cdr", lambda *_: pytest.fail("decoded"))
    broadcaster.sendTransform(stamped())
    buffer.lookup_transform("world", "robot", Time(), LONG)


def test_a_listener_without_a_node_makes_one(stamped):
    with rclpy.init(args=[]):
        buffer = Buffer()
        listener = TransformListener(buffer, None)
        TransformBroadcaster(listener.node).sendTransform(stamped())
        buffer.lookup_transform("world", "robot", Time(), LONG)
        own = listener.node
        listener.unregister()
        assert list(own.publishers) == []


def test_the_executor_of_the_user_is_free_to_spin_the_node(context, node):
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    TransformListener(Buffer(), node)
    executor.spin_once(timeout_sec=0)


class NotingEngine(turtlewire.Buffer):
    """A buffer that reports the removal of a frame."""

    def __init__(self):
        super().__init__()
        self.removed = threading.Event()

    def remove_frame(self, child_frame):
        found = super().remove_frame(child_frame)
        self.removed.set()
        return found


def test_a_parameter_forgets_frames_of_publishers_that_left(make_node, stamped):
    arguments = ["--ros-args", "-p", "tf_forget_after:=0.0"]
    buffer, plain = Buffer(), Buffer()
    buffer.engine = NotingEngine()
    node = make_node("listener", cli_args=arguments)
    TransformListener(buffer, node)
    other = make_node("plain")
    TransformListener(plain, other)
    talker = make_node("talker")
    TransformBroadcaster(talker).sendTransform(stamped())
    for each in (buffer, plain):
        each.engine.lookup_transform("world", "robot", None, timeout_ns=LONG.nanoseconds)
    talker.destroy_node()
    assert buffer.engine.removed.wait(60.0)
    assert buffer.engine.frames() == []
    assert node.get_parameter("tf_forget_after").value == 0.0
    assert not other.has_parameter("tf_forget_after")
    assert "robot" in plain.engine


def test_a_wrong_type_of_the_parameter_is_explained(make_node):
    node = make_node("listener", cli_args=["--ros-args", "-p", "tf_forget_after:=5"])
    with pytest.raises(InvalidParameterTypeException) as caught:
        TransformListener(Buffer(), node)
    assert "5.0" in caught.value.hint
