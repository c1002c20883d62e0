"""Launch tests as items of pytest.

The plugin that pytest loads is :mod:`turtlewire_ros.pytest_plugin`; it imports this module when a
file mentions launch tests. Its hooks for the options and markers are also here.
"""

from __future__ import annotations

import runpy
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any

import pytest
from _pytest._code.code import ReprFileLocation

from launch_testing.loader import LoadTestsFromPythonModule, TestRun
from launch_testing.test_runner import LaunchTestRunner
from turtlewire_ros.pytest_plugin import pytest_addhooks, pytest_addoption, pytest_configure

if TYPE_CHECKING:
    import unittest

    from _pytest._io import TerminalWriter
    from typing_extensions import Self

__all__ = [
    "LaunchTestFailure",
    "LaunchTestFailureRepr",
    "LaunchTestItem",
    "LaunchTestModule",
    "find_launch_test_entrypoint",
    "pytest_addhooks",
    "pytest_addoption",
    "pytest_configure",
    "pytest_launch_collect_makemodule",
    "pytest_pycollect_makemodule",
]


class LaunchTestFailure(Exception):
    """Tests of a launch have failed.

    Args:
        message: Name of the module.
        results: What came of each launch.
    """

    def __init__(self, message: str, results: Mapping[TestRun, unittest.TestResult]) -> None:
        super().__init__(message)
        self.results = results


class LaunchTestFailureRepr:
    """Shows what failed.

    Args:
        failures: The results of launches that failed.
    """

    def __init__(self, failures: Mapping[TestRun, unittest.TestResult]) -> None:
        self._failures = failures

    def __str__(self) -> str:
        return "\n".join(text for text, _ in self._lines())

    @property
    def reprcrash(self) -> ReprFileLocation:
        """Location for pytest's summary."""
        shown = [text for text, is_message in self._lines() if is_message]
        return ReprFileLocation("", 0, shown[0] if shown else "failed")

    def toterminal(self, out: TerminalWriter) -> None:
        """Write it."""
        for text, is_message in self._lines():
            out.line(text, red=is_message, bold=is_message)

    def _lines(self) -> Iterator[tuple[str, bool]]:
        """Yield the lines, and whether they say what is wrong."""
        for run, result in self._failures.items():
            if message := getattr(result, "message", ""):
                yield f"{run}: {message}", True
                continue
            for case, text in (*result.failures, *result.errors):
                yield f"_ {run} {_title(case)} _", False
                *trace, last = text.rstrip().splitlines()
                yield from ((line, False) for line in trace)
                yield last, True
            for case in result.unexpectedSuccesses:
                yield f"{run} {_title(case)}: unexpected success", True


