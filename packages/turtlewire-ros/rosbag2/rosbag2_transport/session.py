"""The environment of one command: a context, a node that spins, keys, interrupts."""

from __future__ import annotations

import contextlib
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING

from rclpy.context import Context
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from turtlewire.terminal.keyboard import Keyboard
from turtlewire.terminal.signal_watch import watched

if TYPE_CHECKING:
    import queue

    from typing_extensions import Self

_NO_TERMINAL = "stdin is not a terminal device. Keyboard handling disabled."
_ESCAPE = b"\x1b"


class BagSession:
    """A node in a separate context, and the thread that serves it; a context manager.

    Args:
        name: Name of the node.
        use_sim_time: Whether its clock follows ``/clock``.
        remap: Rules such as ``/a:=/b``.

    Attributes:
        node: The node.
    """

    def __init__(
        self, name: str, *, use_sim_time: bool = False, remap: tuple[str, ...] = ()
    ) -> None:
        self._context = Context()
        self._context.init([])
        rules = [word for rule in remap for word in ("-r", rule)]
        self.node = Node(
            name,
            context=self._context,
            cli_args=["--ros-args", *rules] if rules else None,
            parameter_overrides=[Parameter("use_sim_time", value=use_sim_time)],
        )
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self.node)
        self._thread = threading.Thread(target=self._spin, name=f"{name}-services", daemon=True)

    def __enter__(self) -> Self:
        """Begin to serve the node."""
        self._thread.start()
        return self

    def __exit__(self, *_error: object) -> None:
        """Leave the domain."""
        self._executor.shutdown()
        self._thread.join()
        self.node.destroy_node()
        self._context.try_shutdown()

    def _spin(self) -> None:
        with contextlib.suppress(ExternalShutdownException):
            self._executor.spin()


@contextlib.contextmanager
def stopped_by_signals(stop: queue.SimpleQueue[None]) -> Iterator[None]:
    """Put an item into ``stop`` at SIGINT, SIGTERM and SIGHUP; nothing in a thread.

    SIGHUP comes when the terminal is closed: a recording is also finished then, unless ``nohup``
    lets it go on.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    numbers = [signal.SIGINT, signal.SIGTERM]
    if hasattr(signal, "SIGHUP") and signal.getsignal(signal.SIGHUP) is not signal.SIG_IGN:
        numbers.append(signal.SIGHUP)
    with watched(numbers, lambda: stop.put(None)):
        # No KeyboardInterrupt: the item ends the wait, and the recording is finished in order.
        former = {number: signal.signal(number, lambda *_: None) for number in numbers}
        try:
            yield
        finally:
            for number, handler in former.items():
                signal.signal(number, handler if handler is not None else signal.SIG_DFL)


@contextlib.contextmanager
def handle_keys(bindings: Mapping[bytes, Callable[[], object]], enabled: bool) -> Iterator[None]:
    """Call a function for each key that is pressed, on a separate thread.

    Args:
        bindings: What to call by key; a cursor key is ESC, ``[`` and a letter.
        enabled: Whether keys are read at all.
    """
    if not enabled or threading.current_thread() is not threading.main_thread():
        yield
        return
    if not os.isatty(0):
        print(_NO_TERMINAL, file=sys.stderr)  # noqa: T201 - where ROS 2 says it
        yield
        return
    keyboard = Keyboard(0)
    thread = threading.Thread(target=_read_keys, args=(keyboard, bindings), name="keyboard")
    with keyboard:
        thread.start()
        try:
            yield
        finally:
            keyboard.stop()
            thread.join()


def _read_keys(keyboard: Keyboard, bindings: Mapping[bytes, Callable[[], object]]) -> None:
    key = b""
    while byte := keyboard.read():
        # A cursor key arrives as three bytes.
        key = key + byte if key in (_ESCAPE, _ESCAPE + b"[") else byte
        if key in bindings:
            bindings[key]()
