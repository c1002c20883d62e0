"""Types of unique_identifier_msgs.msg; generated."""

import numpy
import numpy.typing
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "UUID",
]

class UUID(Message):
    @property
    def uuid(self) -> numpy.typing.NDArray[numpy.uint8]: ...
    @uuid.setter
    def uuid(self, value: Iterable[Any]) -> None: ...
    def __init__(self, *, uuid: Iterable[Any] = ..., check_fields: bool = ...) -> None: ...
