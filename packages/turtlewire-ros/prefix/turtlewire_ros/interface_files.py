"""Generates files from the engine's interfaces; the build of the wheel runs it.

``python -m turtlewire_ros.interface_files PREFIX MODULES`` writes definitions below ``PREFIX``,
where programs of ROS 2 read them (``share/std_msgs/msg/String.msg`` and ``String.idl`` next to it),
and packages to import (``std_msgs.msg`` with its type stubs) below ``MODULES``: Jazzy's, and
later ones.
"""

from __future__ import annotations

import sys
from pathlib import Path

from rosidl_adapter.idl import interface_to_idl
from turtlewire.msg.bundled import bundled_interfaces, bundled_packages
from turtlewire.msg.generate import import_lines, write_modules
from turtlewire.msg.registry import interface_text

#: Folder of a prefix that has, for each package with interfaces, a file that lists theirs.
INDEX = Path("share", "ament_index", "resource_index", "rosidl_interfaces")


def write_interface_files(prefix: Path) -> None:
    """Write the definitions of all bundled packages, as text and as IDL, below a prefix.

    Raises:
        OSError: A file cannot be written.
    """
    for package in bundled_packages():
        kinds = bundled_interfaces(package)
        share = prefix / "share" / package
        for kind, names in kinds.items():
            for name in names:
                source = Path(kind, f"{name}.{kind}")
                text = interface_text(f"{package}/{kind}/{name}")
                _write(share / source, text)
                idl = interface_to_idl(package, source, text)
                _write(share / source.with_suffix(".idl"), idl)
        listed = [
            f"{kind}/{name}.{ending}"
            for kind, names in kinds.items()
            for name in names
            for ending in (kind, "idl")
        ]
        _write(prefix / INDEX / package, "\n".join(sorted(listed)))


def write_interface_modules(folder: Path) -> None:
    """Write a package of Python modules and stubs for each bundled package below a folder.

    turtlesim, which has code of its own, gets the modules ``msg``, ``srv`` and ``action`` alone.

    Raises:
        OSError: A file cannot be written.
    """
    for package in bundled_packages():
        kinds = bundled_interfaces(package)
        imports = import_lines(write_modules(package, kinds, folder / package))
        if package != "turtlesim":
            text = f'"""Interfaces of {package}."""\n\n{imports}'
            _write(folder / package / "__init__.py", text)
            _write(folder / package / "py.typed", "")


def _write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    write_interface_files(Path(sys.argv[1]))
    write_interface_modules(Path(sys.argv[2]))
