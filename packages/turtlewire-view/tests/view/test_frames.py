"""All frames in one frame: what the page is told to draw.

Rows of the tree, and one frame as another sees it.
"""

import math

import numpy as np
import pytest

from turtlewire import Buffer
from turtlewire_view.frames import FrameScene
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
    put(buffer, "map", "base", (1, 0, 0), 1)
    put(buffer, "map", "base", (2, 0, 0), 2)
    put(buffer, "base", "laser", (0, 0, 1), 0, static=True)
    return buffer


def put(buffer, parent, child, place, stamp_s, *, static=False):
    stamp_ns = round(stamp_s * SECOND)
    if static:
        buffer.set_static_transform(parent, child, place)
    else:
        buffer.set_transform(parent, child, stamp_ns, place)


def places(frames):
    return {
        name: tuple(pose[:3]) if known else None
        for name, pose, known in zip(
            frames.structure.names, frames.poses.tolist(), frames.known, strict=True
        )
    }


def test_the_newest_poses_are_given_in_the_largest_trees_root(buffer):
    frames = FrameScene().look(buffer)
    assert frames.fixed == "map"
    assert frames.structure.names == ["map", "base", "laser"]
    assert frames.structure.parents == [-1, 0, 1]
    assert places(frames) == {"map": (0, 0, 0), "base": (2, 0, 0), "laser": (2, 0, 1)}
    assert frames.stamps.tolist() == [0, 2, 2]
    assert frames.poses.dtype == np.float32


