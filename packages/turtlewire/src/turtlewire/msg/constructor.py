"""Compiles the constructors of message classes."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from turtlewire.distro import LYRICAL, since
from turtlewire.msg.types import AbstractNestedType, Array, NamespacedType
from turtlewire.msg.values import array_values, element_code, raw_name, scalar_default

if TYPE_CHECKING:
    from turtlewire.msg.definition import Field, MessageDefinition
    from turtlewire.msg.message import Message


def make_constructor(
    definition: MessageDefinition, class_of: Callable[[str], type[Message]]
) -> Callable[..., None]:
    """Compile ``__init__``: one assignment for each field, defaults as in ROS 2.

    In Lyrical, None means the default of every field, and Python itself refuses unknown
    keywords.

    Args:
        definition: The message.
        class_of: Finds the class of a nested message by its full name.
    """
    environment: dict[str, Any] = {"_finish": _finish}
    parameters = ["_self"]
    body = []
    for index, field in enumerate(definition.fields):
        fresh = _fresh_default(field, index, environment, class_of)
        if index == 0:
            parameters.append("*")
        if isinstance(field.type, Array) and element_code(field.type):
            parameters.append(f"{field.name}=None")
            body.append(f" if {field.name} is None: _self.{raw_name(field.name)} = {fresh}")
            body.append(f" else: _self.{field.name} = {field.name}")
        elif fresh:
            parameters.append(f"{field.name}=None")
            body.append(f" _self.{field.name} = {fresh} if {field.name} is None else {field.name}")
        else:
            environment[f"_default{index}"] = (
                scalar_default(field.type) if field.default is None else field.default
            )
            parameters.append(f"{field.name}=_default{index}")
            none = f"_default{index} if {field.name} is None else " if since(LYRICAL) else ""
            body.append(f" _self.{field.name} = {none}{field.name}")
    last_parameters, last_line = _ending(definition)
    source = f"def __init__({', '.join(parameters)}, {last_parameters}):\n"
    source += "\n".join([*body, f" {last_line}"])
    # Not exec(source): CPython ends with -2 after a Ctrl-C in there, even one that the program
    # caught.
    exec(compile(source, f"<constructor of {definition.full_name}>", "exec"), environment)  # noqa: S102 - our own source, checked names
    constructor: Callable[..., None] = environment["__init__"]
    constructor.__qualname__ = f"{definition.full_name.rpartition('/')[2]}.__init__"
    return constructor


def _ending(definition: MessageDefinition) -> tuple[str, str]:
    """Return the parameters that follow the fields, and the statement that looks at them."""
    always = _checks_are_on()
    if not since(LYRICAL):
        return "**_unknown", f"{'' if always else 'if _unknown: '}_finish(_self, _unknown)"
    star = "" if definition.fields else "*, "
    given = "{'check_fields': check_fields} if check_fields is not None else {}"
    return (
        f"{star}check_fields=None",
        f"{'' if always else 'if check_fields: '}_finish(_self, {given})",
    )


def _fresh_default(
    field: Field,
    index: int,
    environment: dict[str, Any],
    class_of: Callable[[str], type[Message]],
) -> str:
    """Expression for a default that every message needs its own of.

    The empty string where a shared constant does.
    """
    type_ = field.type
    if isinstance(type_, NamespacedType):
        environment[f"_class{index}"] = class_of(type_.full_name)
        return f"_class{index}()"
    if not isinstance(type_, AbstractNestedType):
        return ""
    return _fresh_values(field.default, type_, index, environment, class_of)


def _fresh_values(
    default: Any,
    type_: AbstractNestedType,
    index: int,
    environment: dict[str, Any],
    class_of: Callable[[str], type[Message]],
) -> str:
    code = element_code(type_)
    if code:
        if isinstance(type_, Array):
            environment[f"_default{index}"] = array_values(code, default or (0,) * type_.size)
        else:
            environment[f"_default{index}"] = default or ()  # the assignment makes the array.array
        return f"_default{index}"
    if default is not None:
        environment[f"_default{index}"] = default
        return f"_default{index}.copy()"
    if not isinstance(type_, Array):
        return "[]"
    if isinstance(type_.value_type, NamespacedType):
        environment[f"_class{index}"] = class_of(type_.value_type.full_name)
        return f"[_class{index}() for _ in range({type_.size})]"
    return f"[{scalar_default(type_.value_type)!r}] * {type_.size}"


def _finish(message: Message, unknown: dict[str, Any]) -> None:
    """Look at what the constructor's keywords did not cover: ``check_fields``, and mistakes."""
    check = unknown.pop("check_fields", _checks_are_on())
    if unknown:
        error: Any = AssertionError(
            f"Invalid arguments passed to constructor: {', '.join(sorted(unknown))}"
        )
        error.hint = f"The fields are {', '.join(message.get_fields_and_field_types()) or 'none'}."
        if hasattr(error, "add_note"):
            error.add_note(error.hint)
        raise error
    if check:
        from turtlewire.msg.checks import turn_on_checks

        turn_on_checks(message)


def _checks_are_on() -> bool:
    """Return True if ``ROS_PYTHON_CHECK_FIELDS=1`` asks for ROS 2's checks at every assignment."""
    return os.environ.get("ROS_PYTHON_CHECK_FIELDS") == "1"
