"""Launch tests of ROS nodes as items of pytest."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch_testing.pytest.hooks import LaunchTestItem, LaunchTestModule
from launch_testing_ros.test_runner import LaunchTestRunner

if TYPE_CHECKING:
    from pathlib import Path

    import pytest


class LaunchROSTestItem(LaunchTestItem):
    """The tests of one module."""

    @classmethod
    def from_parent(cls, *args: Any, **kwargs: Any) -> LaunchTestItem:  # type: ignore[override]
        """Make an item with this package's runner."""
        return super().from_parent(*args, **{"runner_cls": LaunchTestRunner, **kwargs})


class LaunchROSTestModule(LaunchTestModule):
    """A module with launch tests of ROS nodes."""

    def makeitem(self, *args: Any, **kwargs: Any) -> LaunchTestItem:
        """Make the module's item."""
        return LaunchROSTestItem.from_parent(*args, **kwargs)


def pytest_launch_collect_makemodule(
    module_path: Path,
    path: Path,  # noqa: ARG001 - ROS 2's
    parent: pytest.Collector,
    entrypoint: Any,
) -> LaunchROSTestModule | None:
    """Collect a module whose function is marked ``rostest``."""
    marks = getattr(entrypoint, "pytestmark", [])
    if not any(mark.name == "rostest" for mark in marks):
        return None
    module: LaunchROSTestModule = LaunchROSTestModule.from_parent(parent, path=module_path)
    return module
