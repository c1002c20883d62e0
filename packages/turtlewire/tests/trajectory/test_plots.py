"""Plots are whole SVG documents, show what they are given, and draw nothing across gaps."""

from __future__ import annotations

import re
from xml.etree import ElementTree as ET

import numpy as np
import pytest

from turtlewire.trajectory import (
    Gap,
    Plot,
    Trajectory,
    compare,
    plot_angles,
    plot_box,
    plot_errors,
    plot_histogram,
    plot_path,
    plot_positions,
    plot_speeds,
)

from .conftest import disturbed, random_walk


def with_gap(trajectory, first=100, last=200):
    rows = np.r_[0:first, last : len(trajectory)]
    gap = Gap(int(trajectory.stamps_ns[first - 1]), int(trajectory.stamps_ns[last]))
    return Trajectory(trajectory.stamps_ns[rows], trajectory.poses[rows], "map", "robot", (gap,))


def lines(plot, colour="#0072b2"):
    root = ET.fromstring(plot.svg)
    found = root.iter("{http://www.w3.org/2000/svg}polyline")
    return [line.get("points").split() for line in found if line.get("stroke") == colour]


def texts(plot):
    return [each.text for each in ET.fromstring(plot.svg).iter("{http://www.w3.org/2000/svg}text")]


@pytest.mark.parametrize(
    ("draw", "rows"), [(plot_path, 1), (plot_positions, 3), (plot_angles, 3), (plot_speeds, 1)]
)
def test_lines_end_at_gaps(draw, rows):
    whole = random_walk(1)
    assert [len(line) for line in lines(draw(whole))] == [300] * rows
    assert [len(line) for line in lines(draw(with_gap(whole)))] == [100, 100] * rows


def test_no_speed_is_made_of_a_gap():
    still = random_walk(1)
    poses = np.tile(still.poses[:1], (300, 1))
    poses[200:, 0] += 1000.0  # while nobody looked
    (first, second) = lines(plot_speeds(with_gap(Trajectory(still.stamps_ns, poses))))
    assert len({point.split(",")[1] for point in first + second}) == 1


def test_names_and_reference_are_in_the_legend():
    walk = random_walk(1)
    plot = plot_path({"<slam>": walk, "b\x1b[31m": walk}, reference=walk)
    assert {"reference", "<slam>", "x [m]", "y [m]"} < set(texts(plot))
    assert "\x1b" not in plot.svg
    assert "stroke-dasharray" in plot.svg


def test_a_metre_is_as_long_on_both_axes():
    poses = np.zeros((5, 7))
    poses[:, 6] = 1
    poses[:, :2] = [(0, 0), (10, 0), (10, 2), (0, 2), (0, 0)]
    (square,) = lines(plot_path(Trajectory(np.arange(5), poses)))
    corners = np.array([point.split(",") for point in square], dtype=float)
    assert np.ptp(corners[:, 0]) == pytest.approx(5 * np.ptp(corners[:, 1]), abs=0.5)


def test_errors_of_a_comparison():
    reference = random_walk(1)
    comparison = compare(reference, disturbed(reference, 2), "se3")
    errors = comparison.ape()
    said = texts(plot_errors(errors, comparison.reference.stamps_ns))
    assert f"rmse {errors.statistics.rmse:.4g}" in said
    assert "time [s]" in said
    colours = set(re.findall(r'stroke="(#\w{6})" stroke-width="3"', comparison.plot().svg))
    assert len(colours) > 10
    assert comparison._repr_html_().startswith("<pre>APE trans_part")
    several = {"a": errors, "b": comparison.ape("full")}
    assert {"a", "b"} <= set(texts(plot_box(several)))
    assert {"a", "b", "poses"} <= set(texts(plot_histogram(several)))


def test_saving(tmp_path):
    plot = random_walk(1).plot()
    assert isinstance(plot, Plot)
    plot.save(tmp_path / "path.svg")
    assert (tmp_path / "path.svg").read_text().startswith("<svg")
    with pytest.raises(ValueError, match=r"does not end in \.svg, \.pdf or \.png"):
        plot.save(tmp_path / "path.jpg")
    assert not (tmp_path / "path.jpg").exists()


def test_undrawable_plots_raise():
    walk = random_walk(1)
    with pytest.raises(ValueError, match="'xx' is not a plane"):
        plot_path(walk, plane="xx")
    with pytest.raises(ValueError, match="'paths' is not a kind of plot; choose from path"):
        walk.plot("paths")
    with pytest.raises(ValueError, match="no pose"):
        plot_path(walk[:0])
    assert walk[:0]._repr_svg_() is None


@pytest.mark.parametrize("count", [1, 2])
def test_few_poses_and_long_paths(count):
    walk = random_walk(1)[:count]
    for kind in ("path", "positions", "angles", "speeds"):
        ET.fromstring(walk.plot(kind).svg)
    (line,) = lines(random_walk(1, 100_000).plot())
    assert 4000 <= len(line) <= 4100