def test_another_fixed_frame_and_another_time(buffer):
    scene = FrameScene()
    assert places(scene.look(buffer, "laser")) == {
        "map": (-2, 0, -1),
        "base": (0, 0, -1),
        "laser": (0, 0, 0),
    }
    assert places(scene.look(buffer, "map", 3 * SECOND // 2))["base"] == (1.5, 0, 0)
    early = places(scene.look(buffer, "map", SECOND // 2))
    assert (early["map"], early["base"]) == ((0, 0, 0), None)


def test_frames_whose_data_end_stay_as_long_as_rviz_shows_them(buffer):
    scene = FrameScene()
    put(buffer, "map", "fast", (5, 0, 0), 16)
    frames = scene.look(buffer, "map", 16 * SECOND)
    assert places(frames)["base"] == (2, 0, 0)
    assert frames.stamps[frames.structure.names.index("base")] == 2
    assert places(scene.look(buffer, "map", 17 * SECOND))["base"] == (2, 0, 0)
    assert places(scene.look(buffer, "map", 17 * SECOND + 1_000_000))["base"] is None


def test_an_unknown_fixed_frame_falls_back(buffer):
    assert FrameScene().look(buffer, "nobody").fixed == "map"
    assert FrameScene().look(Buffer(), "nobody").fixed == ""


def test_other_trees_lie_in_their_own_roots(buffer):
    put(buffer, "island", "palm", (0, 3, 0), 1)
    frames = FrameScene().look(buffer)
    assert frames.structure.roots == ["map", "island"]
    assert frames.structure.trees == [0, 0, 0, 1, 1]
    assert places(frames)["palm"] == (0, 3, 0)
    assert FrameScene().look(buffer, "palm").fixed == "palm"


def test_the_structure_changes_when_frames_come_or_move_to_another_parent(buffer):
    scene = FrameScene()
    first = scene.look(buffer).structure.version
    put(buffer, "map", "base", (3, 0, 0), 3)
    assert scene.look(buffer).structure.version == first
    put(buffer, "base", "camera", (1, 0, 0), 3)
    assert scene.look(buffer).structure.version == first + 1
    put(buffer, "laser", "camera", (1, 0, 0), 4)
    scene.read_structure(buffer)
    frames = scene.look(buffer)
    assert frames.structure.version == first + 2
    parents = dict(zip(frames.structure.names, frames.structure.parents, strict=True))
    assert frames.structure.names[parents["camera"]] == "laser"


def test_far_coordinates_stay_exact_to_the_millimetre():
    buffer = Buffer()
    put(buffer, "utm", "map", (448_262.123, 5_411_945.456, 30), 0, static=True)
    put(buffer, "map", "base", (0.001, 0, 0), 1)
    frames = FrameScene().look(buffer)
    found = frames.poses[:, :3].astype(float) + frames.origin
    by_name = dict(zip(frames.structure.names, found, strict=True))
    assert by_name["base"][0] - by_name["map"][0] == pytest.approx(0.001, abs=1e-4)


def test_frames_that_are_not_finite_are_unknown(buffer):
    put(buffer, "map", "far", (1e308, 0, 0), 1)
    put(buffer, "far", "farther", (1e308, 0, 0), 1)
    frames = FrameScene().look(buffer)
    assert places(frames)["farther"] is None
    assert np.isfinite(frames.poses[frames.known == 1, :3]).all() or places(frames)["far"] is None
    assert places(frames)["base"] == (2, 0, 0)


def test_a_loop_is_shown_from_one_of_its_frames():
    buffer = Buffer()
    put(buffer, "a", "b", (1, 0, 0), 1)
    put(buffer, "b", "a", (1, 0, 0), 1)
    frames = FrameScene().look(buffer)
    assert frames.structure.loops
    assert sorted(frames.structure.names) == ["a", "b"]


def test_a_frame_at_the_farthest_distance_is_unknown(buffer):
    farthest = 1.5e11
    put(buffer, "map", "mistake", (0, -farthest, 0), 1)
    put(buffer, "map", "planet", (0, -np.nextafter(farthest, 0), 0), 1)
    found = places(FrameScene().look(buffer))
    assert found["mistake"] is None
    assert found["planet"] is not None


@pytest.fixture
def steady():
    steady = Buffer()
    for step in range(11):
        steady.set_transform("map", "base", SECOND + step * SECOND // 10, (1, 2, 0), IDENTITY)
    steady.set_static_transform("base", "laser", (0, 0, 1), IDENTITY, sender="/rsp")
    return steady


def test_rows_say_who_sends_how_often_and_how_late(steady):
    table = TreeTable()
    rows = {row["name"]: row for row in table.rows(steady, 2 * SECOND + SECOND // 4)}
    assert rows["base"]["publisher"] == ""  # the program named no sender
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
    steady.set_transform("map", "base", 3 * SECOND, (1, 2, 0), IDENTITY)
    table.rows(steady, 3 * SECOND + SECOND // 4)
    rows = {row["name"]: row for row in table.rows(steady, 4 * SECOND)}
    assert (rows["base"]["age"], rows["base"]["delay"]) == (1.0, 0.25)
    departed = table.rows(steady, 4 * SECOND, ["base"])
    assert [row["name"] for row in departed if row["departed"]] == ["base"]


def test_a_single_sample_has_no_rate():
    steady = Buffer()
    steady.set_transform("map", "base", SECOND, (1, 2, 0), IDENTITY)
    assert TreeTable().rows(steady, 2 * SECOND)[0]["rate"] is None


def test_a_relation_has_numbers_and_a_sentence(steady):
    found = relation(steady, "map", "laser", None)
    assert found["translation"] == [1.0, 2.0, 1.0]
    assert found["matrix"][0] == [1.0, 0.0, 0.0, 1.0]
    assert found["rpy"] == [0.0, 0.0, 0.0]
    assert found["sentence"].startswith(
        "laser is 1.00 m ahead, 2.00 m to the left and 1.00 m above"
    )


def test_a_relation_that_is_not_there_says_why(steady):
    steady.set_transform("island", "palm", SECOND, (0, 0, 0), IDENTITY)
    apart = relation(steady, "map", "palm", None)
    assert "not part of the same tree" in apart["error"]
    assert apart["hint"]
    unknown = relation(steady, "map", "lasre", None)
    assert unknown["error"] == "There is no frame 'lasre'."
    assert "laser" in unknown["hint"]
    early = relation(steady, "map", "base", SECOND // 2)
    assert "extrapolation into the past" in early["error"]


def test_a_link_that_ended_is_named():
    steady = Buffer(2 * SECOND)
    steady.set_transform("map", "stopped", SECOND, (1, 0, 0), IDENTITY, sender="/old_node")
    for second in range(1, 31):
        steady.set_transform("map", "base", second * SECOND, (0, 0, 0), IDENTITY)
    found = relation(steady, "base", "stopped", None)
    assert "extrapolation into the past" in found["error"]
    assert found["hint"] == (
        "The last transform of 'stopped' is 29 s older than the last transform of 'base', of which "
        "3 s are kept. Does /old_node still publish 'stopped'?"
    )


def test_at_a_stamp_the_last_known_place_counts(steady):
    assert relation(steady, "map", "base", 16 * SECOND)["translation"] == [1.0, 2.0, 0.0]
    assert "extrapolation into the future" in relation(steady, "map", "base", 18 * SECOND)["error"]


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
