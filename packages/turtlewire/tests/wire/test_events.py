"""The counters of an event between two takes."""

from turtlewire.wire.base import EventKind, EventStatus
from turtlewire.wire.events import StatusEvent


def test_changes_add_up_until_they_are_taken():
    event = StatusEvent(EventKind.MATCHED)
    assert event.take() is None
    event.add(EventStatus(1, 1, 1, 1))
    event.add(EventStatus(2, 1, 2, 1))
    event.add(EventStatus(2, 0, 1, -1))
    assert event.take() == EventStatus(2, 2, 1, 1)
    assert event.take() is None
    event.add(EventStatus(2, 0, 0, -1))
    assert event.take() == EventStatus(2, 0, 0, -1)
