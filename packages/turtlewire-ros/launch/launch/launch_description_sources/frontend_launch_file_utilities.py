"""Reading launch files in XML and YAML."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.frontend.parser import InvalidFrontendLaunchFileError, Parser

if TYPE_CHECKING:
    from launch.launch_description import LaunchDescription

__all__ = ["InvalidFrontendLaunchFileError", "get_launch_description_from_frontend_launch_file"]


def get_launch_description_from_frontend_launch_file(
    frontend_launch_file_path: str, *, parser: type[Parser] = Parser
) -> LaunchDescription:
    """Read a launch file in XML or YAML.

    Raises:
        InvalidFrontendLaunchFileError: No language fits.
        Exception: What is wrong with an element; ``launch_file_line`` says where.
    """
    root, file_parser = parser.load(frontend_launch_file_path)
    try:
        return file_parser.parse_description(root)
    except Exception as error:
        # An element knows its line, but not its file.
        line = vars(error).get("launch_file_line")
        if line is not None:
            vars(error)["launch_file_line"] = f"{frontend_launch_file_path}:{line}"
        raise
