"""Programs that run in a process of another distribution of ROS 2."""

from __future__ import annotations

import os

from tests.programs import run_python

#: A function for such programs: what a call returns and warns of, or the error that it raises.
OUTCOME = """
import warnings

def outcome(call):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            value = call()
        except Exception as error:
            return f"{type(error).__name__}: {error}"
    return f"{value} {[f'{each.category.__name__}: {each.message}' for each in caught]}"
"""


def lines_in(distro: object, program: str) -> list[str]:
    """Run a program; return the lines that it prints."""
    done = run_python(
        program,
        check=False,
        timeout=120,
        env={**os.environ, "ROS_DISTRO": str(distro), "RMW_IMPLEMENTATION": "local"},
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()
