"""``python -m turtlewire_ros.interface_files DIR``: what ``share`` holds of this distribution.

Programs read definitions where ROS 2 has them, in ``share/std_msgs/msg/String.msg`` and beside it
``String.idl``. The build of the wheel writes them from the engine's, with the index of them.
"""

from __future__ import annotations

import sys
from pathlib import Path

from rosidl_adapter.idl import interface_to_idl
from turtlewire.msg import interface_names, interface_path

__all__ = ["INDEX", "write_interface_files"]

#: Folder of a prefix that has, for each package with interfaces, a file that lists theirs.
INDEX = Path("share", "ament_index", "resource_index", "rosidl_interfaces")


def write_interface_files(prefix: Path) -> None:
    """Write the definitions of all known packages, as text and as IDL, below a prefix.

    Raises:
        OSError: A file cannot be written.
    """
    for package, kinds in interface_names().items():
        share = prefix / "share" / package
        for kind, names in kinds.items():
            for name in names:
                source = Path(kind, f"{name}.{kind}")
                text = Path(interface_path(f"{package}/{kind}/{name}")).read_text(encoding="utf-8")
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


def _write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    write_interface_files(Path(sys.argv[1]))
