"""Turns a folder of interface definitions into a Python package.

Real modules with type stubs, no compiler, no import hook.

The package consists of ``__init__.py``, one module for each of ``msg``, ``srv`` and ``action``,
their stubs, and a copy of the definitions, from which the classes are created at first access.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from shutil import copyfile
from typing import TYPE_CHECKING

from turtlewire.errors import InterfaceError
from turtlewire.msg.idl import idl_to_text
from turtlewire.msg.registry import (
    KINDS,
    add_package,
    interfaces_in,
    load_action,
    load_message,
    load_service,
)
from turtlewire.msg.types import (
    FLOATING_POINT_TYPES,
    AbstractGenericString,
    AbstractNestedType,
    Array,
    BasicType,
    NamespacedType,
)
from turtlewire.msg.values import element_code, numpy_name

if TYPE_CHECKING:
    from pathlib import Path

    from turtlewire.msg.definition import Field, MessageDefinition, ServiceDefinition
    from turtlewire.msg.types import AbstractType

_LINE_LENGTH = 100


def module_stub(package: str, kind: str, names: Iterable[str]) -> str:
    """Text of the stub of one module.

    Args:
        package: The package.
        kind: ``"msg"``, ``"srv"`` or ``"action"``.
        names: Its interfaces of that kind.
    """
    writer = _StubWriter(package, kind)
    for name in names:
        full_name = f"{package}/{kind}/{name}"
        if kind == "msg":
            writer.message(load_message(full_name))
        elif kind == "srv":
            writer.service(load_service(full_name))
        else:
            writer.action(full_name)
    return writer.text(names)


class _StubWriter:
    """Collects the classes of one module and the imports they need."""

    def __init__(self, package: str, kind: str) -> None:
        self.home = f"{package}.{kind}"
        self.imports: set[str] = set()
        self.lines: list[str] = []

    def text(self, names: Iterable[str]) -> str:
        modules = "".join(f"import {name}\n" for name in sorted(self.imports))
        exported = "".join(f'    "{name}",\n' for name in names)
        return (
            f'"""Types of {self.home}; generated."""\n\n{modules}'
            "from collections.abc import Iterable\nfrom typing import Any, ClassVar, TypeAlias\n\n"
            f"from turtlewire.msg import Action, Message, Service\n\n__all__ = [\n{exported}]\n"
            + "\n".join(self.lines)
            + "\n"
        )

    def message(self, definition: MessageDefinition) -> None:
        self.lines += ["", f"class {definition.full_name.rpartition('/')[2]}(Message):"]
        self.lines += [
            f"    {constant.name}: ClassVar[{self.held(constant.type)}]"
            for constant in definition.constants
        ]
        for field in definition.fields:
            self.field(field)
        parameters = [
            f"{field.name}: {self.accepted(field.type)} = ..." for field in definition.fields
        ]
        self.method("__init__", ["*", *parameters, "check_fields: bool = ..."])

    def method(self, name: str, parameters: list[str]) -> None:
        """A method that returns None, in one line if it fits."""
        line = f"    def {name}({', '.join(['self', *parameters])}) -> None: ..."
        if len(line) <= _LINE_LENGTH:
            self.lines.append(line)
        else:
            self.lines.append(f"    def {name}(")
            self.lines += [f"        {parameter}," for parameter in ["self", *parameters]]
            self.lines.append("    ) -> None: ...")

    def field(self, field: Field) -> None:
        if element_code(field.type):
            self.lines += [
                "    @property",
                f"    def {field.name}(self) -> {self.held(field.type)}: ...",
                f"    @{field.name}.setter",
                f"    def {field.name}(self, value: {self.accepted(field.type)}) -> None: ...",
            ]
        else:
            self.lines.append(f"    {field.name}: {self.held(field.type)}")

    def service(self, definition: ServiceDefinition) -> None:
        for message in definition.messages():
            self.message(message)
        name = definition.full_name.rpartition("/")[2]
        self.parts(name, "Service", "Request", "Response", "Event")

    def action(self, full_name: str) -> None:
        definition = load_action(full_name)
        name = full_name.rpartition("/")[2]
        for message in (
            definition.goal,
            definition.result,
            definition.feedback,
            definition.feedback_message,
        ):
            self.message(message)
        self.service(definition.send_goal)
        self.service(definition.get_result)
        self.imports |= {"action_msgs.msg", "action_msgs.srv"}
        self.parts(name, "Action", "Goal", "Result", "Feedback")
        self.lines += [
            "    class Impl:",
            f"        SendGoalService: TypeAlias = {name}_SendGoal",
            f"        GetResultService: TypeAlias = {name}_GetResult",
            f"        FeedbackMessage: TypeAlias = {name}_FeedbackMessage",
            "        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal",
            "        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray",
        ]

    def parts(self, name: str, base: str, *parts: str) -> None:
        arguments = [part for part in parts if part != "Event"]
        types = [f"{name}_{part}" for part in arguments]
        line = f"class {name}({base}[{', '.join(types)}]):"
        if len(line) > _LINE_LENGTH:
            listed = "".join(f"        {type_},\n" for type_ in types)
            line = f"class {name}(\n    {base}[\n{listed}    ]\n):"
        self.lines += [
            "",
            line,
            *(f"    {part}: TypeAlias = {name}_{part}" for part in parts),
        ]

    def held(self, type_: AbstractType) -> str:
        """Annotation of what a field gives back."""
        if isinstance(type_, AbstractNestedType):
            return self.held_values(type_)
        if isinstance(type_, NamespacedType):
            module = ".".join(type_.namespaces)
            if module == self.home:
                return type_.name
            self.imports.add(module)
            return f"{module}.{type_.name}"
        if isinstance(type_, AbstractGenericString):
            return "str"
        assert isinstance(type_, BasicType)
        special = {"boolean": "bool", "octet": "bytes"}
        return special.get(
            type_.typename, "float" if type_.typename in FLOATING_POINT_TYPES else "int"
        )

    def held_values(self, type_: AbstractNestedType) -> str:
        if not element_code(type_):
            return f"list[{self.held(type_.value_type)}]"
        if isinstance(type_, Array):
            self.imports |= {"numpy", "numpy.typing"}
            return f"numpy.typing.NDArray[numpy.{numpy_name(str(type_.value_type))}]"
        self.imports.add("array")
        return f"array.array[{self.held(type_.value_type)}]"

    def accepted(self, type_: AbstractType) -> str:
        """Annotation of what can be assigned."""
        if isinstance(type_, Array) and element_code(type_):
            return "Iterable[Any]"
        if isinstance(type_, AbstractNestedType) and element_code(type_):
            return f"Iterable[{self.held(type_.value_type)}]"
        return self.held(type_)


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
