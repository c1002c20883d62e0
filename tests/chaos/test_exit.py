"""The interpreter ends quietly, whatever daemon threads do in native code at that moment."""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

PROGRAM = Path(__file__).with_name("exits.py")
KINDS = (
    ["wait", "batch", "intake", "expected_message", "change_listener"]
    if importlib.util.find_spec("turtlewire._native")
    else ["wait", "batch", "change_listener"]
)
SLOW = [pytest.mark.slow, pytest.mark.timeout(1200)]


def ends_of(kind: str, count: int, middleware: str = "rmw_cyclonedds_cpp") -> set[tuple[int, str]]:
    """The different exit statuses, with stderr, of as many runs."""

    def run(_: int) -> tuple[int, str]:
        done = subprocess.run(
            [sys.executable, PROGRAM, kind],
            env=os.environ | {"PYTHONFAULTHANDLER": "1", "RMW_IMPLEMENTATION": middleware},
            stderr=subprocess.PIPE,
            text=True,
            check=False,
        )
        return done.returncode, done.stderr

    with ThreadPoolExecutor(2) as pool:
        return set(pool.map(run, range(count)))


@pytest.mark.parametrize("count", [5, pytest.param(200, marks=SLOW)])
@pytest.mark.parametrize("kind", KINDS)
def test_exit(kind: str, count: int) -> None:
    assert ends_of(kind, count) == {(0, "")}


@pytest.mark.parametrize(
    ("middleware", "count"),
    [
        ("rmw_cyclonedds_cpp", 3),
        ("rmw_zenoh_cpp", 3),
        pytest.param("rmw_cyclonedds_cpp", 200, marks=SLOW),
        pytest.param("rmw_zenoh_cpp", 40, marks=SLOW),
    ],
)
@pytest.mark.parametrize("kind", ["spin", "spin_and_shutdown", "publish"])
def test_exit_of_a_node(kind: str, middleware: str, count: int) -> None:
    assert ends_of(kind, count, middleware) == {(0, "")}
