"""Starts a child with limits and reads its results."""

from __future__ import annotations

import json
import os
import socket
import stat
import subprocess
import sys
import tempfile
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from importlib.util import find_spec
from pathlib import Path
from typing import IO, TYPE_CHECKING, NamedTuple

from turtle_class import supervise
from turtlewire.wording import counted

if TYPE_CHECKING:
    from turtle_class.catalogue import ExerciseFolder

__all__ = ["CheckResult", "Limits", "Outcome", "Runner"]

_LARGEST_FILE = 1_000_000
_LONGEST_RESULTS = 10_000_000
_PASSED_ON = ("PATH", "LANG", "LC_ALL", "SYSTEMROOT", "TEMP", "TMP", "TURTLEWIRE_CORE")
_NOT_REACHED = "Not run: fix the checks above first."
_NO_GRADER = "The process of the checks has ended: something ended it, or the memory was too small."
_TOO_LONG = "A callback must return: use a timer instead of a loop or time.sleep(), and no input()."


class Limits(NamedTuple):
    """The resources that an exercise may use.

    Attributes:
        seconds: Time.
        memory: Address space [bytes]; on Linux.
        log: How much of what it prints is kept [bytes].
    """

    seconds: float = 60.0
    memory: int = 2 << 30
    log: int = 20_000


class CheckResult(NamedTuple):
    """The result of a check.

    Attributes:
        check: What is checked, in words.
        state: ``passed``, ``failed`` or ``skipped``.
        text: What was seen instead.
        hint: What helps.
        file: The file to look at, if an error points to a line.
        line: The line, from 1; 0 if none.
    """

    check: str
    state: str
    text: str = ""
    hint: str = ""
    file: str = ""
    line: int = 0


class Outcome(NamedTuple):
    """An exercise of a student.

    Attributes:
        exercise: The exercise.
        handed_in: Whether there is anything.
        results: One for each check.
        log: What the program printed, or the beginning of it.
        seconds: How long it took.
        files: What was handed in, by name.
    """

    exercise: ExerciseFolder
    handed_in: bool
    results: tuple[CheckResult, ...]
    log: str
    seconds: float
    files: dict[str, str]

    @property
    def points(self) -> int:
        """Number of checks that passed."""
        return sum(result.state == "passed" for result in self.results)

    @property
    def passed(self) -> bool:
        """True if all checks passed."""
        return self.points == len(self.results)


class Runner:
    """Grades exercises, each in its own process; for any number of threads.

    Args:
        limits: The resources that an exercise may use; None uses the defaults.
    """

    def __init__(self, limits: Limits | None = None) -> None:
        self._limits = limits or Limits()
        self._lock = threading.Lock()
        self._children: set[subprocess.Popen[bytes]] = set()
        self._stopped = False

    def run(self, exercise: ExerciseFolder, folder: Path, domain: int) -> Outcome:
        """Grade what a student handed in.

        Args:
            exercise: The exercise.
            folder: The student's folder of it.
            domain: ROS domain that no other process uses during the run.
        """
        started = time.monotonic()
        try:
            files = {file: _read(folder, file) for file in exercise.files}
        except _UnreadableError as error:
            missing = not any(os.path.lexists(folder / file) for file in exercise.files)
            state = "skipped" if missing else "failed"
            only = CheckResult("The files are there", state, *error.args)
            return Outcome(exercise, not missing, (only,), "", 0.0, {})
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as scratch:
            place = Path(scratch)
            (place / "work").mkdir()
            for file, text in files.items():
                (place / "work" / file).write_text(text, encoding="utf-8")
            status, told, log = self._run(exercise, place, domain)
        results = _results(_facts(told), status, self._limits)
        return Outcome(exercise, True, results, log, time.monotonic() - started, files)

    def stop(self) -> None:
        """End what runs, with all that it started, and start nothing more."""
        with self._lock:
            self._stopped = True
            for child in self._children:
                _close(child.stdin)

    def _run(self, exercise: ExerciseFolder, place: Path, domain: int) -> tuple[int, str, str]:
        """Run the child; its exit status, its results and what the program printed."""
        limits = self._limits
        command = [
            *(sys.executable, "-I", supervise.__file__, str(limits.seconds), str(limits.memory)),
            *(sys.executable, "-m", "turtle_class.child"),
            *map(str, (exercise.folder, place / "work")),
        ]
        # A socket, because /proc opens a pipe again, and with it the results, for other processes.
        results, written = socket.socketpair()
        with written:
            child = subprocess.Popen(  # noqa: S603 - ours
                command,
                cwd=os.sep,  # no folder of the student: Python imports from where it starts
                env=_environment(place, domain),
                stdin=subprocess.PIPE,  # supervise ends when it is closed
                stdout=written.fileno(),
                stderr=subprocess.PIPE,
                start_new_session=True,  # Ctrl-C is for the grader
            )
        with self._lock:
            self._children.add(child)
            if self._stopped:
                _close(child.stdin)
        assert child.stderr is not None
        with results, ThreadPoolExecutor(1) as reader:
            told = reader.submit(_beginning, results.makefile("rb"), _LONGEST_RESULTS)
            log = _beginning(child.stderr, limits.log)
        status = child.wait()
        with self._lock:
            self._children.discard(child)
        _close(child.stdin)
        return status, told.result(), log


