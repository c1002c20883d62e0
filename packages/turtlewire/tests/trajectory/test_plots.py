"""Plots are whole SVG documents, show what they are given, and draw nothing across gaps."""

import re
import shutil
import struct
import subprocess
import sys
import zlib
from xml.etree import ElementTree as ET

import numpy as np
import pytest

from turtlewire.cli.main import main
from turtlewire.trajectory import Gap, Plot, Trajectory, compare, plot
from turtlewire.trajectory.chart import GREY
from turtlewire.trajectory.pictures import pdf_of

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
    ("kind", "rows"), [("path", 1), ("positions", 3), ("angles", 3), ("speeds", 1)]
)
def test_lines_end_at_gaps(kind, rows):
    whole = random_walk(1)
    assert [len(line) for line in lines(whole.plot(kind))] == [300] * rows
    assert [len(line) for line in lines(with_gap(whole).plot(kind))] == [100, 100] * rows


def without(trajectory, first, last):
    """The trajectory without some poses, and without a word about it."""
    return trajectory[np.r_[0:first, last : len(trajectory)]]


@pytest.mark.parametrize("last", [104, 200])
@pytest.mark.parametrize("of", ["reference", "estimate", "both", "neither"])
def test_plots_of_errors_end_at_the_gaps_of_either_trajectory(of, last):
    reference = random_walk(1)
    estimate = Trajectory(reference.stamps_ns, reference.poses + np.eye(7)[0] * 0.1)
    first = 100
    if of in ("reference", "both"):
        reference = with_gap(reference, first, last)
    if of in ("estimate", "both"):
        estimate = with_gap(estimate, first, last)
    found = compare(reference, estimate)
    gaps = int(of != "neither")
    assert len(found.reference.gaps) == gaps
    assert found.reference.gaps == found.estimate.gaps
    rows = [100, 200 - (last - 100)] if gaps else [300]
    assert [len(line) for line in lines(found.plot("errors"), GREY)] == rows
    drawn = found.plot()
    assert [len(line) for line in lines(drawn, GREY)] == rows
    steps = re.findall(r'points="([^"]*)"[^>]* stroke-width="3"', drawn.svg)
    assert sum(len(points.split()) - 1 for points in steps) == sum(rows) - len(rows)


def test_missing_partners_are_a_gap():
    reference = random_walk(1)
    late = disturbed(without(reference, 100, 150), 2)
    found = compare(reference, late)
    (gap,) = found.estimate.gaps
    assert gap == (late.stamps_ns[99], late.stamps_ns[100])
    assert [len(line) for line in lines(found.plot("errors"), GREY)] == [100, 150]


def test_a_relative_error_is_drawn_where_its_pair_ends():
    from turtlewire.trajectory.error_plots import plot_errors

    found = compare(with_gap(random_walk(1)), random_walk(1))
    errors = found.rpe(delta=10)
    (before, after) = lines(plot_errors(errors, found.reference), GREY)
    assert (len(before), len(after)) == (9, 10)


def test_no_speed_is_made_of_a_gap():
    still = random_walk(1)
    poses = np.tile(still.poses[:1], (300, 1))
    poses[200:, 0] += 1000.0  # while nobody looked
    (first, second) = lines(with_gap(Trajectory(still.stamps_ns, poses)).plot("speeds"))
    assert len({point.split(",")[1] for point in first + second}) == 1


@pytest.mark.parametrize("kind", ["speeds", "angles"])
def test_rounding_errors_of_a_constant_are_not_magnified(kind):
    stamps = 1_700_000_000_000_000_000 + np.arange(50) * 100_000_000
    poses = np.zeros((50, 7))
    poses[:, 0], poses[:, 6] = 0.15033 * np.arange(50), 1.0
    poses[::2, 3] = 1e-17
    svg = Trajectory(stamps, poses).plot(kind).svg
    assert max(len(text) for text in re.findall(r">(-?\d[\d.]*)</text>", svg)) <= 4


def test_names_and_reference_are_in_the_legend():
    walk = random_walk(1)
    drawn = plot({"<slam>": walk, "b\x1b[31m": walk}, reference=walk)
    assert {"reference", "<slam>", "x [m]", "y [m]"} < set(texts(drawn))
    assert "\x1b" not in drawn.svg
    assert "stroke-dasharray" in drawn.svg


