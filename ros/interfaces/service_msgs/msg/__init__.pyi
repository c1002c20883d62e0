"""Types of service_msgs.msg; generated."""

import builtin_interfaces.msg
import numpy
import numpy.typing
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "ServiceEventInfo",
]

class ServiceEventInfo(Message):
    REQUEST_SENT: ClassVar[int]
    REQUEST_RECEIVED: ClassVar[int]
    RESPONSE_SENT: ClassVar[int]
    RESPONSE_RECEIVED: ClassVar[int]
    event_type: int
    stamp: builtin_interfaces.msg.Time
    @property
    def client_gid(self) -> numpy.typing.NDArray[numpy.uint8]: ...
    @client_gid.setter
    def client_gid(self, value: Iterable[Any]) -> None: ...
    sequence_number: int
    def __init__(
        self,
        *,
        event_type: int = ...,
        stamp: builtin_interfaces.msg.Time = ...,
        client_gid: Iterable[Any] = ...,
        sequence_number: int = ...,
        check_fields: bool = ...,
    ) -> None: ...
