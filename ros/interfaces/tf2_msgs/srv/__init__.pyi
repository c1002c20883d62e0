"""Types of tf2_msgs.srv; generated."""

import service_msgs.msg
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "FrameGraph",
]

class FrameGraph_Request(Message):
    def __init__(self, *, check_fields: bool = ...) -> None: ...

class FrameGraph_Response(Message):
    frame_yaml: str
    def __init__(self, *, frame_yaml: str = ..., check_fields: bool = ...) -> None: ...

class FrameGraph_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[FrameGraph_Request]
    response: list[FrameGraph_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[FrameGraph_Request] = ...,
        response: list[FrameGraph_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class FrameGraph(Service[FrameGraph_Request, FrameGraph_Response]):
    Request: TypeAlias = FrameGraph_Request
    Response: TypeAlias = FrameGraph_Response
    Event: TypeAlias = FrameGraph_Event
