"""Runs a function in a process that stays when this one ends."""

from __future__ import annotations

import copyreg
import io
import os
import pickle
import socket
import subprocess
import sys
import threading
from collections.abc import Callable, Mapping
from typing import Any

from turtlewire_ros.process_guardian import FAMILIES

_READY = b"ready\n"


class PicklerForProcess(pickle.Pickler):
    """Pickles for a child process, also sockets and events.

    Args:
        process: The process; only on Windows it has to be running.
        *args: See :class:`pickle.Pickler`.
        **kwargs: Likewise.
    """

    def __init__(self, process: Any, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._process = process
        #: Descriptors of the sockets, which the process has to inherit; empty on Windows.
        self.descriptors: list[int] = []
        self.dispatch_table = copyreg.dispatch_table.copy()
        self.dispatch_table[socket.socket] = self.reduce_socket
        self.dispatch_table[threading.Event] = self.reduce_event

    def dump(self, *args: Any, **kwargs: Any) -> None:
        """Pickle an object without regard to earlier ones, also in its ``descriptors``."""
        self.descriptors.clear()
        self.clear_memo()
        super().dump(*args, **kwargs)

    def reduce_socket(self, obj: socket.socket) -> tuple[Any, tuple[Any]]:
        """Return how the process gets the socket."""
        if sys.platform == "win32":
            return self.load_socket, (obj.share(self._process.pid),)
        self.descriptors.append(obj.fileno())
        return self.load_socket, (obj.fileno(),)

    @staticmethod
    def load_socket(data: Any) -> socket.socket:
        """Return the socket, in the process."""
        if sys.platform == "win32":
            return socket.fromshare(data)
        return socket.socket(fileno=data)

    def reduce_event(self, obj: threading.Event) -> tuple[Any, tuple[bool]]:
        """Return how the process makes the event; the new event starts in the current state."""
        return _event, (obj.is_set(),)


def _event(is_set: bool) -> threading.Event:
    event = threading.Event()
    if is_set:
        event.set()
    return event


def daemonize(
    callable_: Callable[[], Any],
    tags: Mapping[str, Any] = {},
    timeout: float | None = None,
    debug: bool = False,
) -> None:
    """Call a function in another process, which goes on when this one ends.

    Args:
        callable_: The function; it must be possible to pickle it.
        tags: Words for the command line of the process, where a list of processes shows them.
        timeout: Seconds that the process may take until it calls the function.
        debug: Whether its output appears on stderr; otherwise it is discarded.

    Raises:
        RuntimeError: The process did not call the function.
    """
    words = [sys.executable, "-c", f"from {__name__} import main; main()"]
    words += [word for name, value in tags.items() for word in (f"--{name}", str(value))]
    # Not part of a launch or a verb, whose children end with it.
    environment = {name: value for name, value in os.environ.items() if name != FAMILIES}
    options: dict[str, Any] = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
    options |= {"stderr": None if debug else subprocess.DEVNULL, "env": environment}
    if sys.platform == "win32":
        flags = subprocess.DETACHED_PROCESS | subprocess.CREATE_NEW_PROCESS_GROUP
        process = subprocess.Popen(words, creationflags=flags, **options)  # noqa: S603  our own
        pickled, _ = _pickled(callable_, process)
    else:
        pickled, sockets = _pickled(callable_, None)
        process = subprocess.Popen(words, start_new_session=True, pass_fds=sockets, **options)  # noqa: S603  our own
    _hand_over(process, pickled, timeout)


def _pickled(callable_: Callable[[], Any], process: Any) -> tuple[bytes, list[int]]:
    buffer = io.BytesIO()
    pickler = PicklerForProcess(process, buffer)
    pickler.dump(callable_)
    return buffer.getvalue(), pickler.descriptors


def _hand_over(process: subprocess.Popen[bytes], pickled: bytes, timeout: float | None) -> None:
    assert process.stdin is not None
    assert process.stdout is not None
    limit = None if timeout is None else threading.Timer(timeout, process.kill)
    if limit is not None:
        limit.start()
    with process.stdin, process.stdout:
        try:
            process.stdin.write(pickled)
            process.stdin.close()
        except BrokenPipeError:  # it has ended; the next line reports that
            pass
        is_ready = process.stdout.read() == _READY
    if limit is not None:
        limit.cancel()
        limit.join()
    if not is_ready:
        process.kill()
    if sys.platform == "win32" and is_ready:
        process.returncode = 0  # nobody waits for it, so that Python must not warn
    else:
        process.wait()
    if not is_ready:
        raise RuntimeError("the process ended before it called the function; see `debug`")


def main() -> None:
    """Be the process: read the function from stdin, and call it; the tags are for people."""
    function = pickle.load(sys.stdin.buffer)  # noqa: S301  of the process that started this one
    # A child of its own goes on: the process that started this one waits for it, and then has no
    # child that would be left as a zombie.
    if sys.platform != "win32" and os.fork():
        os._exit(0)
    sys.stdout.buffer.write(_READY)
    sys.stdout.flush()
    # The other end of this pipe ends soon. With `debug`, stderr shows what is printed.
    os.dup2(2, 1)
    function()