def _close(stream: IO[bytes] | None) -> None:
    assert stream is not None
    stream.close()


class _UnreadableError(Exception):
    """A file cannot be graded: what was seen, and what helps."""


def _read(folder: Path, file: str) -> str:
    path = folder / file
    try:
        facts = path.lstat()
        if not stat.S_ISREG(facts.st_mode) or folder.is_symlink():
            raise _UnreadableError(
                f"{file} is not a regular file.", "Hand in the file itself, not a link to it."
            )
        if facts.st_size > _LARGEST_FILE:
            raise _UnreadableError(
                f"{file} has {facts.st_size} bytes.", f"At most {_LARGEST_FILE} are read."
            )
        return path.read_text(encoding="utf-8-sig")
    except OSError:
        text, hint = f"{file} is missing.", f"Hand it in as {folder.name}/{file}."
        raise _UnreadableError(text, hint) from None
    except UnicodeDecodeError as error:
        text, hint = f"{file} is not UTF-8: {error.reason}.", "Save it as UTF-8 in your editor."
        raise _UnreadableError(text, hint) from None


def _environment(place: Path, domain: int) -> dict[str, str]:
    """Return the child's environment, without the teacher's tokens and settings."""
    home = place / "home"
    home.mkdir()
    places = {
        str(Path(spec.origin).parents[1])
        for name in ("turtle_class", "turtle_lesson", "turtlewire", "rclpy", "learning_tf2_py")
        if (spec := find_spec(name)) is not None and spec.origin is not None
    }
    return {
        **{name: os.environ[name] for name in _PASSED_ON if name in os.environ},
        "HOME": str(home),
        "PYTHONPATH": os.pathsep.join(sorted(places)),
        "PYTHONDONTWRITEBYTECODE": "1",
        "PYTHONHASHSEED": "0",
        "PYTHONIOENCODING": "utf-8",
        "PYTHONUNBUFFERED": "1",
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "OFF",
        "ROS_DOMAIN_ID": str(domain),
        "ROS_LOG_DIR": str(home),
        "TURTLEWIRE_BROWSER": "0",
    }


def _beginning(stream: IO[bytes], most: int) -> str:
    """Read to the end, so that the child never waits; the first bytes as text."""
    kept, total = [], 0
    with stream:
        while data := os.read(stream.fileno(), 65536):
            kept.append(data[: max(0, most - total)])
            total += len(data)
    more = f"\n… and {counted(total - most, 'byte')} more" if total > most else ""
    return b"".join(kept).decode(errors="replace") + more


class _Facts(NamedTuple):
    """Read the child's results.

    Attributes:
        checks: The names of all checks.
        results: Results of the checks that ran.
        end: Whether it came to its end.
    """

    checks: list[str]
    results: list[CheckResult]
    end: bool


def _facts(told: str) -> _Facts:
    """Read the lines of the child; other lines are ignored."""
    facts = _Facts([], [], False)
    for line in told.splitlines():
        facts = _with_fact(facts, line)
    return facts


def _with_fact(facts: _Facts, line: str) -> _Facts:
    try:
        [(kind, fact)] = json.loads(line).items()
        if kind == "checks":
            return facts._replace(checks=[str(name) for name in fact])
        if kind == "result":
            return facts._replace(results=[*facts.results, _result(**fact)])
    # The child was killed while it wrote, or another process has written.
    except (ValueError, TypeError, AttributeError, RecursionError):
        return facts
    return facts._replace(end=facts.end or kind == "end")


def _result(check: str, passed: bool, text: str, hint: str, file: str, line: int) -> CheckResult:
    if not isinstance(passed, bool):
        raise TypeError("passed is not a bool")
    state = "passed" if passed else "failed"
    return CheckResult(str(check), state, str(text), str(hint), str(file), int(line))


def _results(facts: _Facts, status: int, limits: Limits) -> tuple[CheckResult, ...]:
    results = facts.results
    names = facts.checks or ["The exercise begins"]
    if not facts.end:
        text, hint = f"The checks ended with status {status}.", _NO_GRADER
        if status == supervise.TIME_IS_OVER:
            text, hint = f"It did not end within {limits.seconds:g} s.", _TOO_LONG
        if len(results) < len(names):
            results.append(CheckResult(names[len(results)], "failed", text, hint))
    rest = names[len(results) :]
    return (*results, *(CheckResult(name, "skipped", _NOT_REACHED) for name in rest))
