"""The started processes of a launch, and their exit codes."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator, KeysView
from typing import TYPE_CHECKING, Any

from launch.events.process import ProcessExited
from launch_testing.util.proc_lookup import NoMatchingProcessException, resolveProcesses

if TYPE_CHECKING:
    from launch.events.process import RunningProcessEvent

__unittest = True  # unittest leaves this module out of the tracebacks of failures


class ProcInfoHandler:
    """The last event of each process: ``ProcessStarted`` or ``ProcessExited``.

    Iteration gives these events.
    """

    def __init__(self) -> None:
        self._events: dict[Any, RunningProcessEvent] = {}

    def append(self, process_info: RunningProcessEvent) -> None:
        """Record an event."""
        self._events[process_info.action] = process_info

    def __iter__(self) -> Iterator[Any]:
        return iter(self._events.values())

    def processes(self) -> KeysView[Any]:
        """Return the actions of the recorded processes."""
        return self._events.keys()

    def process_names(self) -> Iterator[str]:
        """Return the names of the recorded processes."""
        return (event.process_name for event in self._events.values())

    def __getitem__(self, key: Any) -> Any:
        """Return the last event of a process, given by its action or by its name.

        Raises:
            KeyError: The process is not recorded.
        """
        if not isinstance(key, str):
            return self._events[key]
        for event in self._events.values():
            if event.process_name == key:
                return event
        raise KeyError(key)


class ActiveProcInfoHandler:
    """A `ProcInfoHandler` of a running launch: thread-safe, and a test can wait for events."""

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._records = ProcInfoHandler()

    @property
    def proc_event(self) -> threading.Condition:
        """Notified after each event; its lock guards the records."""
        return self._changed

    @property
    def records(self) -> ProcInfoHandler:
        """The records, for tests after the shutdown."""
        return self._records

    def append(self, process_info: RunningProcessEvent) -> None:
        """Record an event, and wake waiting threads."""
        with self._changed:
            self._records.append(process_info)
            self._changed.notify_all()

    def __iter__(self) -> Iterator[Any]:
        with self._changed:
            return iter(list(self._records))

    def processes(self) -> list[Any]:
        """Return the actions of the recorded processes."""
        with self._changed:
            return list(self._records.processes())

    def process_names(self) -> list[str]:
        """Return the names of the recorded processes."""
        with self._changed:
            return list(self._records.process_names())

    def __getitem__(self, key: Any) -> Any:
        """Return the last event of a process, given by its action or by its name."""
        with self._changed:
            return self._records[key]

    def assertWaitForShutdown(  # noqa: N802  ROS 2's name
        self, process: Any, cmd_args: Any = None, *, timeout: float | None = 10
    ) -> None:
        """Wait until a process has ended.

        Args:
            process: Its action, or a part of its name.
            cmd_args: As for :func:`launch_testing.util.resolveProcesses`.
            timeout: Seconds to wait at most; None for no limit.

        Raises:
            AssertionError: The process still runs, or was never started.
        """
        ended = self._wait(
            process, cmd_args, lambda event: isinstance(event, ProcessExited), timeout
        )
        assert ended, f"Timed out waiting for process '{process}' to finish"

    def assertWaitForStartup(  # noqa: N802  ROS 2's name
        self, process: Any, cmd_args: Any = None, *, timeout: float | None = 10
    ) -> None:
        """Wait until a process has started; arguments and error as for the shutdown."""
        started = self._wait(process, cmd_args, lambda _: True, timeout)
        assert started, f"Timed out waiting for process '{process}' to start"

    def _wait(
        self,
        process: Any,
        cmd_args: Any,
        fits: Callable[[RunningProcessEvent], bool],
        timeout: float | None,
    ) -> bool:
        def found() -> bool:
            try:
                actions = resolveProcesses(self._records, process=process, cmd_args=cmd_args)
            except NoMatchingProcessException:
                return False
            return all(fits(self._records[action]) for action in actions)

        with self._changed:
            return self._changed.wait_for(found, timeout)
