"""Values on the command line, and near names."""

from __future__ import annotations

import argparse

import pytest
import yaml

from ros2cli.suggestion import did_you_mean
from ros2cli.values import positive_float, positive_int, read_values, unsigned_int


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
