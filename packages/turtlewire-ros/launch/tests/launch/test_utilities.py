"""Lists of substitutions, type checks, lines of output, and the place of an error."""

from __future__ import annotations

from pathlib import Path

import pytest

from launch import Action, LaunchContext
from launch.actions import LogInfo
from launch.output_lines import OutputLines
from launch.process_output import ProcessOutput
from launch.substitutions import LaunchConfiguration, TextSubstitution
from launch.utilities import (
    ensure_argument_type,
    is_a,
    is_a_subclass,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)
from launch.utilities.raised_in import raised_in


def test_text_paths_and_substitutions_become_one_list():
    substitution = LaunchConfiguration("x", default="3")
    parts = normalize_to_list_of_substitutions(["a", Path("b/c"), substitution])
    assert [type(part) for part in parts[:2]] == [TextSubstitution] * 2
    assert parts[2] is substitution
    assert perform_substitutions(LaunchContext(), parts) == "ab/c3"
    assert normalize_to_list_of_substitutions(substitution) == [substitution]
    assert normalize_to_list_of_substitutions([]) == []


@pytest.mark.parametrize(("value", "error"), [(3, "is neither text nor"), ([3], "given item of")])
def test_other_values_are_refused(value, error):
    with pytest.raises(TypeError, match=error):
        normalize_to_list_of_substitutions(value)


def test_type_checks():
    action = LogInfo(msg="x")
    assert is_a(action, Action)
    assert not is_a(LogInfo, Action)
    assert is_a_subclass(action, Action)
    assert is_a_subclass(LogInfo, Action)
    assert not is_a_subclass(str, Action)
    ensure_argument_type("x", (int, str), "x")
    with pytest.raises(
        TypeError,
        match=r"^Expected 'x' of Y to be of type 'int', but got 'a' of type '<class 'str'>'$",
    ):
        ensure_argument_type("a", int, "x", "Y")
    with pytest.raises(TypeError, match=r"to be of type one of \['int', 'float'\], but got"):
        ensure_argument_type("a", [int, float], "x")


def test_lines_are_complete_before_they_are_shown():
    lines = OutputLines()
    assert lines.feed(b"a") == []
    assert lines.feed(b"b\r\nc\n\nd") == ["ab", "c", ""]
    assert lines.rest() == ["d"]
    assert lines.rest() == []


def test_a_character_may_come_in_pieces():
    lines = OutputLines()
    encoded = "Größe\n".encode()
    assert lines.feed(encoded[:3]) == []
    assert lines.feed(encoded[3:]) == ["Größe"]


def test_output_is_kept_only_on_request():
    kept, dropped = ProcessOutput("log", cached=True), ProcessOutput("log", cached=False)
    for output in (kept, dropped):
        output.keep(1, b"out")
        output.keep(2, b"er")
        output.keep(2, b"r")
    assert (kept.kept(1), kept.kept(2)) == (b"out", b"err")
    assert (dropped.kept(1), dropped.kept(2)) == (b"", b"")


def test_the_environment_replaces_the_choice_of_outputs(monkeypatch):
    assert ProcessOutput({"stdout": "log"}, cached=False).destination == {"stdout": "log"}
    monkeypatch.setenv("OVERRIDE_LAUNCH_PROCESS_OUTPUT", "both")
    (chosen,) = ProcessOutput({"stdout": "log"}, cached=False).destination
    assert chosen.text == "both"


def test_an_error_from_no_launch_file_has_no_place():
    with pytest.raises(ValueError, match="seven") as caught:
        int("seven")
    assert raised_in(caught.value) == ""
