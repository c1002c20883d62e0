"""A process that a test starts in the running launch."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

from launch import LaunchDescription
from launch.actions import ExecuteProcess
from launch.events import matches_action
from launch.events.process import ProcessExited, ShutdownProcess
from launch.utilities import ensure_argument_type

if TYPE_CHECKING:
    from launch import LaunchService


class ProcessProxy:
    """A test's view of a process.

    Args:
        process_action: The action that runs it.
        proc_info: Where its start and end are recorded.
        proc_output: Where its output is recorded.
        output_filter: Changes its output before a test sees it.
    """

    def __init__(
        self,
        process_action: ExecuteProcess,
        proc_info: Any,
        proc_output: Any,
        *,
        output_filter: Callable[[str], str] | None = None,
    ) -> None:
        ensure_argument_type(process_action, ExecuteProcess, "process_action", "ProcessProxy")
        self._action = process_action
        self._proc_info = proc_info
        self._proc_output = proc_output
        self._output_filter = output_filter

    def wait_for_shutdown(self, timeout: float | None = None) -> bool:
        """Wait until it has ended; returns whether it has."""
        with self._proc_info.proc_event:
            return bool(self._proc_info.proc_event.wait_for(lambda: self.terminated, timeout))

    def wait_for_output(
        self, condition: Callable[[str], Any] | None = None, timeout: float | None = None
    ) -> bool:
        """Wait until its output fulfils a condition; without one, until there is any.

        Returns:
            Whether it does.
        """
        fulfilled = bool if condition is None else condition
        with self._proc_output.io_event:
            return bool(
                self._proc_output.io_event.wait_for(lambda: fulfilled(self.output), timeout)
            )

    @property
    def target_process_action(self) -> ExecuteProcess:
        """The action that runs it."""
        return self._action

    @property
    def running(self) -> bool:
        """True if it has started and not ended."""
        return self._action in self._proc_info.processes() and not self.terminated

    @property
    def terminated(self) -> bool:
        """True if it has ended."""
        return self._action in self._proc_info.processes() and isinstance(
            self._proc_info[self._action], ProcessExited
        )

    @property
    def exit_code(self) -> int | None:
        """The exit code of the process; None while it runs."""
        return self._proc_info[self._action].returncode if self.terminated else None

    @property
    def stderr(self) -> str:
        """Output to stderr so far."""
        return self._text(lambda event: event.from_stderr)

    @property
    def stdout(self) -> str:
        """Output to stdout so far."""
        return self._text(lambda event: event.from_stdout)

    @property
    def output(self) -> str:
        """Output to stdout and stderr so far."""
        return self._text(lambda _: True)

    def _text(self, wanted: Callable[[Any], bool]) -> str:
        events = [each for each in self._proc_output if each.action is self._action]
        # Joined before it is decoded, because a chunk may end within a character.
        text = b"".join(each.text for each in events if wanted(each)).decode(errors="replace")
        return text if self._output_filter is None else self._output_filter(text)


@contextlib.contextmanager
def launch_process(
    launch_service: LaunchService,
    process_action: ExecuteProcess,
    proc_info: Any,
    proc_output: Any,
    **kwargs: Any,
) -> Iterator[ProcessProxy]:
    """Start a process in a running launch; the end of the ``with`` block stops it.

    Args:
        launch_service: The launch, which runs on another thread.
        process_action: The action that runs the process.
        proc_info: The test's ``proc_info``.
        proc_output: The test's ``proc_output``.
        **kwargs: See :class:`ProcessProxy`.

    Yields:
        The process, which has started.

    Raises:
        AssertionError: The process could not be started.
    """
    proxy = ProcessProxy(process_action, proc_info, proc_output, **kwargs)
    launch_service.include_launch_description(LaunchDescription([process_action]))
    proc_info.assertWaitForStartup(process=process_action)
    try:
        yield proxy
    finally:
        if not proxy.terminated:
            launch_service.emit_event(
                ShutdownProcess(process_matcher=matches_action(process_action))
            )
            # The launch itself escalates to SIGKILL.
            proc_info.assertWaitForShutdown(process=process_action, timeout=60)
