"""Suggestions for names that do not exist."""

from __future__ import annotations

import pytest

from turtlewire.terminal.suggestion import did_you_mean


@pytest.mark.parametrize(
    ("name", "known", "suggestion"),
    [
        ("/joint_state", ["/joint_states", "/tf_static", "/tf"], "Did you mean: /joint_states"),
        (
            "my_interface/msg/Foo",
            ["my_interfaces/msg/Foo", "example_interfaces/msg/Bool", "rcl_interfaces/msg/Log"],
            "Did you mean: my_interfaces/msg/Foo",
        ),
        ("turtle", ["turtle2", "turtle1"], "Did you mean: turtle2, turtle1"),
        ("x", ["turtle"], ""),
    ],
)
def test_names_much_less_similar_than_the_nearest_are_left_out(name, known, suggestion):
    assert did_you_mean(name, known) == suggestion
