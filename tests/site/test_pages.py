"""The pages that only the site has: their commands run, their texts are those of the sources.

The texts that the sources print, for the page that lists errors by their texts.
"""

from __future__ import annotations

import ast
import doctest
import re
from functools import cache
from pathlib import Path

import pytest
from tests.how_to import blocks_of
from tests.places import PACKAGES, PATH, ROOT, SITE, modules_of_tests

import tf2_ros
import turtlewire
from turtlewire.cli.main import main
from turtlewire_ros.executables import executable_paths
from turtlewire_ros.prefix import share_directory

PLACEHOLDER = re.compile(r"\{[^{}]*\}|%[sd]")


@cache
def sources() -> dict[str, list[str]]:
    """The texts of each Python file; `…` stands for what is filled in."""
    return {
        str(path): _texts_of(ast.parse(path.read_text(encoding="utf-8")))
        for folder in PACKAGES
        for path in folder.rglob("*.py")
    }


def _texts_of(tree: ast.AST) -> list[str]:
    found = []
    for node in ast.walk(tree):
        if isinstance(node, ast.JoinedStr):
            parts = [part.value if isinstance(part, ast.Constant) else "…" for part in node.values]
            found.append("".join(map(str, parts)))
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            found.append(PLACEHOLDER.sub("…", node.value))
    return found


def is_printed(text: str) -> bool:
    """Whether one source file has all parts of a text in its own texts."""
    parts = [part.strip(" \n") for part in text.split("…") if len(part.strip(" '\"[]:.,\n")) > 1]
    assert parts, text
    return any(
        all(any(part in own for own in texts) for part in parts) for texts in sources().values()
    )


DOCS = ROOT / "docs"
PAGES = sorted(DOCS.rglob("*.md"))
TROUBLE = (DOCS / "troubleshooting.md").read_text(encoding="utf-8")
HEADINGS = re.findall(r"^### `(.+)`$", TROUBLE, re.MULTILINE)
HINTS = re.findall(r"^> Hint: (.+)$", TROUBLE, re.MULTILINE)
#: Packages of a real ROS 2 that pages name.
THEIRS = {"controller_manager", "my_turtle", "urdf_tutorial"}
#: A block, or code within a line.
CODE = re.compile(r"^```\w+\n(.*?)^```$|(`[^`\n]+`)", re.MULTILINE | re.DOTALL)
SECOND = 1_000_000_000


@pytest.mark.parametrize(("page", "examples"), [("index.md", 5), ("differences.md", 2)])
def test_the_examples(page, examples):
    failed, tried = doctest.testfile(str(DOCS / page), module_relative=False)
    assert (failed, tried) == (0, examples)


@pytest.mark.parametrize("page", ["install.md", "differences.md"])
def test_the_commands(page, run, monkeypatch):
    monkeypatch.setenv("PATH", PATH)
    text = (DOCS / page).read_text(encoding="utf-8")
    commands = [line for block in blocks_of(text, "sh") for line in block.splitlines()]
    assert len(commands) == 1
    for command in commands:
        program = run("bash", "-c", f"exec {command}")
        assert program.wait() in {0, 1}, program.text  # 1: the doctor found something
        assert "Traceback" not in program.text
        assert "domain" in program.text.lower() or "problem" in program.text.lower(), program.text


def buffer():
    """Two trees, a link with data from 1 s to 2 s, one with one sample."""
    made = tf2_ros.Buffer().engine  # its hints have the words of tf2_ros
    upright = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0)
    for stamp in (SECOND, 2 * SECOND):
        made.set_transform("world", "turtle1", stamp, *upright)
    made.set_transform("world", "once", SECOND, *upright)
    made.set_transform("elsewhere", "island", SECOND, *upright)
    return made


