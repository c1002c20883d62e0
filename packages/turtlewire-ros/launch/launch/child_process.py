"""A child process on the event loop."""

from __future__ import annotations

import asyncio
import contextlib
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any, cast

if TYPE_CHECKING:
    from logging import Logger

# A grandchild may hold the pipes open; the child's own output has already arrived.
_DRAIN_S = 0.5
_SIGKILL = getattr(signal, "SIGKILL", signal.SIGTERM)  # Windows has none


class ChildProcess:
    """Runs one command. Made by :meth:`start`, for the loop's thread only."""

    def __init__(self, transport: asyncio.SubprocessTransport, protocol: _Protocol) -> None:
        self._transport = transport
        self._protocol = protocol

    @classmethod
    async def start(
        cls,
        command: list[str],
        *,
        cwd: str | None,
        env: Mapping[str, str],
        shell: bool,
        inherit_stdin: bool,
        emulate_tty: bool,
        on_start: Callable[[int], None],
        on_output: Callable[[int, bytes], None],
    ) -> ChildProcess:
        """Start a command.

        Args:
            command: Program and arguments; with ``shell`` they are joined to one line for it.
            cwd: Working directory.
            env: Environment.
            shell: Whether a shell interprets the line.
            inherit_stdin: Whether the child reads from this process's stdin; else from a pipe.
            emulate_tty: Whether the child's output goes to a pseudo terminal instead of pipes.
            on_start: Called with the process id, before any output is reported.
            on_output: Called with 1 (stdout) or 2 (stderr) and the bytes that came.

        Raises:
            OSError: The command cannot be started.
        """
        loop = asyncio.get_running_loop()
        protocol = _Protocol(on_start, on_output)
        terminals = _open_terminals() if emulate_tty else {}
        options = {"cwd": cwd, "env": dict(env), **_streams(terminals, inherit_stdin)}
        try:
            if shell:
                started = loop.subprocess_shell(lambda: protocol, " ".join(command), **options)
            else:
                started = loop.subprocess_exec(lambda: protocol, *command, **options)
            transport, _ = await started
        except BaseException:
            # Once the child runs, `_read_terminal` owns them.
            for controller, _ in terminals.values():
                os.close(controller)
            raise
        finally:
            # The child alone may hold the terminals, or reading from them would never end.
            for _, terminal in terminals.values():
                os.close(terminal)
        for fd, (controller, _) in terminals.items():
            await _read_terminal(loop, controller, protocol.stream(fd))
        return cls(transport, protocol)

    @property
    def pid(self) -> int:
        """The process id."""
        return self._transport.get_pid()

    @property
    def running(self) -> bool:
        """True if it has not ended yet."""
        return not self._protocol.exited.is_set()

    async def wait(self, timeout: float | None = None) -> int | None:
        """Return its exit status, negative for a signal; None if it has not ended in time."""
        try:
            await asyncio.wait_for(self._protocol.exited.wait(), timeout)
        except asyncio.TimeoutError:
            return None
        return self._transport.get_returncode()

    async def read_rest(self) -> None:
        """Read the rest of the output of a process that has ended."""
        with contextlib.suppress(asyncio.TimeoutError):
            await asyncio.wait_for(self._protocol.streams_closed.wait(), _DRAIN_S)

    def close(self) -> None:
        """Close the streams; a process that still runs is killed."""
        self._protocol.close_terminals()
        self._transport.close()

    def send_signal(self, number: signal.Signals) -> None:
        """Send a signal, unless the process has ended."""
        with contextlib.suppress(ProcessLookupError):
            if sys.platform == "win32":
                self._transport.send_signal(number)
            elif self.running:
                # The transport would poll first. If the process has just ended, that takes its
                # status away from asyncio's watcher, which then reports 255.
                os.kill(self.pid, number)

    def write(self, data: bytes) -> None:
        """Send input, if its stdin is an open pipe."""
        pipe = self._transport.get_pipe_transport(0)
        if pipe is not None and not pipe.is_closing():
            cast("asyncio.WriteTransport", pipe).write(data)


