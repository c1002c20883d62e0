"""Types of diagnostic_msgs.msg; generated."""

import std_msgs.msg
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "DiagnosticArray",
    "DiagnosticStatus",
    "KeyValue",
]

class DiagnosticArray(Message):
    header: std_msgs.msg.Header
    status: list[DiagnosticStatus]
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        status: list[DiagnosticStatus] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class DiagnosticStatus(Message):
    OK: ClassVar[bytes]
    WARN: ClassVar[bytes]
    ERROR: ClassVar[bytes]
    STALE: ClassVar[bytes]
    level: bytes
    name: str
    message: str
    hardware_id: str
    values: list[KeyValue]
    def __init__(
        self,
        *,
        level: bytes = ...,
        name: str = ...,
        message: str = ...,
        hardware_id: str = ...,
        values: list[KeyValue] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class KeyValue(Message):
    key: str
    value: str
    def __init__(self, *, key: str = ..., value: str = ..., check_fields: bool = ...) -> None: ...
