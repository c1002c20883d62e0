"""Corrections of Sphinx's and Furo's pages, and tables that name their columns."""

from __future__ import annotations

import importlib.util
import itertools
import re
import struct

import pytest
from tests.places import ROOT, SITE


@pytest.fixture(scope="module")
def pages():
    spec = importlib.util.spec_from_file_location("accessible_pages", SITE / "accessible_pages.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_captions_of_the_sidebar_are_no_headings(pages):
    tree = '<p class="caption" role="heading"><span>Start</span></p><ul></ul>'
    assert pages.without_headings(tree) == '<p class="caption"><span>Start</span></p><ul></ul>'


def test_only_the_list_of_a_signature_is_hidden(pages):
    body = '<dl class="py"><span class="sig-paren">(</span>\n<dl>\n<dd>x</dd></dl></dl><dl></dl>'
    assert pages.without_empty_terms(body) == (
        '<dl class="py"><span class="sig-paren">(</span><dl role="presentation">\n'
        "<dd>x</dd></dl></dl><dl></dl>"
    )


def test_images_get_their_sizes(pages, tmp_path):
    png, svg = tmp_path / "a.png", tmp_path / "b.svg"
    png.write_bytes(b"\x89PNG\r\n\x1a\n" + struct.pack(">I4sII", 13, b"IHDR", 300, 200))
    svg.write_text('<svg xmlns="http://www.w3.org/2000/svg" width="331" height="338">')
    files = {"a.png": png, "b.svg": svg}
    body = '<img alt="A" src="../_images/a.png" /><img src="_images/b.svg" /><img src="c.png" />'
    assert pages.with_sizes(body, files) == (
        '<img alt="A" src="../_images/a.png" width="300" height="200" />'
        '<img src="_images/b.svg" width="331" height="338" /><img src="c.png" />'
    )


def test_an_image_without_a_size_is_an_error(pages, tmp_path):
    (tmp_path / "a.svg").write_text("<svg>")
    with pytest.raises(ValueError, match=r"a\.svg is neither a PNG nor an SVG"):
        pages.size_of(tmp_path / "a.svg")


def test_each_column_of_a_table_has_a_name():
    nameless, tables = [], 0
    for path in sorted((ROOT / "docs").rglob("*.md")):
        lines = path.read_text(encoding="utf-8").splitlines()
        for head, rule in itertools.pairwise(lines):
            if re.fullmatch(r"\|[\s:|-]+\|", rule) and head.startswith("|"):
                tables += 1
                if "" in [cell.strip() for cell in head[1:-1].split("|")]:
                    nameless.append(f"{path.name}: {head}")
    assert tables > 20
    assert nameless == []
