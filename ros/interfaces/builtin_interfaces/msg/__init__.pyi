"""Types of builtin_interfaces.msg; generated."""

from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "Duration",
    "Time",
]

class Duration(Message):
    sec: int
    nanosec: int
    def __init__(self, *, sec: int = ..., nanosec: int = ..., check_fields: bool = ...) -> None: ...

class Time(Message):
    sec: int
    nanosec: int
    def __init__(self, *, sec: int = ..., nanosec: int = ..., check_fields: bool = ...) -> None: ...
