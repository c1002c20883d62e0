"""Values on the command line, and near names."""

import argparse
import sys

import pytest
import yaml

from ros2cli.suggestion import did_you_mean
from ros2cli.values import (
    assignment,
    positive_float,
    positive_int,
    read_values,
    regular_expression,
    shortened,
    unsigned_int,
)


def test_yaml_values():
    assert read_values("{x: 1.0, name: 'a'}") == {"x": 1.0, "name": "a"}
    assert read_values("") == {}
    with pytest.raises(
        RuntimeError, match=r"^The passed value needs to be a dictionary in YAML format$"
    ):
        read_values("hello")
    with pytest.raises(yaml.YAMLError):
        read_values("{x: 1")


@pytest.mark.parametrize(
    ("convert", "bad"),
    [(positive_float, "0"), (positive_float, "-1.5"), (positive_int, "0"), (unsigned_int, "-1")],
)
def test_numbers_out_of_range_are_refused(convert, bad):
    with pytest.raises(argparse.ArgumentTypeError):
        convert(bad)


def test_numbers():
    assert (positive_float("0.5"), positive_int("3"), unsigned_int("0")) == (0.5, 3, 0)
    with pytest.raises(ValueError, match="could not convert"):
        positive_float("abc")


def test_near_names_are_suggested():
    assert (
        did_you_mean("/turtel1/pose", ["/turtle1/pose", "/tf"]) == "\nDid you mean: /turtle1/pose"
    )
    assert did_you_mean("/zzz", ["/turtle1/pose"]) == ""


BOMB = "\n".join(
    ["a0: &a0 [lol, lol]", *(f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 9)}]" for i in range(1, 9))]
)


@pytest.mark.parametrize("text", [BOMB, "{data: &a [*a]}"])
def test_aliases_that_stand_for_too_much_are_refused(text):
    with pytest.raises(RuntimeError, match=r"^The aliases of the passed value .* too many values$"):
        read_values(text)


def test_aliases_of_ordinary_size_are_taken(monkeypatch):
    assert read_values("{a: &x [1, 2], b: *x}") == {"a": [1, 2], "b": [1, 2]}
    monkeypatch.setattr("ros2cli.values._MOST_COPIES", 100)
    assert len(read_values(f"{{data: [{'1, ' * 1_000}]}}")["data"]) == 1_000


@pytest.fixture
def _usual_depth():
    """What another test of this process raised may have stayed so."""
    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(1000)
    yield
    sys.setrecursionlimit(limit)


@pytest.mark.usefixtures("_usual_depth")
def test_deep_nesting_is_refused_in_one_line():
    with pytest.raises(RuntimeError, match=r"^The passed value is nested too deeply$"):
        read_values(f"{{data: {'[' * 1500}{']' * 1500}}}")


def test_a_date_of_no_calendar_is_refused_in_one_line():
    with pytest.raises(RuntimeError, match=r"what looks like a date: month must be in 1\.\.12"):
        read_values("{data: 2026-13-01}")


def test_errors_that_quote_a_value_are_cut():
    assert shortened(ValueError("short")) == "short"
    assert len(shortened(ValueError("x" * 10_000_000))) < 2000


def test_assignments():
    assert assignment("a:=b:=c") == ("a", "b:=c")
    for bad in ("a", ":=b"):
        with pytest.raises(argparse.ArgumentTypeError, match="not of the form name:=value"):
            assignment(bad)


def test_regular_expressions():
    assert regular_expression("^back.*_r$") == "^back.*_r$"
    with pytest.raises(
        argparse.ArgumentTypeError, match=r"^'\(' is not a regular expression: missing"
    ):
        regular_expression("(")
