"""The hook that launch tests add to pytest."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from pathlib import Path


@pytest.hookspec(firstresult=True)
def pytest_launch_collect_makemodule(
    module_path: Path, path: Path, parent: pytest.Collector, entrypoint: Any
) -> pytest.Collector | None:
    """Make the collector of a launch test.

    Args:
        module_path: The file; plugins for Jazzy and Kilted do not take it.
        path: The same.
        parent: The collector above.
        entrypoint: The file's function ``generate_test_description``.

    Returns:
        The collector, or None to leave the file to others.
    """
