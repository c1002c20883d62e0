"""``python -m turtlewire_ros.generate_interfaces``: the Python package of a package's interfaces.

Unlike ``python -m turtlewire.msg``, it requires every type that a field names. So a missing type
fails the build, with its line, instead of the first import.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path

from turtlewire.errors import InterfaceError
from turtlewire.msg.generate import generate_package
from turtlewire.msg.parser import parse_type, without_comment
from turtlewire.msg.registry import KINDS, interface_path
from turtlewire.msg.types import AbstractNestedType, NamespacedType
from turtlewire.package_sources import source_hint

_SEPARATOR = "---"


def main(argv: list[str] | None = None) -> int:
    """Run the command line; returns the exit status."""
    parser = argparse.ArgumentParser(prog="python -m turtlewire_ros.generate_interfaces")
    parser.add_argument("directory", type=Path, help="with msg, srv or action folders in it")
    parser.add_argument("--output", type=Path, required=True, help="where the package goes")
    parser.add_argument("--package", required=True, help="its name")
    options = parser.parse_args(argv)
    try:
        folder = generate_package(options.directory, options.output, options.package)
        faults = list(_unknown_types(options.package, folder, options.directory))
    except InterfaceError as error:
        faults = [str(error), *([error.hint] if error.hint else [])]
    except OSError as error:
        faults = [str(error)]
    if faults:
        print(*faults, sep="\n", file=sys.stderr)  # noqa: T201 -- a command line prints
    return int(bool(faults))


def _unknown_types(package: str, folder: Path, source: Path) -> Iterator[str]:
    """Yield a line for each use of a type that is not found, in the order of files and lines."""
    for path in sorted(file for kind in KINDS for file in (folder / kind).glob(f"*.{kind}")):
        kind = path.parent.name
        # What is made of an .idl file has other lines than that file.
        has_lines = (source / kind / path.name).is_file()
        for number, statement, name in _types_used(package, path.read_text(encoding="utf-8")):
            if not _is_known(name):
                line = f", line {number}" if has_lines else ""
                yield (
                    f"{package}/{kind}/{path.stem}{line}: there is no {name} in '{statement}'; "
                    f"{_advice(package, name)}"
                )


def _types_used(package: str, text: str) -> Iterator[tuple[int, str, str]]:
    """Line, statement and full name of each message that a definition without faults uses."""
    for number, line in enumerate(text.splitlines(), start=1):
        statement = without_comment(line).strip()
        if not statement or statement == _SEPARATOR:
            continue
        type_ = parse_type(package, statement.split(None, 1)[0])
        value_type = type_.value_type if isinstance(type_, AbstractNestedType) else type_
        if isinstance(value_type, NamespacedType):
            yield number, statement, "/".join([*value_type.namespaces, value_type.name])


def _is_known(full_name: str) -> bool:
    try:
        interface_path(full_name)
    except InterfaceError:
        return False
    return True


def _advice(package: str, full_name: str) -> str:
    other = full_name.partition("/")[0]
    if other == package:
        return "add its file to rosidl_generate_interfaces()"
    return source_hint(other) or (
        f"source or install what has it, or build {other} and name it in package.xml"
    )


if __name__ == "__main__":
    sys.exit(main())
