"""Both broadcasters; static transforms are never lost."""

import contextlib
import gc
import random

import pytest

from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.time import Time
from tf2_ros import Buffer, StaticTransformBroadcaster, TransformBroadcaster, TransformListener

LONG = Duration(seconds=60)


@pytest.fixture
def heard(make_node):
    """Return a function that starts a listener and returns its buffer."""

    def listen():
        buffer = Buffer()
        TransformListener(buffer, make_node(f"listener{random.randrange(10**9)}"))
        return buffer

    return listen


def x_of(buffer, child, parent="world"):
    return buffer.lookup_transform(parent, child, Time(), LONG).transform.translation.x


def test_one_or_several_transforms(node, heard, stamped):
    buffer, broadcaster = heard(), TransformBroadcaster(node)
    broadcaster.sendTransform(stamped(child="a", x=1.0))
    broadcaster.sendTransform([stamped(child="b", x=2.0), stamped(child="c", x=3.0)])
    broadcaster.sendTransform(stamped(child=name, x=4.0) for name in ("d", "e"))
    assert [x_of(buffer, child) for child in "abcde"] == [1.0, 2.0, 3.0, 4.0, 4.0]


def test_the_topics_and_their_qualities(node):
    dynamic, static = TransformBroadcaster(node).pub_tf, StaticTransformBroadcaster(node).pub_tf
    assert (dynamic.topic_name, static.topic_name) == ("/tf", "/tf_static")
    assert dynamic.qos_profile == QoSProfile(depth=100)
    assert static.qos_profile == QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    assert TransformBroadcaster(node, qos=7).pub_tf.qos_profile == QoSProfile(depth=7)
    assert StaticTransformBroadcaster(node, QoSProfile(depth=2)).pub_tf.qos_profile == QoSProfile(
        depth=2
    )


def test_late_joiners_get_everything_that_was_sent(node, heard, stamped):
    broadcaster = StaticTransformBroadcaster(node)
    for number in range(5):
        broadcaster.sendTransform(stamped(child=f"frame{number}", x=float(number)))
    buffer = heard()
    assert [x_of(buffer, f"frame{number}") for number in range(5)] == [0.0, 1.0, 2.0, 3.0, 4.0]


def test_a_static_transform_can_be_sent_again(node, heard, stamped):
    broadcaster, early = StaticTransformBroadcaster(node), heard()
    broadcaster.sendTransform([stamped(child="a", x=1.0), stamped(child="b", x=1.0)])
    broadcaster.sendTransform(stamped(child="a", x=2.0))
    broadcaster.sendTransform(stamped(child="last", x=0.0))
    for buffer in (early, heard()):
        x_of(buffer, "last")
        assert (x_of(buffer, "a"), x_of(buffer, "b")) == (2.0, 1.0)


def test_the_caller_may_reuse_the_message(node, heard, stamped):
    broadcaster, message = StaticTransformBroadcaster(node), stamped(child="a", x=1.0)
    broadcaster.sendTransform(message)
    message.transform.translation.x = 99.0
    broadcaster.sendTransform(stamped(child="b"))
    buffer = heard()
    x_of(buffer, "b")
    assert x_of(buffer, "a") == 1.0


def test_a_transform_with_a_wrong_field_is_not_kept(node, heard, stamped):
    broadcaster = StaticTransformBroadcaster(node)
    broadcaster.sendTransform(stamped(child="a", x=1.0))
    with pytest.raises(ValueError, match="expected a float, got str"):
        broadcaster.sendTransform([stamped(child="a", x=2.0), stamped(child="b", x="far")])
    broadcaster.sendTransform(stamped(child="c", x=3.0))
    buffer = heard()
    assert [x_of(buffer, child) for child in "ac"] == [1.0, 3.0]
    assert not buffer._frameExists("b")


def test_the_last_sender_of_a_process_wins_for_late_joiners_too(node, make_node, heard, stamped):
    first, second = (
        StaticTransformBroadcaster(node),
        StaticTransformBroadcaster(make_node("second")),
    )
    first.sendTransform([stamped(child="a", x=1.0), stamped(child="only", x=5.0)])
    second.sendTransform(stamped(child="a", x=2.0))
    late = heard()
    x_of(late, "only")
    assert x_of(late, "a") == 2.0
    first.sendTransform(stamped(child="a", x=3.0))
    later = heard()
    x_of(later, "only")
    assert x_of(later, "a") == 3.0


