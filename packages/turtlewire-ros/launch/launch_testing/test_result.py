"""The results of the tests of a launch."""

from __future__ import annotations

import io
import time
import unittest
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from launch_testing.loader import TestRun

__all__ = ["FailResult", "SkipResult", "TestResult"]


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


class FailResult(_Placeholder):
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


class SkipResult(_Placeholder):
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
