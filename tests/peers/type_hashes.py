"""Prints the type hashes of a package of interfaces, as a real ROS 2 calculates them.

Argument: the folder of the package, named as the package.
"""

from __future__ import annotations

import contextlib
import io
import json
import sys
import tempfile
from pathlib import Path

from rosidl_generator_type_description import generate_type_hash

from ament_index_python.packages import get_packages_with_prefixes
from rosidl_adapter.action import convert_action_to_idl
from rosidl_adapter.msg import convert_msg_to_idl
from rosidl_adapter.srv import convert_srv_to_idl

CONVERTERS = {
    "msg": convert_msg_to_idl,
    "srv": convert_srv_to_idl,
    "action": convert_action_to_idl,
}


def type_hashes(package: Path, work: Path) -> dict[str, str]:
    """Return the hash of each type."""
    files = [path for kind in CONVERTERS for path in sorted((package / kind).glob(f"*.{kind}"))]
    for path in files:
        kind = path.parent.name
        CONVERTERS[kind](package, package.name, Path(kind, path.name), work / "idl" / kind)
    arguments = {
        "package_name": package.name,
        "output_dir": str(work / "hashes"),
        "idl_tuples": [f"{work / 'idl'}:{path.parent.name}/{path.stem}.idl" for path in files],
        "include_paths": [
            f"{name}:{prefix}/share/{name}" for name, prefix in get_packages_with_prefixes().items()
        ],
    }
    (work / "arguments.json").write_text(json.dumps(arguments), encoding="utf-8")
    generate_type_hash(str(work / "arguments.json"))
    return {
        each["type_name"]: each["hash_string"]
        for path in (work / "hashes").rglob("*.json")
        for each in json.loads(path.read_text(encoding="utf-8"))["type_hashes"]
    }


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as work, contextlib.redirect_stdout(io.StringIO()):
        hashes = type_hashes(Path(sys.argv[1]), Path(work))
    print(json.dumps(hashes))