def test_it_may_replace_what_a_destroyed_node_sent(make_node, heard, stamped):
    gone, staying = make_node("gone"), make_node("staying")
    StaticTransformBroadcaster(gone).sendTransform(stamped(child="a", x=1.0))
    gone.destroy_node()
    StaticTransformBroadcaster(staying).sendTransform(stamped(child="a", x=2.0))
    assert x_of(heard(), "a") == 2.0


def join_late(open_node, stamped, enough_joins, *, leaving, sending, child):
    """Any order of sending, joining and restarting.

    A late joiner sees exactly what the living broadcasters sent last.

    Args:
        open_node: Makes a node until the end of a block.
        stamped: Makes a transform.
        enough_joins: How often something joins.
        leaving: Chance of a step in which a broadcaster leaves.
        sending: The same, and that of one in which it sends.
        child: Names a frame of a broadcaster.
    """
    chance = random.Random(20261121)
    broadcasters, expected, owner = {}, {}, {}
    joins = step = 0
    with contextlib.ExitStack() as opened:
        while joins < enough_joins:
            step += 1
            name = f"broadcaster{chance.randrange(4)}"
            action = chance.random()
            if action < leaving and name in broadcasters:
                broadcasters.pop(name)[0].close()
                expected = {child: x for child, x in expected.items() if owner[child] != name}
            elif action < sending:
                if name not in broadcasters:
                    life = opened.enter_context(contextlib.ExitStack())
                    node = life.enter_context(open_node(name))
                    broadcasters[name] = (life, StaticTransformBroadcaster(node))
                children = [child(name, chance) for _ in range(chance.randrange(1, 4))]
                broadcasters[name][1].sendTransform(
                    [stamped(child=each, x=float(step)) for each in children]
                )
                expected |= dict.fromkeys(children, float(step))
                owner |= dict.fromkeys(children, name)
            else:
                joins += 1
                with open_node("joined") as node:
                    buffer = Buffer()
                    TransformListener(buffer, node)
                    assert {each: x_of(buffer, each) for each in expected} == expected
                    there = {"world", *expected} if expected else set()
                    assert set(buffer._getFrameStrings()) == there


@pytest.mark.slow
def test_no_peer_is_lost_over_a_thousand_joins(make_node, stamped):
    def child(_, chance):
        return f"frame{chance.randrange(12)}"

    join_late(make_node, stamped, 1000, leaving=0.1, sending=0.8, child=child)


@contextlib.contextmanager
def open_participant(name):
    """A node on its own participant, as in another process."""
    quiet = {"enable_rosout": False, "start_parameter_services": False}
    with Context() as context, Node(name, context=context, **quiet) as node:
        yield node


@pytest.mark.parametrize("enough_joins", [100, pytest.param(1000, marks=pytest.mark.slow)])
@pytest.mark.usefixtures("real_middleware")
def test_no_static_transform_is_lost_over_dds(enough_joins, stamped):
    """The same with participants of Cyclone DDS, each with its own frames."""

    def child(name, chance):
        return f"{name}_frame{chance.randrange(6)}"

    join_late(open_participant, stamped, enough_joins, leaving=0.02, sending=0.3, child=child)


def test_a_destroyed_broadcaster_says_so(node, stamped):
    broadcaster = TransformBroadcaster(node)
    node.destroy_node()
    with pytest.raises(Exception, match="destruction was requested"):
        broadcaster.sendTransform(stamped())


def test_broadcasters_that_are_gone_leave_nothing_behind(context, node, stamped):
    """A process whose nodes come and go with ever new frames does not grow."""
    staying = StaticTransformBroadcaster(node)
    staying.sendTransform(stamped(child="staying"))
    gc.freeze()  # collections look at what comes from now on only, and are quick
    for number in range(20):
        passing = Node(f"passing{number}", context=context)
        StaticTransformBroadcaster(passing).sendTransform(stamped(child=f"frame{number}"))
        passing.destroy_node()
        del passing
        gc.collect()
    gc.unfreeze()
    StaticTransformBroadcaster(node)
    assert list(staying._keepers) == ["staying"]
