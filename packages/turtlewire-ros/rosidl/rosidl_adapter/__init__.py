"""``.msg``, ``.srv`` and ``.action`` files as IDL, as ROS 2's package of this name.

======================  ===================================================
module                  contents
======================  ===================================================
`parser`                reads the files, with their comments
`specification`         the content of these files
`idl`                   converts a file; the text of IDL files
`msg`, `srv`, `action`  ROS 2's functions for each kind of file
`resource`              templates of EmPy for these files
`cli`, `main`           conversions on the command line
======================  ===================================================
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import pathlib

__all__ = ["convert_to_idl"]


def convert_to_idl(
    package_dir: pathlib.Path,
    package_name: str,
    interface_file: pathlib.Path,
    output_dir: pathlib.Path,
) -> pathlib.Path:
    """Convert a file by its suffix; see `rosidl_adapter.msg.convert_msg_to_idl`.

    Raises:
        ValueError: The suffix is not ``.msg``, ``.srv`` or ``.action``, or the file is wrong.
        InvalidSpecification: The file is wrong.
    """
    from rosidl_adapter.action import convert_action_to_idl
    from rosidl_adapter.msg import convert_msg_to_idl
    from rosidl_adapter.srv import convert_srv_to_idl

    conversions = {
        ".msg": convert_msg_to_idl,
        ".srv": convert_srv_to_idl,
        ".action": convert_action_to_idl,
    }
    if interface_file.suffix not in conversions:
        raise ValueError(f"'{interface_file}' does not end in one of {', '.join(conversions)}")
    return conversions[interface_file.suffix](package_dir, package_name, interface_file, output_dir)
