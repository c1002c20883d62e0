"""Runs a launch and, on another thread, its tests."""

from __future__ import annotations

import inspect
import io
import threading
import time
import unittest
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from launch import LaunchDescription, LaunchDescriptionSource, LaunchService
from launch.actions import IncludeLaunchDescription, RegisterEventHandler
from launch.event_handlers import OnProcessExit, OnProcessIO, OnProcessStart
from launch_testing.io_handler import ActiveIoHandler
from launch_testing.parse_arguments import parse_launch_arguments
from launch_testing.proc_info_handler import ActiveProcInfoHandler

if TYPE_CHECKING:
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch_testing.loader import TestRun

# Seconds; `ready_to_test_action_timeout` sets another.
_READY_TIMEOUT = 15.0
# How long a running test may take to notice that its processes have ended.
_GRACE = 2.0


class LaunchTestRunner:
    """Runs launches one after the other, each with its tests.

    Args:
        test_runs: The launches.
        launch_file_arguments: Arguments ``name:=value``.
        debug: Whether the launches log in detail.
    """

    def __init__(
        self,
        test_runs: Sequence[TestRun],
        launch_file_arguments: Iterable[str] = (),
        debug: bool = False,
    ) -> None:
        self._test_runs = test_runs
        self._arguments = list(launch_file_arguments)
        self._debug = debug

    def generate_preamble(self) -> list[LaunchDescriptionEntity]:
        """Make what is visited before each description; subclasses may add something."""
        return []

    def validate(self) -> None:
        """Check that the functions which make the descriptions can be called.

        Raises:
            TypeError: A test has a parameter without a value.
        """
        for run in self._test_runs:
            function = run.test_description_function
            signature = inspect.signature(function)
            names = [
                name
                for name, parameter in signature.parameters.items()
                if parameter.default is inspect.Parameter.empty
                and parameter.kind not in (parameter.VAR_KEYWORD, parameter.VAR_POSITIONAL)
                and name != "ready_fn"
            ]
            if names:
                raise TypeError(
                    f"generate_test_description has parameters without values: {', '.join(names)}; "
                    "@launch_testing.parametrize gives them values"
                )

    def run(self) -> dict[TestRun, unittest.TestResult]:
        """Run all launches; returns the results of each."""
        results: dict[TestRun, unittest.TestResult] = {}
        for run in self._test_runs:
            if len(self._test_runs) > 1:
                print(f"Starting test run {run}")
            try:
                worker = _Worker(run, self.generate_preamble(), self._arguments, self._debug)
                results[run] = worker.run()
            except unittest.SkipTest as skipped:
                # The function that makes the description is decorated with a skip.
                results[run] = _SkipResult(run, str(skipped))
            except _LaunchEndedError as error:
                results[run] = _FailResult(run, str(error))
        return results


class _LaunchEndedError(Exception):
    """The launch ended before its tests did."""


