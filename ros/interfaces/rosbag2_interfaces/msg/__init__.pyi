"""Types of rosbag2_interfaces.msg; generated."""

from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "ReadSplitEvent",
    "WriteSplitEvent",
]

class ReadSplitEvent(Message):
    closed_file: str
    opened_file: str
    node_name: str
    def __init__(
        self,
        *,
        closed_file: str = ...,
        opened_file: str = ...,
        node_name: str = ...,
        check_fields: bool = ...,
    ) -> None: ...

class WriteSplitEvent(Message):
    closed_file: str
    opened_file: str
    node_name: str
    def __init__(
        self,
        *,
        closed_file: str = ...,
        opened_file: str = ...,
        node_name: str = ...,
        check_fields: bool = ...,
    ) -> None: ...
