"""Converts single files on the command line: ``msg2idl.py``, ``srv2idl.py``, ``action2idl.py``."""

from __future__ import annotations

import argparse
import pathlib
import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["convert_files_to_idl"]


def convert_files_to_idl(
    extension: str,
    conversion_function: Callable[..., Any],
    argv: list[str] = sys.argv[1:],
) -> str | None:
    """Convert files into IDL files next to them.

    Args:
        extension: Suffix of the files, for example ``.msg``.
        conversion_function: For example `rosidl_adapter.msg.convert_msg_to_idl`.
        argv: Paths of the files.

    Returns:
        The text of an error, or None.
    """
    parser = argparse.ArgumentParser(description=f"Convert {extension} files to .idl")
    parser.add_argument("interface_files", nargs="+", type=pathlib.Path, help="Files to convert")
    for path in parser.parse_args(argv).interface_files:
        # Not resolved: a linked file belongs to the package that the link is in.
        file = path.absolute()
        package = _package_of(file)
        if package is None:
            return f"no package.xml above '{path}': which package is it of?"
        folder, name = package
        conversion_function(folder, name, file.relative_to(folder), file.parent)
    return None


def _package_of(file: pathlib.Path) -> tuple[pathlib.Path, str] | None:
    """Return folder and name of the package that a file is in."""
    from defusedxml import ElementTree

    for folder in file.parents:
        if (folder / "package.xml").is_file():
            name = ElementTree.parse(folder / "package.xml").findtext("name", "")
            return folder, name.strip()
    return None
