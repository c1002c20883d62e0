"""Types of visualization_msgs.srv; generated."""

import service_msgs.msg
import visualization_msgs.msg
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "GetInteractiveMarkers",
]

class GetInteractiveMarkers_Request(Message):
    def __init__(self, *, check_fields: bool = ...) -> None: ...

class GetInteractiveMarkers_Response(Message):
    sequence_number: int
    markers: list[visualization_msgs.msg.InteractiveMarker]
    def __init__(
        self,
        *,
        sequence_number: int = ...,
        markers: list[visualization_msgs.msg.InteractiveMarker] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GetInteractiveMarkers_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[GetInteractiveMarkers_Request]
    response: list[GetInteractiveMarkers_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[GetInteractiveMarkers_Request] = ...,
        response: list[GetInteractiveMarkers_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GetInteractiveMarkers(Service[GetInteractiveMarkers_Request, GetInteractiveMarkers_Response]):
    Request: TypeAlias = GetInteractiveMarkers_Request
    Response: TypeAlias = GetInteractiveMarkers_Response
    Event: TypeAlias = GetInteractiveMarkers_Event
