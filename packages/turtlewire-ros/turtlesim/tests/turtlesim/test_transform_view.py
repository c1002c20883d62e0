"""The TF data of the page, over a real middleware in this process."""

from __future__ import annotations

import pytest

from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage
from turtlesim.transform_view import Frame, TransformView
from turtlewire import msg
from turtlewire.tf import listener
from turtlewire.wire import open_context
from turtlewire.wire.base import TypeId

from .seen import wait_until


@pytest.fixture
def context():
    context = open_context(middleware="local")
    yield context
    context.close()


class Broadcaster:
    def __init__(self, context) -> None:
        node = context.create_node("broadcaster")
        type_id = TypeId(listener.TYPE_NAME, msg.type_hash(listener.TYPE_NAME))
        self._tf = node.create_publisher(listener.TOPIC, type_id, listener.QOS)
        self._static = node.create_publisher(listener.STATIC_TOPIC, type_id, listener.STATIC_QOS)

    def send(
        self,
        parent: str,
        child: str,
        stamp_s: int,
        x: float = 0.0,
        y: float = 0.0,
        *,
        static: bool = False,
    ) -> None:
        transform = TransformStamped(child_frame_id=child)
        transform.header.frame_id = parent
        transform.header.stamp.sec = stamp_s
        transform.transform.translation.x, transform.transform.translation.y = x, y
        (self._static if static else self._tf).publish(
            msg.serialize(TFMessage(transforms=[transform]))
        )


@pytest.fixture
def broadcaster(context):
    return Broadcaster(context)


@pytest.fixture
def view(context):
    view = TransformView(context, "/", lambda: 105_000_000_000)
    yield view
    view.close()


def test_frames_with_rate_age_and_kind(view, broadcaster):
    broadcaster.send("turtle1", "carrot", 0, x=0.0, y=2.0, static=True)
    view.join()
    for stamp_s in (100, 101, 102):
        broadcaster.send("world", "turtle1", stamp_s, x=float(stamp_s))
    wait_until(lambda: len(view.frames()) == 2 and view.frames()[1].age == 3.0)
    carrot, turtle1 = view.frames()
    assert carrot == Frame("carrot", "turtle1", None, None)
    assert (turtle1.parent, turtle1.rate) == ("world", pytest.approx(1.5, abs=0.51))
    assert view.relation("world", "carrot") == {
        "translation": [102.0, 2.0, 0.0],
        "rotation": [0.0, 0.0, 0.0, 1.0],
    }


def test_a_frame_that_was_heard_once_is_not_static(view, broadcaster):
    view.join()
    broadcaster.send("world", "turtle1", 102)
    wait_until(view.frames)
    assert view.frames() == [Frame("turtle1", "world", 0.0, 3.0)]


def test_errors_are_those_of_tf2(view, broadcaster):
    view.join()
    broadcaster.send("world", "turtle1", 100)
    wait_until(view.frames)
    relation = view.relation("world", "turtle2")
    assert relation.keys() == {"error", "hint"}
    assert (
        relation["error"]
        == '"turtle2" passed to lookupTransform argument source_frame does not exist. '
    )


def test_non_finite_values_are_sent_as_null(view, broadcaster):
    view.join()
    broadcaster.send("world", "far", 100, x=float("inf"))
    wait_until(view.frames)
    assert view.relation("world", "far")["translation"] == [
        None,
        None,
        None,
    ]  # infinity times zero is no number either


def test_it_listens_only_while_somebody_looks(context, view, broadcaster):
    def nodes() -> list[str]:
        return sorted(node.name for node in context.graph.nodes())

    assert nodes() == ["broadcaster"]
    view.join()
    view.join()
    assert nodes() == ["_turtlesim_page", "broadcaster"]
    view.leave()
    broadcaster.send("world", "turtle1", 100)
    wait_until(view.frames)
    view.leave()
    assert nodes() == ["broadcaster"]
    view.join()
    assert view.frames() == []
    view.close()
    assert nodes() == ["broadcaster"]
