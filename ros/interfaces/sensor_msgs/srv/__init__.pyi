"""Types of sensor_msgs.srv; generated."""

import sensor_msgs.msg
import service_msgs.msg
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "SetCameraInfo",
]

class SetCameraInfo_Request(Message):
    camera_info: sensor_msgs.msg.CameraInfo
    def __init__(
        self,
        *,
        camera_info: sensor_msgs.msg.CameraInfo = ...,
        check_fields: bool = ...,
    ) -> None: ...

class SetCameraInfo_Response(Message):
    success: bool
    status_message: str
    def __init__(
        self,
        *,
        success: bool = ...,
        status_message: str = ...,
        check_fields: bool = ...,
    ) -> None: ...

class SetCameraInfo_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[SetCameraInfo_Request]
    response: list[SetCameraInfo_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[SetCameraInfo_Request] = ...,
        response: list[SetCameraInfo_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class SetCameraInfo(Service[SetCameraInfo_Request, SetCameraInfo_Response]):
    Request: TypeAlias = SetCameraInfo_Request
    Response: TypeAlias = SetCameraInfo_Response
    Event: TypeAlias = SetCameraInfo_Event