def test_a_metre_is_as_long_on_both_axes():
    poses = np.zeros((5, 7))
    poses[:, 6] = 1
    poses[:, :2] = [(0, 0), (10, 0), (10, 2), (0, 2), (0, 0)]
    (square,) = lines(Trajectory(np.arange(5), poses).plot())
    corners = np.array([point.split(",") for point in square], dtype=float)
    assert np.ptp(corners[:, 0]) == pytest.approx(5 * np.ptp(corners[:, 1]), abs=0.5)


def test_errors_of_a_comparison():
    reference = random_walk(1)
    comparison = compare(reference, disturbed(reference, 2), "se3")
    errors = comparison.ape()
    said = texts(comparison.plot("errors"))
    assert f"rmse {errors.statistics.rmse:.4g}" in said
    assert "time [s]" in said
    colours = set(re.findall(r'stroke="(#\w{6})" stroke-width="3"', comparison.plot().svg))
    assert len(colours) > 10
    assert comparison._repr_html_().startswith("<pre>APE trans_part")
    several = {"a": errors, "b": comparison.ape("full")}
    assert {"a", "b"} <= set(texts(plot(several, "box")))
    assert {"a", "b", "poses"} <= set(texts(plot(several, "histogram")))


def test_saving(tmp_path):
    drawn = random_walk(1).plot()
    assert isinstance(drawn, Plot)
    drawn.save(tmp_path / "path.svg")
    assert (tmp_path / "path.svg").read_text().startswith("<svg")
    with pytest.raises(ValueError, match=r"does not end in \.svg, \.pdf or \.png"):
        drawn.save(tmp_path / "path.jpg")
    assert not (tmp_path / "path.jpg").exists()


def test_undrawable_plots_raise():
    walk = random_walk(1)
    with pytest.raises(ValueError, match="'xx' is not a plane"):
        walk.plot(plane="xx")
    with pytest.raises(ValueError, match="'paths' is not a kind of plot; choose from path"):
        walk.plot("paths")
    with pytest.raises(ValueError, match="no pose"):
        walk[:0].plot()
    with pytest.raises(ValueError, match=r"'bar' is not a kind of plot; choose from .*histogram"):
        plot({"a": walk}, "bar")
    with pytest.raises(TypeError, match=r"'box' draws errors by name; .* with Trajectory"):
        plot({"a": walk}, "box")
    with pytest.raises(TypeError, match=r"'path' draws trajectories by name; .* with PoseErrors"):
        plot({"a": compare(walk, walk).ape()}, "path")
    with pytest.raises(TypeError, match="a reference is drawn next to trajectories, not"):
        plot({"a": compare(walk, walk).ape()}, "box", reference=walk)
    with pytest.raises(TypeError, match=r"draws a dict .* by name, not list: plot\(\{'estimate'"):
        plot([walk])
    with pytest.raises(ValueError, match="'box' is not a kind of plot; choose from path, errors"):
        compare(walk, walk).plot("box")
    assert walk[:0]._repr_svg_() is None


@pytest.mark.parametrize("count", [1, 2])
def test_few_poses_and_long_paths(count):
    walk = random_walk(1)[:count]
    for kind in ("path", "positions", "angles", "speeds"):
        ET.fromstring(walk.plot(kind).svg)
    (line,) = lines(random_walk(1, 100_000).plot())
    assert 4000 <= len(line) <= 4100


# Plots as PDF and PNG show what their SVG shows; PNG needs a package, which the error names.


def every_picture():
    """Yield one chart of each kind, which together use all elements of charts."""
    truth = random_walk(1)
    estimate = disturbed(truth, 2)
    comparison = compare(truth, estimate, "se3")
    errors = comparison.ape()
    yield plot({"ä (1)": estimate}, reference=truth)
    yield from (truth.plot(kind) for kind in ("path", "positions", "angles", "speeds"))
    yield comparison.plot("errors")
    yield plot({"a": errors}, "histogram")
    yield plot({"a": errors, "b": errors}, "box")
    yield compare(truth, estimate, "se3").plot()


