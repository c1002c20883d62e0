"""``python -m turtlewire_colcon.run_test``: runs one test of ``colcon test``, with a time limit.

It always leaves a JUnit file, so that ``colcon test-result`` reports a test that
ended too early to write one.
"""

from __future__ import annotations

import argparse
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from importlib.util import find_spec
from pathlib import Path
from xml.sax.saxutils import quoteattr

from turtlewire.testing import reserved_domain

_MODULES = {"pytest": "pytest", "launch": "launch_testing.launch_test"}
#: A launch test needs this module, which comes with ROS 2's launch_testing.
_LAUNCH_MODULE = "launch_testing"
#: pytest's exit status when it has run no test. This is not a failure if an option deselects some.
_NO_TESTS = 5
_SELECTING = ("-k", "-m", "--deselect", "--lf", "--last-failed")
_RESULT = """<?xml version="1.0" encoding="UTF-8"?>
<testsuite name={name} tests="1" failures="{failures}" errors="0" skipped="{skipped}">
  <testcase classname={name} name={name}>{inner}</testcase>
</testsuite>
"""


def main(argv: list[str] | None = None) -> int:
    """Run the command line; returns the exit status of the test."""
    parser = argparse.ArgumentParser(prog="python -m turtlewire_colcon.run_test")
    parser.add_argument("--kind", choices=("pytest", "launch", "command"), required=True)
    parser.add_argument("--name", required=True)
    parser.add_argument("--result", type=Path, required=True)
    parser.add_argument("--folder", required=True, help="where it runs; made if it is missing")
    parser.add_argument("--timeout", type=float, required=True)
    parser.add_argument("--isolated", action="store_true", help="in its own ROS domain")
    parser.add_argument("words", nargs="+")
    options = parser.parse_args(argv)
    result: Path = options.result
    Path(options.folder).mkdir(parents=True, exist_ok=True)
    os.chdir(options.folder)
    result.parent.mkdir(parents=True, exist_ok=True)
    _write_result(result, options.name, "the test ended without a result")
    if options.kind == "launch" and find_spec(_LAUNCH_MODULE) is None:
        _write_result(result, options.name, skipped=f"there is no {_LAUNCH_MODULE} here")
        return 0
    command = _command(options.kind, options.words, result, options.name)
    with _own_domain() if options.isolated else nullcontext():
        status = _run(command, options.timeout)
    if status is None:
        _write_result(result, options.name, f"no end after {options.timeout:g} s")
        return 1
    if options.kind == "pytest":
        return _pytest_status(status, options.words, result, options.name)
    if options.kind == "command":
        _write_result(result, options.name, f"exit status {status}" if status else "")
    return status


@contextmanager
def _own_domain() -> Iterator[None]:
    """Keep other tests of this computer apart; the variable that prevents it is ROS 2's."""
    if "DISABLE_ROS_ISOLATION" in os.environ:
        yield
        return
    with reserved_domain() as domain:
        os.environ["ROS_DOMAIN_ID"] = str(domain)
        print(f"Running with ROS_DOMAIN_ID {domain}", flush=True)  # noqa: T201 -- as ROS 2's does
        yield


def _pytest_status(status: int, words: list[str], result: Path, name: str) -> int:
    """The test's exit status; a failure is in the result file, also if pytest wrote an empty one.

    It does so when it finds no test, and when a file is missing.
    """
    if status == 0 or _has_cases(result):
        return 0 if status == _NO_TESTS else status
    if status == _NO_TESTS and any(word.startswith(_SELECTING) for word in words[1:]):
        return 0
    what = "there is no test in it" if status == _NO_TESTS else f"pytest ended with {status}"
    _write_result(result, name, f"{what}: {words[0]}")
    return status


def _has_cases(result: Path) -> bool:
    """Return True if the result file contains a test, or a file that was skipped as a whole."""
    return b"<testcase " in result.read_bytes()


def _command(kind: str, words: list[str], result: Path, name: str) -> list[str]:
    if kind == "command":
        return words
    command = [sys.executable, "-m", _MODULES[kind], *words, f"--junit-xml={result}"]
    return (
        [*command, f"--junit-prefix={name}", "-p", "no:cacheprovider"]
        if kind == "pytest"
        else command
    )


def _run(command: list[str], timeout: float) -> int | None:
    """Return the command's exit status; None if it was stopped after ``timeout`` seconds."""
    process = subprocess.Popen(command, start_new_session=True)  # noqa: S603 -- the user's own test
    try:
        return process.wait(timeout)
    except subprocess.TimeoutExpired:
        if sys.platform == "win32":
            process.kill()
        else:
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        return None


def _write_result(path: Path, name: str, failure: str = "", skipped: str = "") -> None:
    inner = f"<failure message={quoteattr(failure)}/>" if failure else ""
    inner += f"<skipped message={quoteattr(skipped)}/>" if skipped else ""
    text = _RESULT.format(
        name=quoteattr(name), failures=int(bool(failure)), skipped=int(bool(skipped)), inner=inner
    )
    path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main())