class _Worker:
    """One launch with its tests."""

    def __init__(
        self,
        run: TestRun,
        preamble: list[LaunchDescriptionEntity],
        arguments: list[str],
        debug: bool,
    ) -> None:
        self._run = run
        self._preamble = preamble
        self._arguments = parse_launch_arguments(arguments)
        self._service = LaunchService(debug=debug)
        self._proc_info = ActiveProcInfoHandler()
        self._proc_output = ActiveIoHandler()
        self._begin = threading.Event()
        self._is_ready = False
        self._timed_out = False
        self._result: TestResult | None = None

    def run(self) -> unittest.TestResult:
        """Launch, test, shut down and test again; returns the results of all tests.

        Raises:
            SkipTest: The description is decorated with a skip.
            _LaunchEndedError: The launch ended before its tests did.
        """
        description, objects = self._run.describe(self._on_ready)
        self._bind(objects)
        self._service.include_launch_description(self._wrapped(description))
        tests = threading.Thread(target=self._run_tests, name="launch_testing", daemon=True)
        tests.start()
        try:
            keep_alive = self._run.markers.get("keep_alive", False)
            self._service.run(shutdown_when_idle=not keep_alive)
        finally:
            self._begin.set()  # the thread ends if the tests have not begun
        tests.join(_GRACE)
        if self._result is None or tests.is_alive():
            raise _LaunchEndedError(self._why())
        after = _run_suite(self._run.post_shutdown_tests)
        return _merged(self._result, after)

    def _wrapped(self, description: LaunchDescription) -> LaunchDescription:
        info, output = self._proc_info, self._proc_output
        handlers = (
            # Tests may ask for the output of a process that has written nothing.
            OnProcessStart(on_start=lambda event, _: output.track(event.process_name)),
            OnProcessStart(on_start=lambda event, _: info.append(event)),
            OnProcessExit(on_exit=lambda event, _: info.append(event)),
            OnProcessIO(on_stdout=output.append, on_stderr=output.append),
        )
        return LaunchDescription(
            [
                *self._preamble,
                *map(RegisterEventHandler, handlers),
                IncludeLaunchDescription(
                    LaunchDescriptionSource(launch_description=description),
                    launch_arguments=self._arguments,
                ),
            ]
        )

    def _bind(self, objects: dict[str, Any]) -> None:
        shared = {"test_args": dict(self._arguments)}
        running = {**shared, "proc_info": self._proc_info, "proc_output": self._proc_output}
        ended = {
            **shared,
            "proc_info": self._proc_info.records,
            "proc_output": self._proc_output.records,
        }
        given = {**objects, **self._run.param_args}
        self._run.bind(
            self._run.pre_shutdown_tests,
            injected_attributes={**running, "launch_service": self._service},
            injected_args={**given, **running, "launch_service": self._service},
        )
        self._run.bind(
            self._run.post_shutdown_tests,
            injected_attributes=ended,
            injected_args={**given, **ended},
        )

    # the thread of the tests

    def _on_ready(self) -> None:
        self._is_ready = True
        self._begin.set()

    def _run_tests(self) -> None:
        timeout = self._run.markers.get("timeout", _READY_TIMEOUT)
        try:
            self._timed_out = not self._begin.wait(timeout)
            if self._is_ready:
                self._result = _run_suite(self._run.pre_shutdown_tests)
        finally:
            self._service.shutdown()

    # the end

    def _why(self) -> str:
        """Return why the tests did not end; print the output of the processes that failed."""
        if self._timed_out:
            print("Timed out waiting for processes to start up")
            return "The launch did not reach its ReadyToTest action in time."
        print("Processes under test stopped before tests completed")
        self._print_failed()
        return "Launch stopped before the active tests finished."

    def _print_failed(self) -> None:
        for event in self._proc_info.records:
            code = getattr(event, "returncode", 0)
            if code:
                title = f"##### '{event.process_name}' output #####"
                texts = [each.text for each in self._proc_output.records[event.process_name]]
                print(f"Process '{event.process_name}' exited with {code}")
                print(title)
                print(b"".join(texts).decode(errors="replace").rstrip("\n"))
                print("#" * len(title))


def _run_suite(tests: unittest.TestSuite) -> TestResult:
    result = unittest.TextTestRunner(verbosity=2, resultclass=TestResult).run(tests)
    assert isinstance(result, TestResult)
    return result


def _merged(before: TestResult, after: TestResult) -> TestResult:
    """Merge the second result into the first one."""
    before.testTimes.update(after.testTimes)
    before.testsRun += after.testsRun
    for name in ("failures", "errors", "skipped", "expectedFailures", "unexpectedSuccesses"):
        getattr(before, name).extend(getattr(after, name))
    return before


class TestResult(unittest.TextTestResult):
    """A result of unittest that also knows which tests ran and how long they took."""

    __test__ = False  # pytest does not collect it

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._times: dict[unittest.TestCase, float] = {}
        self._started = 0.0

    @property
    def testCases(self) -> list[unittest.TestCase]:  # noqa: N802  ROS 2's name
        """The tests that ran, in order."""
        return list(self._times)

    @property
    def testTimes(self) -> dict[unittest.TestCase, float]:  # noqa: N802  ROS 2's name
        """Seconds that each test took."""
        return self._times

    def startTest(self, test: unittest.TestCase) -> None:  # noqa: N802  unittest's name
        self._times[test] = 0.0
        self._started = time.monotonic()
        super().startTest(test)

    def stopTest(self, test: unittest.TestCase) -> None:  # noqa: N802  unittest's name
        super().stopTest(test)
        self._times[test] = time.monotonic() - self._started


class _Placeholder(TestResult):
    """A result of a launch whose tests did not run."""

    def __init__(self, test_run: TestRun | None) -> None:
        super().__init__(stream=io.StringIO(), descriptions=False, verbosity=0)
        self.test_run = test_run


class _FailResult(_Placeholder):
    """The tests of a launch could not run.

    Args:
        test_run: The launch.
        message: Why.
    """

    def __init__(self, test_run: TestRun | None = None, message: str = "") -> None:
        super().__init__(test_run)
        self.message = message
        # So that reports show each test that did not run.
        for case in () if test_run is None else test_run.all_cases():
            self._times[case] = 0.0
            self.failures.append((case, message))

    def wasSuccessful(self) -> bool:  # noqa: N802  unittest's name
        return False


class _SkipResult(_Placeholder):
    """The tests of a launch are skipped.

    Args:
        test_run: The launch.
        skip_reason: Why.
    """

    def __init__(self, test_run: TestRun | None = None, skip_reason: str = "") -> None:
        super().__init__(test_run)
        self.skip_reason = skip_reason
        for case in () if test_run is None else test_run.all_cases():
            self._times[case] = 0.0
            self.skipped.append((case, skip_reason))
