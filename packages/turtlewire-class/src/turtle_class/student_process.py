"""Starts and controls the process of a student's programs, from the process of the checks."""

from __future__ import annotations

import contextlib
import json
import socket
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, NoReturn

from turtle_class.bus_link import Hub
from turtle_lesson.exercise import start_program
from turtle_lesson.mistakes import Mistake, ReportedMistake

if TYPE_CHECKING:
    from pathlib import Path

    from turtle_class.bus_link import News
    from turtle_lesson.lesson import Program
    from turtlesim.testing import Simulation

__all__ = ["StudentProcess"]

#: Longest answer, in bytes, and longest text of a mistake, in characters.
_LONGEST_ANSWER, _LONGEST_TEXT = 64 << 20, 5000
_CRASH = (
    "Something ended the whole Python process: sys.exit(), os._exit(), or a library that crashed. "
    "A node's program ends only after rclpy.spin."
)
_NO_ANSWER = "Leave the file descriptors of the process alone: print() writes to the log."


class StudentProcess:
    """Runs the programs of a student, and nothing else.

    Args:
        work: The folder in which it runs.
    """

    def __init__(self, work: Path) -> None:
        # A socket, because /proc opens a pipe again for code that is graded at the same time.
        ours, theirs = socket.socketpair()
        with theirs:
            self._process = subprocess.Popen(
                [sys.executable, "-m", "turtle_class.student"],
                cwd=work,
                stdin=subprocess.PIPE,
                stdout=theirs.fileno(),
            )
        with ours:  # the file keeps the socket open
            self._answers = ours.makefile("rb")

    def close(self) -> None:
        """End the process."""
        self._process.kill()
        self._process.wait()
        self._answers.close()
        with contextlib.suppress(OSError):  # the rest could not be written
            if self._process.stdin is not None:
                self._process.stdin.close()

    @contextlib.contextmanager
    def programs(
        self, simulation: Simulation, files: Mapping[str, str]
    ) -> Iterator[Callable[[Program], None]]:
        """Import the student's files there; yields what starts a program, there or here.

        Raises:
            ReportedMistake: The code raises, ends the process, or disturbs the answers.
        """
        answer = self._ask(files=dict(files))
        hub = Hub(simulation.wire.bus)
        with _refusing_nonsense():
            hub.apply(answer)

        def exchange(**request: Any) -> bool:
            news = hub.take_news()
            if not news and not request:
                return False
            answer = self._ask(news=news, **request)
            with _refusing_nonsense():
                hub.apply(answer)
            return True

        def start(program: Program) -> None:
            if program.source in files:
                exchange(program=[*program[:3], dict(program.parameters)])
                simulation.come_to_rest()
            else:
                start_program(simulation, program, {})

        simulation.exchange = exchange
        try:
            yield start
        finally:
            simulation.exchange = lambda: False
            hub.close()
        self._ask()

    def _ask(self, **request: Any) -> News:
        assert self._process.stdin is not None
        with contextlib.suppress(OSError):  # it has ended, so no answer follows
            self._process.stdin.write(json.dumps(request).encode() + b"\n")
            self._process.stdin.flush()
        line = self._answers.readline(_LONGEST_ANSWER)
        if not line.endswith(b"\n"):
            self._refuse_silence(line)
        with _refusing_nonsense():
            answer = json.loads(line)
            if "mistake" in answer:
                file, number, text, hint = answer["mistake"]
                texts = [str(value)[:_LONGEST_TEXT] for value in (file, text, hint)]
                mistake = Mistake(texts[0], int(number), *texts[1:])
            else:
                return dict(answer["news"])
        raise ReportedMistake(mistake)

    def _refuse_silence(self, line: bytes) -> NoReturn:
        if len(line) >= _LONGEST_ANSWER:
            raise ReportedMistake(Mistake("", 0, "The program's answer never ends.", _NO_ANSWER))
        status = self._process.wait()
        status = status if status >= 0 else 128 - status
        raise ReportedMistake(Mistake("", 0, f"The program ended with status {status}.", _CRASH))


@contextlib.contextmanager
def _refusing_nonsense() -> Iterator[None]:
    """Turn whatever nonsense of the other process leads to into a mistake of the program."""
    try:
        yield
    except Exception as error:
        text = f"The process of the program sent something other than messages: {error!r}"
        raise ReportedMistake(Mistake("", 0, text[:_LONGEST_TEXT], _NO_ANSWER)) from error
