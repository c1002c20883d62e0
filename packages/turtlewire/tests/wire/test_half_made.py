"""What Cyclone DDS refuses in the middle leaves nothing behind."""

from __future__ import annotations

import pytest
from tests.needs import COMPILED_CORE, needs_cyclone_dds

from turtlewire.errors import WireError
from turtlewire.tf.buffer import CORE
from turtlewire.wire import open_context
from turtlewire.wire.base import Context, TypeId
from turtlewire.wire.qos import QoS

pytestmark = needs_cyclone_dds

STRING = TypeId("std_msgs/msg/String", "RIHS01_" + "0" * 64)
CYCLONE = "turtlewire.wire.cyclone"


def refuse(*_arguments):
    raise WireError("refused")


@pytest.mark.parametrize(
    "step",
    [
        "participant.dds.guid_of",
        "participant.Participant._check_types",
        "context_state.CycloneReaderThread",
        "context_state.Announcer",
    ],
)
def test_a_context_that_fails_leaves_its_domain(monkeypatch, step: str):
    from turtlewire.wire.cyclone.participant import _domains

    before = dict(_domains._users)
    with monkeypatch.context() as patched:
        patched.setattr(f"{CYCLONE}.{step}", refuse)
        with pytest.raises(WireError, match="refused"):
            open_context(77, middleware="rmw_cyclonedds_cpp")
    assert _domains._users == {**before, 77: 0}


def test_an_endpoint_that_fails_is_deleted(monkeypatch, context: Context):
    from turtlewire.wire.cyclone import library

    node = context.create_node("one")
    made, deleted = [], []
    make, delete = library.create_reader, library.delete
    monkeypatch.setattr(library, "create_reader", lambda *args: made.append(make(*args)) or made[0])
    monkeypatch.setattr(library, "delete", lambda handle: deleted.append(handle) or delete(handle))
    monkeypatch.setattr(library, "guid_of", refuse)
    with pytest.raises(WireError, match="refused"):
        node.create_subscription("/chatter", STRING, QoS())
    assert made[0] > 0
    assert made[0] in deleted


@pytest.mark.skipif(CORE != "native", reason=COMPILED_CORE)
@pytest.mark.parametrize("step", ["participant.Participant._create_topic", "library.guid_of"])
def test_the_way_to_a_sink_ends_with_its_subscription(monkeypatch, context: Context, step: str):
    from turtlewire._native import Intake
    from turtlewire.wire.cyclone.native import Inlet

    open_inlets, make, close = [], Inlet.__init__, Inlet.close
    monkeypatch.setattr(Inlet, "__init__", lambda *args: open_inlets.append(args[0]) or make(*args))
    monkeypatch.setattr(Inlet, "close", lambda inlet: open_inlets.remove(inlet) or close(inlet))
    node = context.create_node("one")
    monkeypatch.setattr(f"{CYCLONE}.{step}", refuse)
    with pytest.raises(WireError, match="refused"):
        node.create_subscription(
            "/chatter", STRING, QoS(), None, Intake(False, 1, lambda *_: (b"", ""), int)
        )
    assert open_inlets == []
