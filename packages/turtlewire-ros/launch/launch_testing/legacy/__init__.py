"""Tests as actions of a launch: the interface before ``launch_test``, which older packages use.

::

    tests = LaunchTestService()
    tests.add_fixture_action(description, node)
    tests.add_test_action(description, ExecuteProcess(cmd=["pytest", "tests"]))
    service = LaunchService()
    service.include_launch_description(description)
    status = tests.run(service)

========  ==================================
module    contents
========  ==================================
`output`  tests and filters of output
========  ==================================
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import TYPE_CHECKING, Any

from launch.actions import EmitEvent, ExecuteProcess, OpaqueCoroutine, RegisterEventHandler
from launch.event_handlers import OnExecutionComplete, OnProcessExit, OnProcessIO
from launch.events import Shutdown

if TYPE_CHECKING:
    from launch import Action, LaunchContext, LaunchDescription, LaunchService
    from launch.events.process import ProcessExited, ProcessIO

__all__ = ["LaunchTestService"]


class LaunchTestService:
    """Adds tests to a launch description, and ends the launch when all tests have."""

    def __init__(self) -> None:
        #: The exit status of each test that has ended, None for the others.
        self._tests: dict[str, int | None] = {}
        self._fixture_status = 0

    def add_fixture_action(
        self,
        launch_description: LaunchDescription,
        action: Action,
        exit_allowed: bool | Collection[int] = [0],
    ) -> Action:
        """Add what the tests need; the tests fail if it is a process that ends too early.

        Args:
            launch_description: The launch.
            action: The action.
            exit_allowed: The exit statuses with which the process may end before the tests; True
                for all.
        """
        launch_description.add_action(action)
        if isinstance(action, ExecuteProcess):

            def on_exit(event: ProcessExited, context: LaunchContext) -> EmitEvent | None:
                is_allowed = (
                    exit_allowed
                    if isinstance(exit_allowed, bool)
                    else event.returncode in exit_allowed
                )
                if context.is_shutdown or is_allowed:
                    return None
                self._fixture_status = event.returncode or 1
                return _shutdown(f"{event.process_name} fixture process died!")

            _handle(launch_description, OnProcessExit(target_action=action, on_exit=on_exit))
        return action

    def add_test_action(self, launch_description: LaunchDescription, action: Action) -> Action:
        """Add a test: a process, which passes with exit status 0, or a coroutine that returns.

        The first test that fails ends the launch.

        Raises:
            TypeError: The action is neither a process nor an ``OpaqueCoroutine``.
        """
        name = self._add(f"test_{id(action)}")
        if isinstance(action, ExecuteProcess):

            def on_exit(event: ProcessExited, context: LaunchContext) -> EmitEvent | None:
                return None if context.is_shutdown else self._end(name, event.returncode)

            _handle(launch_description, OnProcessExit(target_action=action, on_exit=on_exit))
        elif isinstance(action, OpaqueCoroutine):

            def on_completion(_event: object, context: LaunchContext) -> EmitEvent | None:
                future = action.get_asyncio_future()
                failed = future is None or future.cancelled() or future.exception() is not None
                return None if context.is_shutdown else self._end(name, int(failed))

            _handle(
                launch_description,
                OnExecutionComplete(target_action=action, on_completion=on_completion),
            )
        else:
            raise TypeError(f"a test is a process or an OpaqueCoroutine, not {action!r}")
        launch_description.add_action(action)
        return action

    def add_output_test(
        self,
        launch_description: LaunchDescription,
        action: ExecuteProcess,
        output_test: Callable[[str], bool],
        test_suffix: str = "output",
        output_filter: Callable[[str], str] | None = None,
        side_effect: str | None = None,
    ) -> ExecuteProcess:
        """Test what a process writes; the test passes as soon as the output fits.

        Args:
            launch_description: The launch, which has the action.
            action: The process.
            output_test: Gets all output so far, and returns True if it fits.
            test_suffix: Distinguishes several tests of one process.
            output_filter: Applied to the output before the test.
            side_effect: ``shutdown`` ends the launch when the test has passed.
        """
        name = self._add(f"test_{id(action)}_{test_suffix}")
        texts: list[str] = []

        def on_output(event: ProcessIO) -> EmitEvent | None:
            texts.append(event.text.decode(errors="backslashreplace"))
            output = "".join(texts)
            if self._tests[name] is not None or not output_test(
                output_filter(output) if output_filter else output
            ):
                return None
            ended = self._end(name, 0)
            return _shutdown("test has passed") if side_effect == "shutdown" else ended

        def on_exit(event: ProcessExited, _context: LaunchContext) -> EmitEvent | None:
            return None if self._tests[name] == 0 else self._end(name, event.returncode or 1)

        _handle(
            launch_description,
            OnProcessIO(target_action=action, on_stdout=on_output, on_stderr=on_output),
        )
        _handle(launch_description, OnProcessExit(target_action=action, on_exit=on_exit))
        return action

    def run(self, launch_service: LaunchService, *args: Any, **kwargs: Any) -> int:
        """Run the launch.

        Args:
            launch_service: The service that includes the launch description.
            *args: For ``launch_service.run``.
            **kwargs: For ``launch_service.run``.

        Returns:
            0 if all tests passed; else the status of the launch, a fixture or a test.
        """
        status = launch_service.run(*args, **kwargs) or self._fixture_status
        failed = [each for each in self._tests.values() if each]
        # A test that has no status did not end.
        return status or (failed[0] if failed else int(None in self._tests.values()))

    def _add(self, name: str) -> str:
        if name in self._tests:
            raise ValueError(f"the test '{name}' exists already; give it another test_suffix")
        self._tests[name] = None
        return name

    def _end(self, name: str, status: int | None) -> EmitEvent | None:
        """Note how a test ended; the launch ends with the last test, or the first that failed."""
        self._tests[name] = 1 if status is None else status
        if status != 0:
            return _shutdown("some test has failed")
        if all(each is not None for each in self._tests.values()):
            return _shutdown("all tests have passed")
        return None


def _handle(launch_description: LaunchDescription, handler: Any) -> None:
    launch_description.add_action(RegisterEventHandler(handler))


def _shutdown(reason: str) -> EmitEvent:
    return EmitEvent(event=Shutdown(reason=reason))
