"""The fields of a message as plain data, equal for the classes of ours and of a real ROS 2."""

import array
from typing import Any


def fields(value: Any) -> Any:
    """Return messages as dicts, and sequences of any class as lists."""
    if hasattr(value, "get_fields_and_field_types"):
        return {name: fields(getattr(value, name)) for name in value.get_fields_and_field_types()}
    if isinstance(value, (bytes, bytearray, memoryview, array.array)):
        return list(value)
    if hasattr(value, "tolist"):  # an array or a number of numpy
        return value.tolist()
    return [fields(item) for item in value] if isinstance(value, (list, tuple)) else value
