"""Turn definitions of messages from ROS 1 into definitions of ROS 2.

``time``, ``duration`` and ``Header`` become ROS 2's types, and strings get quotes. Names stay as
they are, except the names of constants, which ROS 2 demands in capitals.
"""

from __future__ import annotations

import re

from turtlewire.msg.parser import without_comment

__all__ = ["ros2_definition"]

_STATEMENT = re.compile(r"\s*([\w/]+)(\[\d*\])?\s+(\w+)\s*(=?)(.*)")
_TYPES = {
    "time": "builtin_interfaces/Time",
    "duration": "builtin_interfaces/Duration",
    "Header": "std_msgs/Header",
}


def ros2_definition(text: str) -> str:
    """Return a definition of ROS 1, with the types that it uses, in the words of ROS 2."""
    return "\n".join(_line(line) for line in text.splitlines())


def _line(line: str) -> str:
    found = _STATEMENT.fullmatch(line)
    if found is None or line.lstrip().startswith("#"):
        return line
    type_, array, name, equals, value = found.groups()
    type_ = _TYPES.get(type_, type_)
    if not equals:
        return f"{type_}{array or ''} {name}"
    if type_ == "string":  # the value is the rest of the line, including '#'
        quoted = value.strip().replace("\\", "\\\\").replace('"', '\\"')
        return f'string {name.upper()}="{quoted}"'
    value = without_comment(value).strip()
    if type_ in ("byte", "char") and re.fullmatch(r"-\d+", value):  # bytes have signs in ROS 1
        value = f"{256 + int(value)}"
    return f"{type_} {name.upper()}={value}"
