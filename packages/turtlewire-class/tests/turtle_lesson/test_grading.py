"""The checks of a lesson: results, and the files that it starts with and is solved by."""

import difflib
import json

import pytest
from tests.places import LESSONS, ROOT

from turtle_lesson.grading import grade
from turtle_lesson.lesson import load_lesson, solved

ORDER = json.loads((LESSONS / "order.json").read_text(encoding="utf-8"))
VERBATIM = ROOT / "tests" / "tutorial" / "verbatim" / "learning_tf2_py" / "learning_tf2_py"


@pytest.mark.parametrize("file", ["turtle_tf2_broadcaster.py", "turtle_tf2_listener.py"])
def test_the_lessons_begin_with_the_files_of_the_document(file):
    printed = (VERBATIM / file).read_text(encoding="utf-8")
    for name in ORDER:
        assert load_lesson(LESSONS / name).starter().get(file, printed) == printed


def test_an_error_of_the_file_is_a_result_with_its_line():
    lesson = load_lesson(LESSONS / "listener")
    files = lesson.solution()
    broken = files["turtle_tf2_listener.py"].replace("msg = Twist()", "msg = Twist(")
    files["turtle_tf2_listener.py"] = broken
    (result,) = grade(lesson, files)
    assert (result.passed, result.file) == (False, "turtle_tf2_listener.py")
    assert broken.splitlines()[result.line - 1].strip() == "msg = Twist("
    assert result.text == "SyntaxError: '(' was never closed"


def test_it_gives_signs_of_life():
    lesson = load_lesson(LESSONS / "static")
    signs = []
    list(grade(lesson, lesson.solution(), lambda: signs.append(1)))
    assert len(signs) >= 10  # six simulated seconds of the last check, twice a second


# Solutions are made from the first files by a diff.


BEFORE = "a = 1\nb = 2\n\nc = 3\n"
AFTER = "a = 1\nb = 3\n\nc = 3\nd = 4\n"


def diff_of(name, before, after):
    lines = difflib.unified_diff(
        before.splitlines(),
        after.splitlines(),
        f"starter/{name}",
        f"solution/{name}",
        "",
        "",
        1,
        "",
    )
    return "".join(f"{line.rstrip()}\n" for line in lines)


def test_a_diff_with_several_hunks_and_files_is_applied():
    diff = diff_of("one.py", BEFORE, AFTER) + diff_of("two.py", AFTER, BEFORE)
    assert diff.count("@@ ") >= 2
    files = {"one.py": BEFORE, "two.py": AFTER, "three.py": BEFORE}
    assert solved(files, diff) == {"one.py": AFTER, "two.py": BEFORE, "three.py": BEFORE}


@pytest.mark.parametrize("starter", ["a = 1\n", BEFORE * 2], ids=["missing", "twice"])
def test_old_lines_that_are_not_there_once_are_an_error(starter):
    with pytest.raises(ValueError, match=r"one.py has [02] of these lines, expected 1:\na = 1\n"):
        solved({"one.py": starter}, diff_of("one.py", BEFORE, AFTER))


def test_a_lesson_without_own_files_starts_with_the_tutorials():
    lesson = load_lesson(LESSONS / "listener")
    printed = {
        name: (LESSONS / "tutorial" / name).read_text(encoding="utf-8") for name in lesson.files
    }
    assert lesson.starter() == printed
    changed = [name for name, text in lesson.solution().items() if text != printed[name]]
    assert changed == ["turtle_tf2_listener.py"]
