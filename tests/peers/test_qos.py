"""Endpoints of ours and of real nodes on Fast DDS match if ROS 2's rules say so."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

PAIRS = Path(__file__).with_name("pairs.py")
COUNT = 72


def outcomes(program, pattern):
    """Return the matches of the pattern in the lines of all pairs, by the number of the pair."""
    lines = program.wait_for(rf"^(\d+) {pattern}", count=COUNT)
    return {int(line[1]): line[2] for line in lines}


def test_72_pairs_match_or_not_as_rclpy_says(real, run):
    theirs = real("theirs", program=PAIRS)
    cyclone = {"RMW_IMPLEMENTATION": "rmw_cyclonedds_cpp"}
    ours = run(sys.executable, PAIRS, "ours", environment=cyclone)
    rule = outcomes(theirs, "rule (.*)")
    assert outcomes(ours, "rule (.*)") == rule
    ends = outcomes(ours, "(matched|incompatible .*)")
    assert outcomes(theirs, "(matched|incompatible .*)") == ends
    assert {n for n, end in ends.items() if end == "matched"} == {
        n for n, text in rule.items() if text == "OK"
    }
    assert len(ends) == COUNT
