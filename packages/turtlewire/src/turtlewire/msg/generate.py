"""Turns a folder of interface definitions into a Python package.

Real modules with type stubs, no compiler, no import hook.

The package consists of ``__init__.py``, one module for each of ``msg``, ``srv`` and ``action``,
their stubs, and a copy of the definitions, from which the classes are created at first access.
"""

from __future__ import annotations

import re
from shutil import copyfile
from typing import TYPE_CHECKING

from turtlewire.errors import InterfaceError
from turtlewire.msg.idl import idl_to_text
from turtlewire.msg.registry import KINDS, add_package, interfaces_in
from turtlewire.msg.stubs import module_stub

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["generate_package", "import_lines", "package_name", "write_modules"]

_PACKAGE = '''"""Interfaces of {package}."""

from turtlewire.msg import add_package

add_package(__name__, __path__[0])

{imports}'''

_MODULE = '''"""The {kind} interfaces of {package}: classes made at first access."""

from turtlewire.msg.shell import lazy_classes

__all__ = [
{names}]

__getattr__ = lazy_classes(__name__)


def __dir__() -> list[str]:
    return __all__
'''


def generate_package(source: Path, output: Path, package: str = "") -> Path:
    """Generate the Python package of a folder of interfaces.

    Args:
        source: The folder of an interface package, with ``msg``, ``srv`` or ``action`` folders in
            it.
        output: The folder to put the package into, one that is on ``sys.path`` later.
        package: Name of the package; empty to take it from ``package.xml``, or else from the
            folder.

    Returns:
        The folder of the generated package.

    Raises:
        InterfaceError: A definition is wrong or missing; or the package would be the folder
            of the interfaces itself.
    """
    package = package or package_name(source)
    files = _definition_files(source)
    if not files:
        raise InterfaceError(f"no .msg, .srv or .action files in {source}").with_hint(
            "They belong into its msg, srv and action folders."
        )
    folder = output / package
    if folder.resolve() == source.resolve():
        raise InterfaceError(f"{folder} holds the interfaces themselves").with_hint(
            "Name another folder: --output generated"
        )
    for path in _definition_files(folder):
        path.unlink()
    for path in files:
        _put_definition(package, path, folder)
    add_package(package, str(folder))
    imports = import_lines(write_modules(package, interfaces_in(str(folder)), folder))
    text = _PACKAGE.format(package=package, imports=imports)
    (folder / "__init__.py").write_text(text, encoding="utf-8")
    (folder / "py.typed").touch()
    return folder


def _definition_files(source: Path) -> list[Path]:
    """The definitions in a folder; skips .idl files that ROS 2 generated from another file."""
    found = []
    for kind in KINDS:
        found += sorted((source / kind).glob(f"*.{kind}"))
        found += [
            path
            for path in sorted((source / kind).glob("*.idl"))
            if not path.with_suffix(f".{kind}").exists()
        ]
    return found


def _put_definition(package: str, path: Path, folder: Path) -> None:
    kind = path.parent.name
    target = folder / kind / f"{path.stem}.{kind}"
    target.parent.mkdir(parents=True, exist_ok=True)
    if path.suffix == ".idl":
        text = idl_to_text(f"{package}/{kind}/{path.stem}", path.read_text(encoding="utf-8"))
        target.write_text(text, encoding="utf-8")
    else:
        copyfile(path, target)


def import_lines(kinds: list[str]) -> str:
    """Return the imports of a package's modules, with which ``import std_msgs`` is enough.

    In ROS 2 it is enough as soon as any module has imported ``std_msgs.msg``.
    """
    return "".join(f"from . import {kind} as {kind}\n" for kind in kinds)


def write_modules(package: str, interfaces: dict[str, list[str]], folder: Path) -> list[str]:
    """Write modules and stubs for the interfaces of a package into ``folder``.

    Returns:
        The modules with definitions, among ``msg``, ``srv`` and ``action``.
    """
    kinds = []
    for kind in KINDS:
        names = sorted(interfaces[kind], key=_natural_order)
        if not names:
            continue
        kinds.append(kind)
        module = folder / kind
        module.mkdir(parents=True, exist_ok=True)
        listed = "".join(f'    "{name}",\n' for name in names)
        (module / "__init__.py").write_text(
            _MODULE.format(package=package, kind=kind, names=listed), encoding="utf-8"
        )
        (module / "__init__.pyi").write_text(module_stub(package, kind, names), encoding="utf-8")
    return kinds


def _natural_order(name: str) -> list[tuple[int, str]]:
    """Sorts Int8 before Int16, as linters want ``__all__``."""
    return [(int(part), "") if part.isdigit() else (0, part) for part in re.split(r"(\d+)", name)]


def package_name(source: Path) -> str:
    """Name of the package in a folder: what ``package.xml`` says, else the folder's name."""
    manifest = source / "package.xml"
    if not manifest.is_file():
        return source.resolve().name
    from defusedxml.ElementTree import ParseError, parse

    try:
        name = parse(manifest).findtext("name")
    except ParseError as error:
        raise InterfaceError(f"{manifest}: {error}") from error
    if not name:
        raise InterfaceError(f"{manifest} has no <name>")
    return str(name).strip()
