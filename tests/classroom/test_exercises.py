"""The checks of the exercises that are no lessons: solutions pass, typical mistakes do not."""

from __future__ import annotations

import re

import pytest

from turtle_class.catalogue import chosen, exercises
from turtle_class.errors import ClassError
from turtle_lesson.grading import grade
from turtle_lesson.lesson import load_lesson

from .wrong_answers import WRONG_ANSWERS

OWN = [each for each in exercises() if each.folder.parent.name == "exercises"]


@pytest.mark.parametrize("exercise", OWN, ids=lambda exercise: exercise.name)
def test_the_solution_passes_and_the_first_files_do_not(exercise):
    lesson = load_lesson(exercise.folder)
    results = list(grade(lesson, lesson.sources("solution")))
    assert len(results) >= 3
    assert all(result.passed for result in results), results
    last = list(grade(lesson, lesson.sources("starter")))[-1]
    assert not last.passed
    assert last.text
    assert last.hint


@pytest.mark.parametrize("wrong", WRONG_ANSWERS, ids=lambda wrong: f"{wrong.exercise}-{wrong.name}")
def test_a_typical_mistake_gets_its_hint(wrong):
    (exercise,) = chosen([wrong.exercise])
    lesson = load_lesson(exercise.folder)
    last = list(grade(lesson, wrong.files(lesson)))[-1]
    assert not last.passed
    assert re.search(wrong.hint, last.hint), last


def test_there_are_eight_exercises_with_three_typical_mistakes_each():
    assert len(exercises()) >= 8
    for exercise in OWN:  # those of the lessons are counted beside their tests
        assert sum(wrong.exercise == exercise.name for wrong in WRONG_ANSWERS) >= 3, exercise.name


def test_a_text_is_readable_as_plain_text():
    (exercise,) = chosen(["camera"])
    text = exercise.plain_text()
    assert text.startswith("# 8 · A camera that looks down\n")
    assert "**Task.** Put a static frame `camera` on turtle1" in text
    assert "<" not in text


def test_a_wrong_name_gets_a_suggestion():
    with pytest.raises(ClassError, match=r"no exercise 'camra'; there are static, .*mean: camera"):
        chosen(["camra"])
