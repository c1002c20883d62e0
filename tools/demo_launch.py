"""The processes of the demo: starts them in a free domain, passes on their output, stops them."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import NoReturn

from rclpy.impl import excepthooks
from turtlewire import wire
from turtlewire.wire import environment
from turtlewire_ros.process_family import ProcessFamily

__all__ = [
    "ENDING",
    "VENV",
    "Launch",
    "free_domain",
    "interrupt",
    "other_demo_runs",
    "reserve",
]

#: The name of the demo's simulator.
SIMULATOR = "sim"
#: How long to wait until all nodes of this computer are known [ns].
_DISCOVERY_NS = 2_000_000_000


def reserve(domain: int) -> socket.socket | None:
    """Occupy the port of a domain's first process; None if a process of the domain has it.

    As long as the socket is open, no other check takes the domain.
    """
    mark = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    try:
        mark.bind(("", 7410 + 250 * domain))
    except OSError:
        mark.close()
        return None
    return mark


def free_domain() -> tuple[int, socket.socket] | None:
    """Return a domain without processes on this computer, and the socket that reserves it.

    Below 102 the ports stay clear of those that systems hand out.
    """
    for offset in range(101):
        domain = 1 + (os.getpid() + offset) % 101
        mark = reserve(domain)
        if mark is not None:
            return domain, mark
    return None


def other_demo_runs(domain: int) -> bool:
    """Return True if another demo's simulator is in this domain, which must be the set one."""
    # Only DDS takes ports by the domain: a free one saves the discovery.
    if environment.middleware_name() == "rmw_cyclonedds_cpp" and (mark := reserve(domain)):
        mark.close()
        return False
    context = wire.open_context()
    try:
        graph = context.graph

        def is_there() -> bool:
            return any((node.name, node.namespace) == (SIMULATOR, "/") for node in graph.nodes())

        graph.wait_for(lambda: is_there() or graph.is_complete(), _DISCOVERY_NS)
        return is_there()
    finally:
        context.close()


VENV = Path(sys.prefix)
COMMAND = ("ros2", "launch", "learning_tf2_py", "turtle_tf2_demo.launch.py")
#: The signals that end the demo.
ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
#: How long the processes may take to end [s].
_PATIENCE_S = 10.0


class Launch:
    """The launched processes, in a separate session: Ctrl-C reaches only this process.

    What they print is shown until :meth:`stop` is called. Interpreters that are stopped while they
    start print tracebacks, which explain nothing; the log files keep them.

    Args:
        output: File descriptor for what they print; None shows it here.
    """

    def __init__(self, output: int | None = None) -> None:
        self.ended = threading.Event()
        self._output = output
        self._stopping = False
        self._family = ProcessFamily()
        self._process: subprocess.Popen[bytes] | None = None
        self._waiter = threading.Thread(target=self._wait, name="launch-waiter", daemon=True)

    def start(self) -> None:
        """Start them; call :meth:`stop` afterwards, whatever happens."""
        source, output = _output_pair() if self._output is None else (None, self._output)
        with _held_back():  # an interrupt in here would leave the processes running
            self._family.start()
            if source is not None:
                threading.Thread(
                    target=self._show, args=(source,), name="launch-output", daemon=True
                ).start()
            try:
                self._process = self._launch(output)
            finally:
                if source is not None:
                    os.close(output)  # ends that thread, too, if nothing was launched
            self._waiter.start()

    def _launch(self, output: int) -> subprocess.Popen[bytes]:
        # Without a terminal as its input, the launch sends its processes SIGINT itself.
        return subprocess.Popen(
            [str(VENV / "bin" / COMMAND[0]), *COMMAND[1:]],
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=output,
            env=self._family.marked(os.environ),
            start_new_session=True,
        )

    def _show(self, source: int) -> None:
        """Pass on what the processes print, until the last one has closed its output."""
        with open(source, "rb", buffering=0) as stream:
            while True:
                try:
                    text = stream.read(65536)
                except OSError:  # how the end of a pseudo-terminal reads on Linux
                    return
                if not text:
                    return
                if not self._stopping:
                    sys.stdout.buffer.write(text)
                    sys.stdout.flush()

    def _wait(self) -> None:
        if self._process is not None:
            self._process.wait()
        self.ended.set()

    def stop(self) -> int:
        """Send them SIGINT, and stop those that have not ended after ten seconds.

        Returns:
            0, or the exit status of a launch that had ended before.
        """
        _ignore_further_signals()
        if self._process is None:
            return 0
        had_ended = self.ended.is_set()
        if not had_ended:
            self._stopping = True
            self._process.send_signal(signal.SIGINT)
            if not self.ended.wait(_PATIENCE_S):
                print("[demo] some processes did not end: killing them", file=sys.stderr)
        self._family.stop()
        self._waiter.join()
        return self._process.returncode if had_ended else 0


def _output_pair() -> tuple[int, int]:
    """A readable and a writable file descriptor; a pseudo-terminal if the output is a terminal.

    Programs use colours when they write to a terminal.
    """
    return os.openpty() if sys.stdout.isatty() else os.pipe()


@contextmanager
def _held_back() -> Iterator[None]:
    """Delay the signals of :data:`ENDING` until the end of the block."""
    came: list[int] = []
    handlers = {
        signum: signal.signal(signum, lambda number, _frame: came.append(number))
        for signum in ENDING
    }
    try:
        yield
    finally:
        for signum, handler in handlers.items():
            signal.signal(signum, handler)
    if came:
        interrupt()


def interrupt(_signum: int = 0, _frame: object = None) -> NoReturn:
    """End as after Ctrl-C."""
    _ignore_further_signals()
    raise KeyboardInterrupt


def _ignore_further_signals() -> None:
    """Protect the clean-up: at a terminal Ctrl-C arrives twice, as SIGINT and SIGTERM."""
    for signum in ENDING:  # with SIG_IGN, Python complains about a signal that is already pending
        signal.signal(signum, _ignore)


def _ignore(_signum: int, _frame: object) -> None:
    """Ignore a signal, unless it repeats an interrupt that Python has dropped."""
    if excepthooks.take_dropped():
        raise KeyboardInterrupt
