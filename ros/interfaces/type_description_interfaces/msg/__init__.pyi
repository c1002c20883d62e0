"""Types of type_description_interfaces.msg; generated."""

from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "Field",
    "FieldType",
    "IndividualTypeDescription",
    "KeyValue",
    "TypeDescription",
    "TypeSource",
]

class Field(Message):
    name: str
    type: FieldType
    default_value: str
    def __init__(
        self,
        *,
        name: str = ...,
        type: FieldType = ...,
        default_value: str = ...,
        check_fields: bool = ...,
    ) -> None: ...

class FieldType(Message):
    FIELD_TYPE_NOT_SET: ClassVar[int]
    FIELD_TYPE_NESTED_TYPE: ClassVar[int]
    FIELD_TYPE_INT8: ClassVar[int]
    FIELD_TYPE_UINT8: ClassVar[int]
    FIELD_TYPE_INT16: ClassVar[int]
    FIELD_TYPE_UINT16: ClassVar[int]
    FIELD_TYPE_INT32: ClassVar[int]
    FIELD_TYPE_UINT32: ClassVar[int]
    FIELD_TYPE_INT64: ClassVar[int]
    FIELD_TYPE_UINT64: ClassVar[int]
    FIELD_TYPE_FLOAT: ClassVar[int]
    FIELD_TYPE_DOUBLE: ClassVar[int]
    FIELD_TYPE_LONG_DOUBLE: ClassVar[int]
    FIELD_TYPE_CHAR: ClassVar[int]
    FIELD_TYPE_WCHAR: ClassVar[int]
    FIELD_TYPE_BOOLEAN: ClassVar[int]
    FIELD_TYPE_BYTE: ClassVar[int]
    FIELD_TYPE_STRING: ClassVar[int]
    FIELD_TYPE_WSTRING: ClassVar[int]
    FIELD_TYPE_FIXED_STRING: ClassVar[int]
    FIELD_TYPE_FIXED_WSTRING: ClassVar[int]
    FIELD_TYPE_BOUNDED_STRING: ClassVar[int]
    FIELD_TYPE_BOUNDED_WSTRING: ClassVar[int]
    FIELD_TYPE_NESTED_TYPE_ARRAY: ClassVar[int]
    FIELD_TYPE_INT8_ARRAY: ClassVar[int]
    FIELD_TYPE_UINT8_ARRAY: ClassVar[int]
    FIELD_TYPE_INT16_ARRAY: ClassVar[int]
    FIELD_TYPE_UINT16_ARRAY: ClassVar[int]
    FIELD_TYPE_INT32_ARRAY: ClassVar[int]
    FIELD_TYPE_UINT32_ARRAY: ClassVar[int]
    FIELD_TYPE_INT64_ARRAY: ClassVar[int]
    FIELD_TYPE_UINT64_ARRAY: ClassVar[int]
    FIELD_TYPE_FLOAT_ARRAY: ClassVar[int]
    FIELD_TYPE_DOUBLE_ARRAY: ClassVar[int]
    FIELD_TYPE_LONG_DOUBLE_ARRAY: ClassVar[int]
    FIELD_TYPE_CHAR_ARRAY: ClassVar[int]
    FIELD_TYPE_WCHAR_ARRAY: ClassVar[int]
    FIELD_TYPE_BOOLEAN_ARRAY: ClassVar[int]
    FIELD_TYPE_BYTE_ARRAY: ClassVar[int]
    FIELD_TYPE_STRING_ARRAY: ClassVar[int]
    FIELD_TYPE_WSTRING_ARRAY: ClassVar[int]
    FIELD_TYPE_FIXED_STRING_ARRAY: ClassVar[int]
    FIELD_TYPE_FIXED_WSTRING_ARRAY: ClassVar[int]
    FIELD_TYPE_BOUNDED_STRING_ARRAY: ClassVar[int]
    FIELD_TYPE_BOUNDED_WSTRING_ARRAY: ClassVar[int]
    FIELD_TYPE_NESTED_TYPE_BOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_INT8_BOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_UINT8_BOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_INT16_BOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_UINT16_BOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_INT32_BOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_UINT32_BOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_INT64_BOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_UINT64_BOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_FLOAT_BOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_DOUBLE_BOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_LONG_DOUBLE_BOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_CHAR_BOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_WCHAR_BOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_BOOLEAN_BOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_BYTE_BOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_STRING_BOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_WSTRING_BOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_FIXED_STRING_BOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_FIXED_WSTRING_BOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_BOUNDED_STRING_BOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_BOUNDED_WSTRING_BOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_NESTED_TYPE_UNBOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_INT8_UNBOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_UINT8_UNBOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_INT16_UNBOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_UINT16_UNBOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_INT32_UNBOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_UINT32_UNBOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_INT64_UNBOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_UINT64_UNBOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_FLOAT_UNBOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_DOUBLE_UNBOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_LONG_DOUBLE_UNBOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_CHAR_UNBOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_WCHAR_UNBOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_BOOLEAN_UNBOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_BYTE_UNBOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_STRING_UNBOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_WSTRING_UNBOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_FIXED_STRING_UNBOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_FIXED_WSTRING_UNBOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_BOUNDED_STRING_UNBOUNDED_SEQUENCE: ClassVar[int]
    FIELD_TYPE_BOUNDED_WSTRING_UNBOUNDED_SEQUENCE: ClassVar[int]
    type_id: int
    capacity: int
    string_capacity: int
    nested_type_name: str
    def __init__(
        self,
        *,
        type_id: int = ...,
        capacity: int = ...,
        string_capacity: int = ...,
        nested_type_name: str = ...,
        check_fields: bool = ...,
    ) -> None: ...

class IndividualTypeDescription(Message):
    type_name: str
    fields: list[Field]
    def __init__(
        self,
        *,
        type_name: str = ...,
        fields: list[Field] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class KeyValue(Message):
    key: str
    value: str
    def __init__(self, *, key: str = ..., value: str = ..., check_fields: bool = ...) -> None: ...

class TypeDescription(Message):
    type_description: IndividualTypeDescription
    referenced_type_descriptions: list[IndividualTypeDescription]
    def __init__(
        self,
        *,
        type_description: IndividualTypeDescription = ...,
        referenced_type_descriptions: list[IndividualTypeDescription] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class TypeSource(Message):
    type_name: str
    encoding: str
    raw_file_contents: str
    def __init__(
        self,
        *,
        type_name: str = ...,
        encoding: str = ...,
        raw_file_contents: str = ...,
        check_fields: bool = ...,
    ) -> None: ...
