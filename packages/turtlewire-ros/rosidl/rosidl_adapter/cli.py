"""Converts files: ``msg2idl.py``, ``srv2idl.py``, ``action2idl.py``, and the classes for builds."""

from __future__ import annotations

import argparse
import pathlib
import sys
from collections.abc import Callable, Iterable
from typing import Any

from rosidl_adapter.action import convert_action_to_idl
from rosidl_adapter.msg import convert_msg_to_idl
from rosidl_adapter.srv import convert_srv_to_idl


class TranslateToIDL:
    """Converts files of one kind of a package, for a build; base of the classes for each kind.

    Args:
        name: Name of the entry point in ROS 2, for example ``msg2idl``.
    """

    output_format = "idl"

    def __init__(self, name: str) -> None:
        self._name = name

    @property
    def name(self) -> str:
        """The argument."""
        return self._name

    @property
    def conversion_function(self) -> Callable[..., pathlib.Path]:
        """The function that converts a file."""
        raise NotImplementedError

    def translate(
        self,
        package_name: str,
        interface_files: Iterable[str],
        include_paths: Iterable[str],  # noqa: ARG002  ROS 2's signature; nothing is included
        output_path: pathlib.Path,
    ) -> list[str]:
        """Convert files; return the results as ``OUTPUT_PATH:PATH``.

        Args:
            package_name: Name of the package.
            interface_files: Paths in the folder of the package, each as ``FOLDER:PATH``, or alone
                if that is the current folder.
            include_paths: Not used.
            output_path: Folder for the results, which get the same paths in it.

        Raises:
            ValueError: A path is absolute, or the file is wrong.
            InvalidSpecification: The file is wrong.
        """
        translated = []
        for each in interface_files:
            prefix, _, path = each.rpartition(":")
            source, folder = pathlib.Path(path), pathlib.Path(prefix).absolute()
            result = self.conversion_function(
                folder, package_name, source, output_path / source.parent
            )
            translated.append(f"{output_path}:{result.relative_to(output_path).as_posix()}")
        return translated


class TranslateMsgToIDL(TranslateToIDL):
    """Converts ``.msg`` files."""

    input_format = "msg"

    @property
    def conversion_function(self) -> Callable[..., pathlib.Path]:
        """The function that converts a file."""
        return convert_msg_to_idl


class TranslateSrvToIDL(TranslateToIDL):
    """Converts ``.srv`` files."""

    input_format = "srv"

    @property
    def conversion_function(self) -> Callable[..., pathlib.Path]:
        """The function that converts a file."""
        return convert_srv_to_idl


class TranslateActionToIDL(TranslateToIDL):
    """Converts ``.action`` files."""

    input_format = "action"

    @property
    def conversion_function(self) -> Callable[..., pathlib.Path]:
        """The function that converts a file."""
        return convert_action_to_idl


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
