"""Reading launch files in Python."""

from __future__ import annotations

from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from types import ModuleType
from typing import TYPE_CHECKING, cast

from launch.utilities.raised_in import MODULE_NAME

if TYPE_CHECKING:
    from launch.launch_description import LaunchDescription


class InvalidPythonLaunchFileError(Exception):
    """A Python file that defines no launch description."""


def load_python_launch_file_as_module(python_launch_file_path: str) -> ModuleType:
    """Run the file as a module, without leaving bytecode next to it.

    Raises:
        Exception: What the file raises.
    """
    loader = _UncachedLoader(MODULE_NAME, python_launch_file_path)
    spec = spec_from_loader(loader.name, loader)
    assert spec is not None
    module = module_from_spec(spec)
    loader.exec_module(module)
    return module


def get_launch_description_from_python_launch_file(
    python_launch_file_path: str,
) -> LaunchDescription:
    """Return the result of the file's ``generate_launch_description()``.

    Raises:
        InvalidPythonLaunchFileError: The file does not define the function.
        Exception: What the file raises.
    """
    module = load_python_launch_file_as_module(python_launch_file_path)
    if not hasattr(module, "generate_launch_description"):
        raise InvalidPythonLaunchFileError(
            f"launch file at '{python_launch_file_path}' does not contain the required function "
            "'generate_launch_description()'"
        )
    return cast("LaunchDescription", module.generate_launch_description())


class _UncachedLoader(SourceFileLoader):
    def get_data(self, path: str) -> bytes:
        # importlib then falls back to the source.
        if path.endswith(".pyc"):
            raise OSError("launch files are always read from their source")
        return super().get_data(path)

    def _cache_bytecode(self, *_args: object) -> None:
        """Leave no file behind."""
