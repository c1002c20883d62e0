"""A service as an IDL file."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosidl_adapter.idl import convert
from rosidl_adapter.parser import parse_service_string
from rosidl_adapter.resource import expand_template

if TYPE_CHECKING:
    import pathlib

__all__ = [
    "convert_srv_to_idl",
    "expand_template",
    "parse_service_string",
]


def convert_srv_to_idl(
    package_dir: pathlib.Path, package_name: str, input_file: pathlib.Path, output_dir: pathlib.Path
) -> pathlib.Path:
    """Convert a ``.srv`` file, and print what is read and written.

    Args:
        package_dir: Folder of the package, absolute.
        package_name: Its name.
        input_file: Path of the file below the folder.
        output_dir: Folder for the result.

    Returns:
        Path of the result.

    Raises:
        ValueError: A path is not as described, or the file is wrong.
        InvalidSpecification: The file is wrong.
    """
    return convert("srv", package_dir, package_name, input_file, output_dir)
