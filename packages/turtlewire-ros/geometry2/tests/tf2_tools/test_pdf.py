"""The PDF by its structure, and by poppler's reading of it where that is installed."""

import re
import shutil
import subprocess
import zlib

import pytest

from tf2_tools.pdf import pdf_from_drawing
from turtlewire.tf.drawing import Drawing, FilledBox, Line, Text

DRAWING = Drawing(
    300.0,
    200.0,
    (
        FilledBox(10, 20, 30, 40, "#ff0000"),
        Line(((0, 0), (100, 0), (100, 50)), "#00ff00", 2.0, dashed=True),
        Text(10, 100, "naïve (…) \\ 猫", 12, "#0000ff", bold=True),
        Text(10, 150, "plain", 9, "#000000"),
    ),
)


def objects(data):
    """Bodies of the objects, found by way of the cross-reference table as a reader does."""
    start = int(re.search(rb"startxref\n(\d+)\n%%EOF\n$", data).group(1))
    table = data[start:]
    count = int(re.match(rb"xref\n0 (\d+)\n", table).group(1))
    entries = re.findall(rb"(\d{10}) (\d{5}) ([nf]) \n", table)
    assert len(entries) == count
    assert entries[0] == (b"0000000000", b"65535", b"f")
    assert re.search(rb"trailer\n<< /Size (\d+) /Root 1 0 R >>", table).group(1) == b"%d" % count
    found = {}
    for number, (offset, _, _) in enumerate(entries[1:], 1):
        body = data[int(offset) :]
        assert body.startswith(b"%d 0 obj\n" % number)
        found[number] = body[: body.index(b"\nendobj")].split(b"obj\n", 1)[1]
    return found


def content(data):
    stream = objects(data)[4]
    length = int(re.search(rb"/Length (\d+)", stream).group(1))
    body = stream.split(b"stream\n", 1)[1]
    assert body[length:] == b"\nendstream"
    return zlib.decompress(body[:length]).decode("ascii")


def test_the_file_is_what_a_reader_expects():
    data = pdf_from_drawing(DRAWING)
    assert data.startswith(b"%PDF-1.4\n")
    found = objects(data)
    assert found[1] == b"<< /Type /Catalog /Pages 2 0 R >>"
    assert b"/MediaBox [0 0 300.00 200.00]" in found[3]
    assert b"/BaseFont /Helvetica-Bold" in found[6]


def test_shapes_stand_where_they_should_with_y_upwards():
    lines = content(pdf_from_drawing(DRAWING)).splitlines()
    assert lines[1] == "1 1 1 rg 1.000 0.000 0.000 RG 1 w 10.00 140.00 30.00 40.00 re B"
    assert (
        lines[2]
        == "0.000 1.000 0.000 RG 2 w [5 3] 0 d 0.00 200.00 m 100.00 200.00 l 100.00 150.00 l S "
        "[] 0 d"
    )
    assert lines[4].startswith("BT 0.000 0.000 0.000 rg /F1 9 Tf 10.00 50.00 Td <")


def test_letters_that_the_fonts_lack_are_escaped():
    (shown,) = re.findall(r"/F2 .*<([0-9a-f]+)> Tj", content(pdf_from_drawing(DRAWING)))
    assert bytes.fromhex(shown).decode("cp1252") == "naïve (…) \\ \\u732b"


def test_pages_larger_than_pdf_allows_are_scaled():
    data = pdf_from_drawing(Drawing(28_800.0, 100.0, (Text(1, 2, "x", 9, "#000000"),)))
    assert b"/MediaBox [0 0 14400.00 50.00]" in objects(data)[3]
    assert content(data).startswith("0.500000 0 0 0.500000 0 0 cm\n")


@pytest.mark.skipif(
    shutil.which("pdftotext") is None, reason="needs pdftotext (Debian: apt install poppler-utils)"
)
def test_poppler_reads_it(tmp_path):
    (tmp_path / "x.pdf").write_bytes(pdf_from_drawing(DRAWING))
    run = subprocess.run(
        ["pdftotext", "x.pdf", "-"], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    assert run.stderr == ""
    assert run.stdout.split() == ["naïve", "(…)", "\\", "\\u732b", "plain"]