def content(pdf):
    stream = re.search(rb"stream\n(.*)\nendstream", pdf, re.DOTALL)
    return zlib.decompress(stream.group(1)).decode("ascii")


def test_a_pdf_has_all_texts_and_lines_of_the_svg():
    for picture in every_picture():
        drawn = content(pdf_of(picture.svg))
        shown = [
            bytes.fromhex(each).decode("cp1252") for each in re.findall("<([0-9a-f]*)>", drawn)
        ]
        assert shown == [
            text.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&")
            for text in re.findall(r"<text[^>]*>([^<]*)</text>", picture.svg)
        ]
        assert len(re.findall(r" S\b", drawn)) >= picture.svg.count("<polyline")
        assert drawn.count(" B\n") == picture.svg.count("<circle")


def test_y_is_turned_over():
    svg = (
        '<svg xmlns="http://www.w3.org/2000/svg" width="100" height="50">'
        '<line x1="1" y1="2" x2="3" y2="4" stroke="#ff0000" stroke-width="2"/>'
        '<text x="10" y="20" font-size="10" fill="#000000" text-anchor="end">ii</text></svg>'
    )
    lines = content(pdf_of(svg)).splitlines()
    assert lines[1] == "1.000 0.000 0.000 RG 2 w 1.00 48.00 m 3.00 46.00 l S"
    assert " 5.56 30.00 Td <6969> Tj" in lines[2]  # 2.22 points a letter


@pytest.mark.skipif(shutil.which("pdftotext") is None, reason="apt install poppler-utils")
def test_poppler_reads_it(tmp_path):
    random_walk(1).plot("speeds").save(tmp_path / "x.pdf")
    command = ["pdftotext", "x.pdf", "-"]
    read = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert read.stderr == ""
    assert "m/s" in read.stdout


def pixels_of(path):
    """The pixels of a PNG without filters, (height, width, 3)."""
    data = path.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    width, height = struct.unpack(">II", data[16:24])
    at = data.index(b"IDAT")
    (length,) = struct.unpack(">I", data[at - 4 : at])
    rows = np.frombuffer(zlib.decompress(data[at + 4 : at + 4 + length]), np.uint8)
    return rows.reshape(height, 1 + 3 * width)[:, 1:].reshape(height, width, 3)


def test_a_png_has_the_colours_in_their_places(tmp_path):
    pytest.importorskip("pypdfium2", reason="pip install pypdfium2")
    plot = random_walk(1).plot()
    plot.save(tmp_path / "x.png")
    pixels = pixels_of(tmp_path / "x.png")
    width, height = (
        int(number) for number in re.findall(r'(?:width|height)="(\d+)"', plot.svg)[:2]
    )
    assert pixels.shape == (3 * height, 3 * width, 3)
    assert pixels[0, 0].tolist() == [255, 255, 255]
    first = re.search(r'<polyline points="([\d.]+),([\d.]+) ([\d.]+),([\d.]+)', plot.svg).groups()
    x, y = (3 * float(first[k]) for k in (2, 3))
    near = pixels[int(y) - 6 : int(y) + 7, int(x) - 6 : int(x) + 7].reshape(-1, 3).tolist()
    assert any(abs(r - 0x00) + abs(g - 0x72) + abs(b - 0xB2) < 30 for r, g, b in near)


def test_without_the_package_one_line_names_it(tmp_path, monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "pypdfium2", None)
    file = tmp_path / "walk.tum"
    random_walk(1).save(file)
    with pytest.raises(ModuleNotFoundError, match=r"pip install 'turtlewire\[png\]'"):
        random_walk(1).plot().save(tmp_path / "x.png")
    assert main(["trajectory", str(file), "--plot", str(tmp_path / "x.png")]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("turtlewire trajectory: PNG needs the package pypdfium2: pip install")
    assert not (tmp_path / "x.png").exists()
    assert main(["trajectory", str(file), "--plot", str(tmp_path / "x.pdf")]) == 0
    assert (tmp_path / "x.pdf").read_bytes().startswith(b"%PDF")
