"""The output of the processes of a launch."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator, KeysView
from typing import TYPE_CHECKING, Any

from launch_testing.asserts.assert_output import assertInStream
from launch_testing.util.proc_lookup import NoMatchingProcessException, resolveProcesses

if TYPE_CHECKING:
    from launch.events.process import ProcessIO

__unittest = True  # unittest leaves this module out of the tracebacks of failures


class IoHandler:
    """The output of all processes, in order. Iteration gives ``ProcessIO`` events."""

    def __init__(self) -> None:
        self._events: list[ProcessIO] = []
        self._by_name: dict[str, list[ProcessIO]] = {}
        self._actions: dict[str, Any] = {}

    def append(self, process_io: ProcessIO) -> None:
        """Record output."""
        self.track(process_io.process_name)
        self._events.append(process_io)
        self._by_name[process_io.process_name].append(process_io)
        self._actions[process_io.process_name] = process_io.action

    def track(self, process_name: str) -> None:
        """Note a process that has written nothing yet."""
        self._by_name.setdefault(process_name, [])

    def __iter__(self) -> Iterator[ProcessIO]:
        return iter(self._events)

    def processes(self) -> list[Any]:
        """Return the actions of the processes that have written something."""
        return list(self._actions.values())

    def process_names(self) -> KeysView[str]:
        """Return the names of all known processes."""
        return self._by_name.keys()

    def __getitem__(self, key: Any) -> list[ProcessIO]:
        """Return the output of a process, given by its action or by its name.

        Raises:
            KeyError: The process is unknown.
        """
        name = key if isinstance(key, str) else (key.process_details or {}).get("name", key)
        return list(self._by_name[name])


class ActiveIoHandler:
    """An `IoHandler` of a running launch: thread-safe, and a test can wait for output."""

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._records = IoHandler()

    @property
    def io_event(self) -> threading.Condition:
        """Notified after each output; its lock guards the records."""
        return self._changed

    @property
    def records(self) -> IoHandler:
        """The records, for tests after the shutdown."""
        return self._records

    def track(self, process_name: str) -> None:
        """Note a process that has written nothing yet."""
        with self._changed:
            self._records.track(process_name)

    def append(self, process_io: ProcessIO) -> None:
        """Record output, and wake waiting threads."""
        with self._changed:
            self._records.append(process_io)
            self._changed.notify_all()

    def __iter__(self) -> Iterator[ProcessIO]:
        with self._changed:
            # A copy, because output may come while the caller iterates.
            return iter(list(self._records))

    def processes(self) -> list[Any]:
        """Return the actions of the processes that have written something."""
        with self._changed:
            return self._records.processes()

    def process_names(self) -> list[str]:
        """Return the names of all known processes."""
        with self._changed:
            return list(self._records.process_names())

    def __getitem__(self, key: Any) -> list[ProcessIO]:
        """Return the output of a process, given by its action or by its name."""
        with self._changed:
            return self._records[key]

    def waitFor(  # noqa: N802  ROS 2's name
        self,
        expected_output: Any,
        process: Any = None,
        cmd_args: Any = None,
        *,
        strict_proc_matching: bool = True,
        output_filter: Callable[[str], str] | None = None,
        timeout: float | None = 10,
        strip_ansi_escape_sequences: bool = True,
        stream: str = "stderr",
    ) -> bool:
        """Wait until a process has written what is expected.

        Args:
            expected_output: As for :func:`launch_testing.asserts.assertInStream`, like the other
                arguments.
            process: An action, a part of a name, or None for all processes.
            cmd_args: See there.
            strict_proc_matching: See there.
            output_filter: See there.
            timeout: Seconds to wait at most; None for no limit.
            strip_ansi_escape_sequences: See there.
            stream: ``stdout`` or ``stderr``. ROS nodes log to stderr.

        Returns:
            Whether it was written in time.
        """

        def found() -> bool:
            try:
                assertInStream(
                    self._records,
                    expected_output,
                    process,
                    cmd_args,
                    output_filter=output_filter,
                    strict_proc_matching=strict_proc_matching,
                    strip_ansi_escape_sequences=strip_ansi_escape_sequences,
                    stream=stream,
                )
            except (AssertionError, NoMatchingProcessException):
                return False
            return True

        with self._changed:
            return self._changed.wait_for(found, timeout)

    def assertWaitFor(self, *args: Any, **kwargs: Any) -> None:  # noqa: N802  ROS 2's name
        """Wait as :meth:`waitFor` does.

        Raises:
            AssertionError: The output was not written in time.
        """
        assert self.waitFor(*args, **kwargs), self._failure(*args, **kwargs)

    def _failure(
        self, expected_output: Any, process: Any = None, cmd_args: Any = None, **kwargs: Any
    ) -> str:
        stream = kwargs.get("stream", "stderr")
        text = f"Waiting for output timed out: {expected_output!r} on {stream}. "
        try:
            actions = resolveProcesses(
                self, process=process, cmd_args=cmd_args, strict_proc_matching=False
            )
        except NoMatchingProcessException as error:
            return f"{text}{error}"
        written = b"".join(
            event.text
            for event in self
            if event.action in actions
            and (event.from_stderr if stream == "stderr" else event.from_stdout)
        ).decode(errors="replace")
        last = "\n".join(f"    {line}" for line in written.splitlines()[-10:])
        return text + (f"Last lines:\n{last}" if last else f"Nothing was written to {stream}.")
