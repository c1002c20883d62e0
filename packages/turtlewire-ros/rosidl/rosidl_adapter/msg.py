"""A message as an IDL file."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosidl_adapter.idl import (
    MSG_TYPE_TO_IDL,
    convert,
    get_idl_type,
    get_include_file,
    string_to_idl_string_literal,
    string_to_idl_wstring_literal,
    to_idl_literal,
)
from rosidl_adapter.parser import BaseType, Type, parse_message_string
from rosidl_adapter.resource import expand_template

if TYPE_CHECKING:
    import pathlib

__all__ = [
    "MSG_TYPE_TO_IDL",
    "BaseType",
    "Type",
    "convert_msg_to_idl",
    "expand_template",
    "get_idl_type",
    "get_include_file",
    "parse_message_string",
    "string_to_idl_string_literal",
    "string_to_idl_wstring_literal",
    "to_idl_literal",
]


def convert_msg_to_idl(
    package_dir: pathlib.Path, package_name: str, input_file: pathlib.Path, output_dir: pathlib.Path
) -> pathlib.Path:
    """Convert a ``.msg`` file, and print what is read and written.

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
    return convert("msg", package_dir, package_name, input_file, output_dir)
