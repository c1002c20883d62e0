"""All frames in one frame: what the page is told to draw."""

from __future__ import annotations

import numpy as np
import pytest

from turtlewire import Buffer
from turtlewire_view.frames import FrameScene

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
