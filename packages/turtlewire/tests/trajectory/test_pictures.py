"""Plots as PDF and PNG show what their SVG shows; PNG needs a package, which the error names."""

from __future__ import annotations

import re
import shutil
import struct
import subprocess
import sys
import zlib

import numpy as np
import pytest

from turtlewire.cli.main import main
from turtlewire.trajectory import compare, plot
from turtlewire.trajectory.pictures import pdf_of

from .conftest import disturbed, random_walk


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
