"""Fixtures and helpers of the message tests.

The golden data, filling a message from it, and messages of any type at random.
"""

from __future__ import annotations

import json
from typing import Any

import pytest
from hypothesis import strategies as st

from tests import places
from turtlewire import msg
from turtlewire.msg.registry import load_message
from turtlewire.msg.types import (
    INTEGER_RANGES,
    AbstractNestedType,
    AbstractString,
    AbstractType,
    AbstractWString,
    Array,
    BasicType,
    NamespacedType,
)

GOLDEN = places.GOLDEN / "wire"


@pytest.fixture(scope="session")
def golden():
    return lambda name: json.loads((GOLDEN / name).read_text())


@pytest.fixture(scope="session")
def message_from():
    return _message_from


@pytest.fixture(scope="session")
def messages():
    return _messages


@pytest.fixture(scope="session")
def all_messages():
    """Full names of all messages that come with turtlewire, those of services and actions
    included.
    """
    names = []
    for package, kinds in sorted(msg.interfaces().items()):
        names += [f"{package}/msg/{name}" for name in kinds["msg"]]
        names += [
            f"{package}/srv/{name}_{part}"
            for name in kinds["srv"]
            for part in ("Request", "Response", "Event")
        ]
        names += [
            f"{package}/action/{name}_{part}"
            for name in kinds["action"]
            for part in (
                *("Goal", "Result", "Feedback", "FeedbackMessage"),
                *("SendGoal_Request", "SendGoal_Response", "SendGoal_Event"),
                *("GetResult_Request", "GetResult_Response", "GetResult_Event"),
            )
        ]
    return names


def _message_from(full_name: str, values: dict[str, Any]) -> Any:
    """A message from golden values.

    Nested dicts, bytes as {"bytes": hex}, nan and inf as strings.
    """
    definition = load_message(full_name)
    types = {field.name: field.type for field in definition.fields}
    return msg.get_message(full_name)(
        **{name: _value_from(types[name], value) for name, value in values.items()}
    )


def _value_from(type_: AbstractType, value: Any) -> Any:
    if isinstance(type_, AbstractNestedType):
        return [_value_from(type_.value_type, item) for item in value]
    if isinstance(type_, NamespacedType):
        return _message_from(type_.full_name, value)
    if type_ == BasicType("octet"):
        return bytes.fromhex(value["bytes"])
    return float(value) if type_ in (BasicType("float"), BasicType("double")) else value


def _messages(full_name: str) -> st.SearchStrategy[Any]:
    """Messages of a type with any valid values. NaN is left out, for it is not equal to itself."""
    fields = {field.name: _values(field.type) for field in load_message(full_name).fields}
    return st.builds(msg.get_message(full_name), **fields)


def _values(type_: AbstractType) -> st.SearchStrategy[Any]:
    if isinstance(type_, AbstractNestedType):
        low, high = (
            (type_.size, type_.size)
            if isinstance(type_, Array)
            else (0, min(getattr(type_, "maximum_size", 3), 3))
        )
        return st.lists(_values(type_.value_type), min_size=low, max_size=high)
    if isinstance(type_, NamespacedType):
        return _messages(type_.full_name)
    if isinstance(type_, AbstractString):
        return st.text(
            st.characters(codec="utf-8", exclude_characters="\0"),
            max_size=min(getattr(type_, "maximum_size", 24) // 4, 6),
        )
    if isinstance(type_, AbstractWString):
        return st.text(
            st.characters(codec="utf-8"), max_size=min(getattr(type_, "maximum_size", 6), 6)
        )
    assert isinstance(type_, BasicType)
    if type_.typename in INTEGER_RANGES:
        return st.integers(*INTEGER_RANGES[type_.typename])
    if type_.typename == "boolean":
        return st.booleans()
    if type_.typename == "octet":
        return st.binary(min_size=1, max_size=1)
    return st.floats(allow_nan=False, width=32 if type_.typename == "float" else 64)
