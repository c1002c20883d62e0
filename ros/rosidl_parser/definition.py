"""The types that fields of interfaces have; `SLOT_TYPES` of message classes consists of them."""

from __future__ import annotations

from turtlewire.msg.types import (
    FLOATING_POINT_TYPES,
    INTEGER_RANGES,
    AbstractGenericString,
    AbstractNestedType,
    AbstractSequence,
    AbstractString,
    AbstractType,
    AbstractWString,
    Array,
    BasicType,
    BoundedSequence,
    BoundedString,
    BoundedWString,
    NamespacedType,
    UnboundedSequence,
    UnboundedString,
    UnboundedWString,
)

__all__ = [
    "BOOLEAN_TYPE",
    "FLOATING_POINT_TYPES",
    "INTEGER_TYPES",
    "OCTET_TYPE",
    "SIGNED_INTEGER_TYPES",
    "UNSIGNED_INTEGER_TYPES",
    "AbstractGenericString",
    "AbstractNestedType",
    "AbstractSequence",
    "AbstractString",
    "AbstractType",
    "AbstractWString",
    "Array",
    "BasicType",
    "BoundedSequence",
    "BoundedString",
    "BoundedWString",
    "NamespacedType",
    "UnboundedSequence",
    "UnboundedString",
    "UnboundedWString",
]

BOOLEAN_TYPE = "boolean"
OCTET_TYPE = "octet"
INTEGER_TYPES = tuple(INTEGER_RANGES)
SIGNED_INTEGER_TYPES = tuple(name for name in INTEGER_TYPES if name.startswith("int"))
UNSIGNED_INTEGER_TYPES = tuple(name for name in INTEGER_TYPES if name.startswith("uint"))
