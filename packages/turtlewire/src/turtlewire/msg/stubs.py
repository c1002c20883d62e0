"""Writes type stubs (.pyi) for the modules of an interface package."""

from __future__ import annotations

from typing import TYPE_CHECKING

from turtlewire.msg.registry import load_action, load_message, load_service
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
    from collections.abc import Iterable

    from turtlewire.msg.definition import Field, MessageDefinition, ServiceDefinition
    from turtlewire.msg.types import AbstractType

__all__ = ["module_stub"]

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