def failures():
    """Yield the errors of lookups and the messages about rejected transforms."""
    full, loop = buffer(), turtlewire.Buffer()
    upright = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0)
    loop.set_transform("a", "b", SECOND, *upright)
    loop.set_transform("b", "a", SECOND, *upright)
    for asked, target, source, stamp in [
        (turtlewire.Buffer(), "world", "turtle1", 0),
        (full, "world", "turtle", 0),
        (full, "world", "island", 0),
        (full, "world", "turtle1", 3 * SECOND),
        (full, "world", "turtle1", SECOND // 2),
        (full, "world", "once", 2 * SECOND),
        (full, "/world", "turtle1", 0),
        (full, "", "turtle1", 0),
        (loop, "a", "other", 0),
        (loop, "a", "b", 0),
    ]:
        try:
            asked.lookup_transform(target, source, stamp)
        except turtlewire.errors.TransformException as error:
            yield str(error)
            yield error.hint
    nan = (float("nan"), 0.0, 0.0), (0.0, 0.0, 0.0, 1.0)
    full.set_transform("world", "turtle1", 100 * SECOND, *upright)
    for parent, child, pose in [
        ("world", "world", upright),
        ("world", "bad", nan),
        ("world", "", upright),
        ("world", "turtle1", upright),  # old
    ]:
        try:
            full.set_transform(parent, child, SECOND, *pose)
        except turtlewire.errors.InvalidTransformError as error:
            yield str(error)
            yield error.hint


def is_raised(text):
    """Return True if one of the failures has this text; `…` matches anything."""
    pattern = ".+?".join(re.escape(part) for part in text.split("…"))
    return any(re.search(pattern, said, re.DOTALL) for said in failures())


@pytest.mark.parametrize("text", [*HEADINGS, *HINTS])
def test_each_error_of_the_page_exists(text):
    assert is_raised(text) or is_printed(text)


def test_the_page_has_the_errors_of_lookups():
    shown = [text for text in HEADINGS if is_raised(text)]
    assert len(shown) >= 10
    assert len(HEADINGS) >= 40
    assert len(HINTS) >= 8


#: Pages whose commands are run by tests that do not read the page, and which tests.
RUN_ELSEWHERE = {
    "lesson.md": "packages/turtlewire-class/tests/turtle_lesson/test_in_browser.py",
    "learning_tf2_py.md": "tests/tutorial/test_lessons.py",
    "packages.md": "packages/turtlewire-colcon/tests/test_colcon_ament.py",
    "performance.md": "tests/test_bench.py",
}


def test_each_page_with_commands_or_programs_is_tested():
    tests = "\n".join(path.read_text(encoding="utf-8") for path in modules_of_tests())
    without = {
        page.name
        for page in DOCS.rglob("*.md")
        if re.search(r"^```(sh|bash|console|python|pycon)$", page.read_text("utf-8"), re.MULTILINE)
        and not re.search(rf"\b{re.escape(page.name)}\b", tests)
    }
    assert without == set()
    assert all((ROOT / test).exists() for test in RUN_ELSEWHERE.values())


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(DOCS).as_posix())
def test_programs_named_on_a_page_exist(page):
    text = page.read_text(encoding="utf-8")
    for package, executable in re.findall(r"ros2 run (\w+) (\w+)", text):
        if package not in THEIRS:
            assert executable in {Path(path).name for path in executable_paths(package)}
    for package, file in re.findall(r"ros2 launch (\w+) ([\w.]+)", text):
        if package not in THEIRS:
            assert list(Path(share_directory(package)).rglob(file)), file
    for path in re.findall(r"\b((?:scripts|tools)/\w[\w-]*(?:\.py)?)", text):
        assert (ROOT / path).exists()
    code = "\n".join("".join(found) for found in CODE.findall(text))
    for verb in re.findall(r"(?:^|`)turtlewire ([a-z]+)\b", code, re.MULTILINE):
        with pytest.raises(SystemExit) as end:
            main([verb, "--help"])
        assert end.value.code == 0, verb


def test_the_commands_of_turtlesims_page(run, monkeypatch):
    """turtlesim.md, but for the ssh into a robot that is not there."""
    monkeypatch.setenv("PATH", PATH)
    monkeypatch.setenv("TURTLEWIRE_BROWSER", "0")
    monkeypatch.setenv("TURTLEWIRE_PORT", "0")
    text = (DOCS / "how-to" / "turtlesim.md").read_text(encoding="utf-8")
    blocks = blocks_of(text, "sh")
    simulator, parameter, mimic, lan, ssh = (block.replace("\\\n", "") for block in blocks)
    started = run("bash", "-c", f"exec {simulator}")
    started.wait_for(r"Spawning turtle \[turtle1\]")
    assert run("bash", "-c", f"exec {parameter}").wait() == 0
    run("bash", "-c", f"exec {mimic}")
    run("bash", "-c", f"exec {lan}").wait_for(r"http://\S+")
    assert ssh.startswith("ssh -L")


def test_each_reference_page_names_a_package_that_is_there():
    import importlib

    pages = list((DOCS / "reference").glob("*.rst"))
    modules = [m for page in pages for m in re.findall(r"automodule:: (\S+)", page.read_text())]
    assert len(modules) >= 30
    for module in modules:
        assert importlib.import_module(module).__doc__


def test_the_translation_is_of_the_page():
    """The translated texts of the front page still exist, word for word."""
    page = " ".join((DOCS / "index.md").read_text(encoding="utf-8").split())
    text = (SITE / "locale/de/LC_MESSAGES/index.po").read_text(encoding="utf-8")
    quoted = r'((?:"(?:[^"\\]|\\.)*"\s*)+)'
    originals = [
        "".join(re.findall(r'"((?:[^"\\]|\\.)*)"', original))
        for original, _ in re.findall(rf"msgid {quoted}msgstr {quoted}", text)
    ]
    assert len(originals) >= 9
    assert all(original in page for original in originals), originals
