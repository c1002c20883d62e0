"""The student's programs, in a separate process that knows neither checks nor results.

``python -m turtle_class.student`` reads requests from stdin and answers on stdout, one JSON object
in each line. Whatever the student's code does to this process, it can only change the messages
that its nodes send, which is what the checks look at. The output of the programs goes to stderr.
"""

from __future__ import annotations

import contextlib
import json
import os
import signal
import sys
from collections.abc import Iterator
from types import ModuleType
from typing import TYPE_CHECKING, Any

from turtle_class.bus_link import FarEnd
from turtle_class.seclusion import give_up_rights
from turtle_lesson.exercise import start_program
from turtle_lesson.lesson import Program, imported
from turtle_lesson.mistakes import mistake_of
from turtlesim.testing.programs import rclpy_in_step
from turtlesim.testing.stage import Stage

if TYPE_CHECKING:
    from typing import TextIO

    from turtle_class.bus_link import News

__all__ = ["main"]

#: Computing time without an answer after which code counts as endless [s].
_PATIENCE_S = 5.0
_ONE_PROCESS = (
    "This exercise runs in one process: it neither starts programs nor ends others. Nodes are "
    "started by a launch file, or by the exercise."
)
_FORBIDDEN = frozenset(
    {
        *("os.fork", "os.forkpty", "os.posix_spawn", "os.spawn", "os.system", "os.startfile"),
        *("os.exec", "os.kill", "os.killpg", "subprocess.Popen", "pty.spawn"),
    }
)


class _ForbiddenError(RuntimeError):
    """The student's code starts or ends a process."""

    hint = _ONE_PROCESS


class _Programs:
    """The simulations that requests control, one after the other."""

    def __init__(self) -> None:
        self._opened = contextlib.ExitStack()
        self._files: dict[str, str] = {}
        self._modules: dict[str, ModuleType] = {}

    def answer(self, request: dict[str, Any]) -> dict[str, Any]:
        """Do what a request asks for; the news of this end, or the mistake in the code."""
        try:
            with _interrupted_after(_PATIENCE_S):
                return {"news": self._do(**request)}
        except BaseException as error:  # noqa: BLE001 - students raise anything
            return {"mistake": mistake_of(error, self._files)}

    def _do(
        self,
        news: News | None = None,
        files: dict[str, str] | None = None,
        program: list[Any] | None = None,
    ) -> News:
        """Begin with files, start a program, take over news, or end if nothing is asked for."""
        if files is not None:
            self._begin(files)
        elif news is None:
            self._opened.close()
            return {}
        else:
            self._link.apply(news)
        if program is not None:
            start_program(self._stage, Program(*program), self._modules)
        self._stage.come_to_rest()
        return self._link.take_news()

    def _begin(self, files: dict[str, str]) -> None:
        self._files = files
        self._stage = Stage()
        self._opened.callback(self._stage.close)
        self._link = FarEnd(self._stage.wire.bus)
        self._opened.callback(self._link.close)
        with rclpy_in_step():
            self._modules = self._opened.enter_context(imported(files))


def main() -> None:
    """Answer requests until stdin ends."""
    requests, answers = _own_channel()
    give_up_rights()
    sys.addaudithook(_refuse_processes)
    programs = _Programs()
    for request in requests:
        answers.write(json.dumps(programs.answer(json.loads(request))) + "\n")
        answers.flush()


def _own_channel() -> tuple[TextIO, TextIO]:
    """Take stdin and stdout away from the code: it reads nothing, and prints to the log."""
    requests = os.fdopen(os.dup(0), encoding="utf-8")
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.close(nothing)
    os.dup2(2, 1)
    return requests, answers


@contextlib.contextmanager
def _interrupted_after(seconds: float) -> Iterator[None]:
    """Interrupt code that computes without an end, and again each second."""
    if sys.platform == "win32":
        yield  # there, the limit of the whole run ends it
        return

    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    signal.signal(signal.SIGPROF, interrupt)
    signal.setitimer(signal.ITIMER_PROF, seconds, 1.0)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)


def _refuse_processes(event: str, _: object) -> None:
    if event in _FORBIDDEN:
        raise _ForbiddenError(f"the program calls {event.replace('subprocess.Popen', 'a program')}")


if __name__ == "__main__":
    main()
    # Threads and exit functions of the student's code must not hold up the end.
    os._exit(0)
