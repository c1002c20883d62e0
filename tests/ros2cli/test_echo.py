"""Fields and filters of `ros2 topic echo`."""

from __future__ import annotations

import pytest

from ros2cli.commands.topic.echo import _field, make_filter
from turtlewire.msg import get_message


def test_fields_by_names_and_indices():
    message = get_message("tf2_msgs/msg/TFMessage")(
        transforms=[get_message("geometry_msgs/msg/TransformStamped")(child_frame_id="a")]
    )
    assert _field(message, "transforms[0].child_frame_id") == "a"
    assert _field(message, None) is message


@pytest.mark.parametrize("path", ["nope", "transforms[3]", "transforms.x"])
def test_fields_that_are_not_there(path):
    with pytest.raises(RuntimeError, match=r"^Invalid field '.*': "):
        _field(get_message("tf2_msgs/msg/TFMessage")(), path)


def test_filters():
    keep = make_filter("m.data > 3")
    assert keep(get_message("std_msgs/msg/Int32")(data=4))
    assert not keep(get_message("std_msgs/msg/Int32")(data=3))
    assert make_filter(None) is None
    with pytest.raises(RuntimeError, match="Invalid filter expression"):
        make_filter("m.data >")
