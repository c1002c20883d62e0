"""The checks of all exercises: solutions pass, first files and typical mistakes do not."""

import re

import pytest

from turtle_class import ClassError
from turtle_class.catalogue import chosen, exercises
from turtle_lesson.grading import grade
from turtle_lesson.lesson import load_lesson
from turtlewire.cli.main import main

from ..turtle_lesson.wrong_answers import WRONG_ANSWERS

#: Checking an exercise takes seconds; this one is enough for the fast tests.
QUICK = "static"


def of_exercises(values):
    """Name values by their exercise; most are for the slow tests."""
    return [
        pytest.param(value, id=name, marks=() if name.split("-")[0] == QUICK else pytest.mark.slow)
        for name, value in values.items()
    ]


EXERCISES = {exercise.name: exercise for exercise in exercises()}
MISTAKES = {f"{wrong.exercise}-{wrong.name}": wrong for wrong in WRONG_ANSWERS}


@pytest.mark.parametrize("exercise", of_exercises(EXERCISES))
def test_the_solution_passes_and_the_first_files_do_not(exercise):
    lesson = load_lesson(exercise.folder)
    results = list(grade(lesson, lesson.solution()))
    assert len(results) >= 3
    assert all(result.passed for result in results), results
    last = list(grade(lesson, lesson.starter()))[-1]
    assert not last.passed
    assert last.text
    assert last.hint


@pytest.mark.parametrize("wrong", of_exercises(MISTAKES))
def test_a_typical_mistake_gets_its_hint(wrong):
    (exercise,) = chosen([wrong.exercise])
    lesson = load_lesson(exercise.folder)
    last = list(grade(lesson, wrong.files(lesson)))[-1]
    assert not last.passed
    assert re.search(wrong.hint, last.hint), last


def test_there_are_eight_exercises_with_three_typical_mistakes_each():
    assert len(exercises()) >= 8
    for exercise in exercises():
        assert sum(wrong.exercise == exercise.name for wrong in WRONG_ANSWERS) >= 3, exercise.name


def test_a_text_is_readable_as_plain_text():
    (exercise,) = chosen(["camera"])
    text = exercise.plain_text()
    assert text.startswith("# 8 · A camera that points down\n")
    assert "**Task.** Attach a static frame `camera` to turtle1" in text
    assert "<" not in text


@pytest.mark.parametrize("exercise", of_exercises(EXERCISES))
def test_a_text_is_for_the_terminal(exercise, tmp_path, monkeypatch, capsys):
    """Texts said "Press Run" and "at the right", which are in the browser tab only."""
    assert main(["class", "start", str(tmp_path), "-e", exercise.name]) == 0
    folder = tmp_path / exercise.name
    text = (folder / "README.md").read_text()
    assert not re.search(r"\bPress\b|Surprise|at the right|pad\b|sentence below", text)
    assert f"tf2_echo {exercise.target} {exercise.source}\n" in text
    assert {word.removesuffix(",") for word in re.findall(r"`(\w+\.py)`", text)} >= set(
        exercise.files
    )
    (launch,) = re.findall(r"^ros2 launch (\S+)$", text, re.MULTILINE)
    assert (folder / launch).is_file()
    (check,) = re.findall(r"^turtlewire (class check .*)$", text, re.MULTILINE)
    monkeypatch.chdir(folder)
    capsys.readouterr()
    assert main(check.split()) == 1
    assert capsys.readouterr().out.startswith(f"{exercise.name}: ")


def test_the_browser_tab_hides_what_is_for_the_terminal():
    for exercise in exercises():
        for tag in re.findall(r"<[^>]*terminal[^>]*>", exercise.text()):
            assert tag.endswith(" hidden>"), exercise.name


def test_a_wrong_name_gets_a_suggestion():
    with pytest.raises(ClassError, match=r"no exercise 'camra'; choose from static.*mean: camera"):
        chosen(["camra"])