class LaunchTestItem(pytest.Item):
    """The tests of one module: one item, which runs all its launches."""

    def __init__(
        self,
        *,
        test_runs: Sequence[TestRun],
        runner_cls: type[LaunchTestRunner],
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.test_runs = test_runs
        self.runner_cls = runner_cls

    @classmethod
    def from_parent(  # type: ignore[override]
        cls,
        parent: pytest.Collector,
        *,
        name: str,
        test_runs: Sequence[TestRun],
        runner_cls: type[LaunchTestRunner] = LaunchTestRunner,
    ) -> LaunchTestItem:
        """Make an item, as pytest wants it.

        Args:
            parent: The module.
            name: Its name.
            test_runs: The launches.
            runner_cls: Runs them.
        """
        return super().from_parent(parent, name=name, test_runs=test_runs, runner_cls=runner_cls)

    def runtest(self) -> None:
        """Run the launches.

        Raises:
            LaunchTestFailure: A test failed.
            Skipped: All tests are skipped.
        """
        arguments = [word for words in self.config.getoption("--launch-args") for word in words]
        runner = self.runner_cls(
            self.test_runs, arguments, bool(self.config.getoption("verbose") > 1)
        )
        runner.validate()
        results = runner.run()
        failed = {run: result for run, result in results.items() if not result.wasSuccessful()}
        if failed:
            raise LaunchTestFailure(self.name, failed)
        reasons = [getattr(result, "skip_reason", None) for result in results.values()]
        if reasons and all(reason is not None for reason in reasons):
            pytest.skip(str(reasons[0]))

    def repr_failure(  # type: ignore[override]
        self, excinfo: pytest.ExceptionInfo[BaseException]
    ) -> Any:
        """Return pytest's description of a failure."""
        if isinstance(excinfo.value, LaunchTestFailure):
            return LaunchTestFailureRepr(excinfo.value.results)
        own = excinfo.traceback.cut(path=self.path)
        if own == excinfo.traceback:  # no line of the user's is in it
            return f"{type(excinfo.value).__name__}: {excinfo.value}"
        excinfo.traceback = own
        return super().repr_failure(excinfo)

    def reportinfo(self) -> tuple[Path, int, str]:
        """Path, line and title."""
        return self.path, 0, f"launch tests: {self.name}"


class LaunchTestModule(pytest.File):
    """A module with launch tests."""

    @classmethod
    def from_parent(cls, *args: Any, **kwargs: Any) -> Self:
        """Make a module, as pytest wants it; ``fspath``, from plugins for ROS 2, is its path."""
        if "fspath" in kwargs:
            kwargs["path"] = Path(kwargs.pop("fspath"))
        module: Self = super().from_parent(*args, **kwargs)
        return module

    def makeitem(self, *args: Any, **kwargs: Any) -> pytest.Item:
        """Make the module's item."""
        return LaunchTestItem.from_parent(*args, **kwargs)

    def collect(self) -> Iterator[pytest.Item]:
        """Yield the module's one item."""
        module = _imported(self.path, self)
        item = self.makeitem(
            self,
            name=module.__name__,
            test_runs=LoadTestsFromPythonModule(module, name=module.__name__),
        )
        marks = getattr(module.generate_test_description, "pytestmark", [])
        item.own_markers.extend(marks)
        item.keywords.update({mark.name: mark for mark in marks})
        yield item


def _title(test: Any) -> str:
    name = getattr(test, "_testMethodName", "")
    return f"{type(test).__name__}.{name}" if name else str(test)


def _imported(path: Path, parent: pytest.Collector) -> ModuleType:
    """Return the module of a file, imported as pytest does it in each of its versions.

    Raises:
        CollectError: The module cannot be imported.
    """
    module: ModuleType = pytest.Module.from_parent(parent, path=path).obj
    return module


def find_launch_test_entrypoint(path: Path, parent: pytest.Collector | None = None) -> Any:
    """Return the function ``generate_test_description`` of a file, or None.

    Args:
        path: The file.
        parent: Its parent in pytest's collection; without it the file is a module without a
            package.
    """
    # Without these bytes, the file need not be imported to see that it has no launch tests.
    if b"generate_test_description" not in path.read_bytes():
        return None
    if parent is None:
        return runpy.run_path(str(path)).get("generate_test_description")
    try:
        module = _imported(path, parent)
    except pytest.Collector.CollectError:
        return None  # pytest's own collection reports the error
    return getattr(module, "generate_test_description", None)


def pytest_pycollect_makemodule(
    module_path: Path, parent: pytest.Collector
) -> pytest.Collector | None:
    """Let plugins decide how a file with a ``generate_test_description`` is collected."""
    entrypoint = find_launch_test_entrypoint(module_path, parent)
    if entrypoint is None:
        return None
    collector: pytest.Collector | None = parent.ihook.pytest_launch_collect_makemodule(
        module_path=module_path, path=module_path, parent=parent, entrypoint=entrypoint
    )
    return collector


@pytest.hookimpl(trylast=True)
def pytest_launch_collect_makemodule(
    module_path: Path,
    path: Path,  # noqa: ARG001 - ROS 2's
    parent: pytest.Collector,
    entrypoint: Any,
) -> LaunchTestModule | None:
    """Collect a module whose function is marked ``launch_test``."""
    marks = getattr(entrypoint, "pytestmark", [])
    if not any(mark.name == "launch_test" for mark in marks):
        return None
    return LaunchTestModule.from_parent(parent, path=module_path)
