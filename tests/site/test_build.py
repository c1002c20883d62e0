"""`scripts/docs`: its check of the built pages, and folders that it does not replace."""

import importlib.util
import itertools
import re
import struct
import subprocess
import sys

import docs
import lesson
import pytest
from tests.places import ROOT, SITE, TOOLS

GOOD = '<h1 id="top">A</h1><a href="sub/b.html#there">b</a><a href="https://example.org">out</a>'


def faults_of(folder):
    return list(docs.faults_of(folder, apart={"lesson"}))


@pytest.fixture
def folder(tmp_path):
    """Two pages that know each other, and one that is not checked."""
    for name in ("sub", "lesson"):
        (tmp_path / name).mkdir()
    (tmp_path / "a.html").write_text(GOOD)
    (tmp_path / "sub" / "b.html").write_text('<p id="there"></p><a href="../a.html#top">a</a>')
    (tmp_path / "lesson" / "index.html").write_text('<a href="nowhere.html">x</a>')
    return tmp_path


def test_good_pages_have_no_faults(folder):
    assert faults_of(folder) == []


@pytest.mark.parametrize(
    ("added", "fault"),
    [
        ('<a href="c.html">c</a>', "a.html: c.html leads nowhere"),
        ('<a href="sub/b.html#here">b</a>', "a.html: sub/b.html#here does not exist on that page"),
        ('<a href="#nothing">b</a>', "a.html: #nothing does not exist on that page"),
        ('<img src="c.png">', "a.html: c.png leads nowhere"),
        (
            '<script src="https://cdn.example/x.js"></script>',
            "a.html: loads https://cdn.example/x.js from elsewhere",
        ),
        (
            '<link rel="stylesheet" href="//fonts.example/f.css">',
            "a.html: loads //fonts.example/f.css from elsewhere",
        ),
        (
            '<p style="background: url(https://x.example/p.png)">',
            "a.html: loads https://x.example/p.png from elsewhere",
        ),
    ],
)
def test_faults_are_found(folder, added, fault):
    (folder / "a.html").write_text(GOOD + added)
    assert faults_of(folder) == [fault]


def test_style_sheets_load_nothing_from_elsewhere(folder):
    (folder / "s.css").write_text("@import 'https://fonts.example/f.css';")
    assert faults_of(folder) == ["s.css: loads https://fonts.example/f.css from elsewhere"]


def test_the_base_is_where_links_start(folder):
    text = '<base href="/some/where/"><a href="sub/b.html">b</a><a href="b.html">b</a>'
    (folder / "sub" / "c.html").write_text(text)
    assert faults_of(folder) == ["sub/c.html: b.html leads nowhere"]


@pytest.mark.parametrize("name", ["mine", "mine/notes.txt"])
@pytest.mark.parametrize(
    ("tool", "told"),
    [(docs, "is not a site that this script built"), (lesson, "holds no built lesson")],
)
def test_a_folder_of_something_else_is_not_replaced(tmp_path, tool, told, name):
    file = tmp_path / name
    file.parent.mkdir(exist_ok=True)
    file.write_text("mine")
    with pytest.raises(lesson.BuildError, match=told):
        tool.build(tmp_path / "mine")
    assert file.read_text() == "mine"


def test_versions_are_pinned():
    lines = (SITE / "requirements.txt").read_text(encoding="utf-8").splitlines()
    wanted = (SITE / "requirements.in").read_text(encoding="utf-8").splitlines()
    assert all(re.fullmatch(r"[\w.-]+==[\w.]+", line) for line in lines)
    pinned = {line.partition("==")[0].lower() for line in lines}
    assert {name for name in wanted if not name.startswith("#")} <= pinned


def test_help_names_the_options():
    script = TOOLS / "docs.py"
    done = subprocess.run(
        [sys.executable, str(script), "--help"], capture_output=True, text=True, check=True
    )
    assert all(option in done.stdout for option in ("--serve", "--gettext", "--base", "--language"))


# Corrections of Sphinx's and Furo's pages, and tables that name their columns.


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
