"""Reading launch files of any language."""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from launch.frontend.parser import Parser
from launch.invalid_launch_file_error import InvalidLaunchFileError
from launch.launch_description_sources.frontend_launch_file_utilities import (
    get_launch_description_from_frontend_launch_file,
)
from launch.launch_description_sources.python_launch_file_utilities import (
    get_launch_description_from_python_launch_file,
)
from turtlewire_ros.workspace_hints import path_hint

if TYPE_CHECKING:
    from launch.launch_description import LaunchDescription


def get_launch_description_from_any_launch_file(
    launch_file_path: str, *, parser: type[Parser] = Parser
) -> LaunchDescription:
    """Read a launch file; the language that belongs to its suffix is tried first.

    Raises:
        InvalidLaunchFileError: No language fits; the text holds the error of each.
        ValueError: The file does not exist.
    """
    if not os.path.isfile(launch_file_path):
        missing = ValueError(
            f"file not found: [Errno 2] No such file or directory: '{launch_file_path}'"
        )
        vars(missing)["hint"] = path_hint(str(launch_file_path))
        raise missing
    extension = os.path.splitext(launch_file_path)[1]
    loaders: list[Callable[[str], LaunchDescription]] = [
        partial(get_launch_description_from_frontend_launch_file, parser=parser),
        get_launch_description_from_python_launch_file,
    ]
    # Python files are the most common; asking would import the parsers of all other languages.
    if extension == ".py" or not Parser.is_extension_valid(extension):
        loaders.reverse()
    errors: list[BaseException] = []
    for loader in loaders:
        try:
            return loader(launch_file_path)
        except Exception as error:  # noqa: BLE001, PERF203  a launch file may raise anything
            errors.append(error)
    raise InvalidLaunchFileError(extension, likely_errors=errors)
