"""Messages in which fields have changed."""

from operator import attrgetter

import pytest

from geometry_msgs.msg import PointStamped
from message_filters import SimpleFilter
from message_filters.delta_filter import (
    CachedComparisonHandler,
    ComparisonFilter,
    ComparisonHandler,
    DeltaFilter,
    PathDeltaFilter,
)
from sensor_msgs.msg import CameraInfo


def point(frame, x, y=0.0):
    message = PointStamped()
    message.header.frame_id = frame
    message.point.x, message.point.y = x, y
    return message


def passed(messages, filtered, source):
    heard = []
    filtered.registerCallback(heard.append)
    for message in messages:
        source.signalMessage(message)
    return [messages.index(message) for message in heard]


@pytest.mark.parametrize(
    ("paths", "expected"),
    [
        (["point.x"], [0, 2, 4]),
        (["header.frame_id"], [0, 3]),
        (["point.x", "header.frame_id"], [0, 2, 3, 4]),
    ],
)
def test_changed_fields_let_messages_pass(paths, expected):
    # y differs, so that no two messages are equal
    values = [("a", 1.0), ("a", 1.0), ("a", 2.0), ("b", 2.0), ("b", 1.0)]
    messages = [point(frame, x, float(i)) for i, (frame, x) in enumerate(values)]
    source = SimpleFilter()
    assert passed(messages, PathDeltaFilter(paths, source), source) == expected
    source = SimpleFilter()
    getters = [attrgetter(path) for path in paths]
    assert passed(messages, DeltaFilter(getters, source), source) == expected


def test_arrays_are_compared_number_by_number():
    first, same, other = CameraInfo(width=1), CameraInfo(width=2), CameraInfo(width=3)
    other.k[4] = 5.0
    source = SimpleFilter()
    assert passed([first, same, other], PathDeltaFilter(["k"], source), source) == [0, 2]


def test_another_input_replaces_the_one_before():
    first, second = SimpleFilter(), SimpleFilter()
    filtered = PathDeltaFilter(["point.x"], first)
    filtered.connectInput(second)
    assert passed([point("a", 1.0)], filtered, first) == []
    assert passed([point("a", 1.0)], filtered, second) == [0]


def test_fields_that_do_not_exist_are_named():
    filtered = PathDeltaFilter(["point.w"])
    filtered.add(point("a", 1.0))
    with pytest.raises(AttributeError, match=r"'point.w': Point has no field 'w'; it has x, y, z"):
        filtered.add(point("a", 1.0))
    with pytest.raises(AttributeError, match=r"'point.x.y': float has no field 'y'; it has no"):
        filtered.get_field_by_path(point("a", 1.0), "point.x.y")
    with pytest.raises(TypeError, match=r"write \['point.x'\]"):
        PathDeltaFilter("point.x")


def test_a_comparison_of_your_own():
    class Rises(CachedComparisonHandler):
        def do_fields_fit(self, field_a, field_b):
            return field_b > field_a

        def message_fits(self, message):
            former, self.message_cache = self.message_cache, message
            return former is not None and self.do_fields_fit(former.point.x, message.point.x)

    source = SimpleFilter()
    messages = [point("a", x) for x in (2.0, 1.0, 3.0, 3.0, 4.0)]
    messages[3].point.y = 1.0
    assert passed(messages, ComparisonFilter(Rises(), source), source) == [2, 4]
    with pytest.raises(TypeError, match="abstract"):
        ComparisonHandler()