def stdin_is_terminal() -> bool:
    """Return True if a child could read keys from this process's stdin."""
    return sys.stdin is not None and not sys.stdin.closed and sys.stdin.isatty()


async def escalate(
    process: ChildProcess,
    name: str,
    timeouts: Iterable[str],
    send: Callable[[signal.Signals], None],
    logger: Logger,
) -> None:
    """Send SIGTERM, then SIGKILL, to a process that does not end in time after SIGINT.

    Args:
        process: The process.
        name: Its name in log lines.
        timeouts: Seconds to wait after SIGINT, and after SIGTERM.
        send: Sends a signal to it.
        logger: Where each step is logged, in ROS 2's words.
    """
    steps = (signal.SIGINT, signal.SIGTERM), (signal.SIGTERM, _SIGKILL)
    for (before, after), timeout in zip(steps, timeouts, strict=True):
        if await process.wait(float(timeout)) is not None:
            return
        logger.error(
            "process[%s] failed to terminate '%s' seconds after receiving '%s', escalating to '%s'",
            *(name, timeout, before.name, after.name),
        )
        send(after)


class _Protocol(asyncio.SubprocessProtocol):
    """Receives what the loop reports of a child."""

    def __init__(
        self, on_start: Callable[[int], None], on_output: Callable[[int, bytes], None]
    ) -> None:
        self._on_start = on_start
        self._on_output = on_output
        self._open_streams = {1, 2}
        self._terminals: list[asyncio.BaseTransport] = []
        self.exited = asyncio.Event()
        self.streams_closed = asyncio.Event()

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        self._on_start(cast("asyncio.SubprocessTransport", transport).get_pid())

    def pipe_data_received(self, fd: int, data: bytes | str) -> None:
        self._on_output(fd, cast("bytes", data))

    def pipe_connection_lost(self, fd: int, _error: Exception | None) -> None:
        self._open_streams.discard(fd)
        if not self._open_streams:
            self.streams_closed.set()

    def process_exited(self) -> None:
        self.exited.set()

    def stream(self, fd: int) -> _TerminalStream:
        return _TerminalStream(self, fd)

    def terminal_connected(self, transport: asyncio.BaseTransport) -> None:
        self._terminals.append(transport)

    def close_terminals(self) -> None:
        for transport in self._terminals:
            transport.close()


class _TerminalStream(asyncio.Protocol):
    """An output stream that is read from a pseudo terminal."""

    def __init__(self, child: _Protocol, fd: int) -> None:
        self._child = child
        self._fd = fd

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        self._child.terminal_connected(transport)

    def data_received(self, data: bytes) -> None:
        self._child.pipe_data_received(self._fd, data)

    def connection_lost(self, error: Exception | None) -> None:
        # Linux reports the end of a pseudo terminal as an input/output error; it is not an error
        # here.
        self._child.pipe_connection_lost(self._fd, error)


def _streams(terminals: dict[int, tuple[int, int]], inherit_stdin: bool) -> dict[str, Any]:
    """Return the arguments for a child's streams: pseudo terminals, or pipes without them."""
    return {
        "stdin": None if inherit_stdin else subprocess.PIPE,
        "stdout": terminals[1][1] if terminals else subprocess.PIPE,
        "stderr": terminals[2][1] if terminals else subprocess.PIPE,
    }


def _open_terminals() -> dict[int, tuple[int, int]]:
    """Open a pseudo terminal (controller, terminal) for each output stream; none on Windows."""
    return {fd: os.openpty() for fd in (1, 2)} if hasattr(os, "openpty") else {}


async def _read_terminal(
    loop: asyncio.AbstractEventLoop, controller: int, stream: _TerminalStream
) -> None:
    await loop.connect_read_pipe(lambda: stream, os.fdopen(controller, "rb", buffering=0))
