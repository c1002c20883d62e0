"""Rows of the tree, and one frame as another sees it."""

from __future__ import annotations

import math

import pytest

from turtlewire import Buffer
from turtlewire_view.tree import (
    TreeTable,
    missing_frame,
    path_between,
    relation,
    transform_in_words,
)

SECOND = 10**9
IDENTITY = (0.0, 0.0, 0.0, 1.0)


@pytest.fixture
def buffer():
    buffer = Buffer()
    for step in range(11):
        buffer.set_transform("map", "base", SECOND + step * SECOND // 10, (1, 2, 0), IDENTITY)
    buffer.set_static_transform("base", "laser", (0, 0, 1), IDENTITY, sender="/rsp")
    return buffer


def test_rows_say_who_sends_how_often_and_how_late(buffer):
    table = TreeTable()
    rows = {row["name"]: row for row in table.rows(buffer, 2 * SECOND + SECOND // 4)}
    assert rows["base"]["rate"] == pytest.approx(10.0)
    assert rows["base"]["age"] == pytest.approx(0.25)
    assert rows["laser"] == {
        "name": "laser",
        "parent": "base",
        "publisher": "/rsp",
        "static": True,
        "samples": 1,
        "rate": None,
        "age": None,
        "delay": None,
        "departed": False,
    }
    assert rows["base"]["delay"] is None  # its newest sample may have come long ago
    buffer.set_transform("map", "base", 3 * SECOND, (1, 2, 0), IDENTITY)
    table.rows(buffer, 3 * SECOND + SECOND // 4)
    rows = {row["name"]: row for row in table.rows(buffer, 4 * SECOND)}
    assert (rows["base"]["age"], rows["base"]["delay"]) == (1.0, 0.25)
    departed = table.rows(buffer, 4 * SECOND, ["base"])
    assert [row["name"] for row in departed if row["departed"]] == ["base"]


def test_a_single_sample_has_no_rate():
    buffer = Buffer()
    buffer.set_transform("map", "base", SECOND, (1, 2, 0), IDENTITY)
    assert TreeTable().rows(buffer, 2 * SECOND)[0]["rate"] is None


def test_a_relation_has_numbers_and_a_sentence(buffer):
    found = relation(buffer, "map", "laser", None)
    assert found["translation"] == [1.0, 2.0, 1.0]
    assert found["matrix"][0] == [1.0, 0.0, 0.0, 1.0]
    assert found["rpy"] == [0.0, 0.0, 0.0]
    assert found["sentence"].startswith(
        "laser is 1.00 m ahead, 2.00 m to the left and 1.00 m above"
    )


def test_a_relation_that_is_not_there_says_why(buffer):
    buffer.set_transform("island", "palm", SECOND, (0, 0, 0), IDENTITY)
    apart = relation(buffer, "map", "palm", None)
    assert "not part of the same tree" in apart["error"]
    assert apart["hint"]
    unknown = relation(buffer, "map", "lasre", None)
    assert unknown["error"] == "There is no frame 'lasre'."
    assert "laser" in unknown["hint"]
    early = relation(buffer, "map", "base", SECOND // 2)
    assert "extrapolation into the past" in early["error"]


def test_a_link_that_ended_is_named():
    buffer = Buffer(2 * SECOND)
    buffer.set_transform("map", "stopped", SECOND, (1, 0, 0), IDENTITY, sender="/old_node")
    for second in range(1, 31):
        buffer.set_transform("map", "base", second * SECOND, (0, 0, 0), IDENTITY)
    found = relation(buffer, "base", "stopped", None)
    assert "extrapolation into the past" in found["error"]
    assert found["hint"] == (
        "The last transform of 'stopped' is 29 s older than the last transform of 'base', of which "
        "3 s are kept. Does /old_node still publish 'stopped'?"
    )


def test_at_a_stamp_the_last_known_place_counts(buffer):
    assert relation(buffer, "map", "base", 16 * SECOND)["translation"] == [1.0, 2.0, 0.0]
    assert "extrapolation into the future" in relation(buffer, "map", "base", 18 * SECOND)["error"]


def test_the_path_leads_over_the_common_ancestor():
    names = ["map", "left", "hand", "right", "island"]
    parents = [-1, 0, 1, 0, -1]
    assert path_between(names, parents, "right", "hand") == ["hand", "left", "map", "right"]
    assert path_between(names, parents, "map", "map") == ["map"]
    assert path_between(names, parents, "island", "map") == []
    assert path_between(names, parents, "nobody", "map") == []


def test_a_frame_that_does_not_exist_is_hinted_at():
    names = ["map", "base", *(f"link{k}" for k in range(8))]
    assert missing_frame("bsae", names) == "There is no frame 'bsae'. Did you mean: base"
    known = "There is no frame 'odometry'. The frames are " + ", ".join(names)
    assert missing_frame("odometry", names) == known
    assert missing_frame("odometry", [*names, "tip"]) == f"{known} and 1 more"
    assert missing_frame("base", names) == ""
    assert missing_frame("", names) == ""
    assert missing_frame("odometry", []) == ""


# The sentence says what the numbers say.


SAME = (0.0, 0.0, 0.0, 1.0)
LEFT = (0.0, 0.0, math.sin(math.pi / 4), math.cos(math.pi / 4))


@pytest.mark.parametrize(
    ("translation", "rotation", "sentence"),
    [
        ((0, 0, 0), SAME, "a is where b is, and looks the same way."),
        ((2, 0, 0), SAME, "a is 2.00 m ahead of b, and looks the same way."),
        ((-2, 0, 0), SAME, "a is 2.00 m behind b, and looks the same way."),
        (
            (1, 0.5, 0),
            LEFT,
            "a is 1.00 m ahead and 0.50 m to the left of b, and looks 90° further to the left.",
        ),
        (
            (1, 0, 0.25),
            (0.0, 0.0, -LEFT[2], LEFT[3]),
            "a is 1.00 m ahead and 0.25 m above b, and looks 90° further to the right.",
        ),
        ((0, 0, 1), (LEFT[2], 0, 0, LEFT[3]), "a is 1.00 m above b, and is turned by 90°."),
        ((math.nan, 0, 0), SAME, "a has no finite position in b."),
    ],
)
def test_sentences(translation, rotation, sentence):
    assert transform_in_words("a", "b", translation, rotation) == sentence
