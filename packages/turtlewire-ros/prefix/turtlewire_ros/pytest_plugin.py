"""The plugin that pytest loads at each start through this distribution's entry point.

It defines the options and markers of launch tests, and imports their packages only if a test file
mentions them: other tests neither wait for `launch` nor see its fixtures. Test files of
ROS 2's linters, which `ros2 pkg create` puts into each package there, are skipped.
"""

from __future__ import annotations

import re
from contextlib import suppress
from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, NoReturn

import pytest

from turtlewire_ros import pytest_hookspecs

if TYPE_CHECKING:
    from pathlib import Path

_MARKERS = (
    "launch_test: marks a generate_test_description function as a launch test",
    "rostest: marks a generate_test_description function as a launch test of ROS nodes",
    "launch(fixture, shutdown=False): marks a test of what a launch fixture starts",
    *(
        f"{name}: marks a test of a linter of ROS 2"
        for name in ("linter", "copyright", "flake8", "mypy", "pep257", "xmllint")
    ),
)
_LINTER = re.compile(
    rb"^\s*(?:from|import)\s+(ament_(?:copyright|flake8|mypy|pep257|pycodestyle|xmllint))\b",
    re.MULTILINE,
)

#: Plugins, and what files that need them contain.
_PLUGINS = {
    "launch_pytest.plugin": b"mark.launch",
    "launch_testing_ros.pytest.hooks": b"generate_test_description",
    "launch_testing.pytest.hooks": b"generate_test_description",
}


class _AbsentLinter(pytest.Module):
    """A test file that cannot be imported, since its linter is not included."""

    def collect(self) -> NoReturn:
        """Skip the file."""
        pytest.skip("a ROS 2 linter, which is not included", allow_module_level=True)


def pytest_addhooks(pluginmanager: pytest.PytestPluginManager) -> None:
    """Add the hook of launch tests, once."""
    # pytest calls this function again when it registers the hooks of `launch_testing`.
    if not hasattr(pluginmanager.hook, "pytest_launch_collect_makemodule"):
        pluginmanager.add_hookspecs(pytest_hookspecs)


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the option for arguments of launch tests, once."""
    with suppress(ValueError):  # it is there already
        parser.addoption(
            "--launch-args",
            action="append",
            nargs="*",
            default=[],
            help="Arguments of launch tests, as name:=value",
        )


def pytest_configure(config: pytest.Config) -> None:
    """Register the markers, once."""
    known = config.getini("markers")
    for marker in _MARKERS:
        if marker not in known:
            config.addinivalue_line("markers", marker)


def pytest_pycollect_makemodule(
    module_path: Path, parent: pytest.Collector
) -> pytest.Collector | None:
    """Register the plugins that the file needs."""
    source = module_path.read_bytes()
    linter = _LINTER.search(source)
    if linter is not None and find_spec(linter[1].decode()) is None:
        absent: pytest.Collector = _AbsentLinter.from_parent(parent, path=module_path)
        return absent
    for name, sign in _PLUGINS.items():
        if sign in source and not parent.config.pluginmanager.has_plugin(name):
            plugin = import_module(name)
            parent.config.pluginmanager.register(plugin, name)
            # The current call of the hook does not reach what is registered during it.
            if hasattr(plugin, "pytest_pycollect_makemodule"):
                collector: pytest.Collector | None = plugin.pytest_pycollect_makemodule(
                    module_path, parent
                )
                return collector
    return None
