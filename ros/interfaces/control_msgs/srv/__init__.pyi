"""Types of control_msgs.srv; generated."""

import array
import builtin_interfaces.msg
import service_msgs.msg
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "QueryCalibrationState",
    "QueryTrajectoryState",
]

class QueryCalibrationState_Request(Message):
    def __init__(self, *, check_fields: bool = ...) -> None: ...

class QueryCalibrationState_Response(Message):
    is_calibrated: bool
    def __init__(self, *, is_calibrated: bool = ..., check_fields: bool = ...) -> None: ...

class QueryCalibrationState_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[QueryCalibrationState_Request]
    response: list[QueryCalibrationState_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[QueryCalibrationState_Request] = ...,
        response: list[QueryCalibrationState_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class QueryCalibrationState(Service[QueryCalibrationState_Request, QueryCalibrationState_Response]):
    Request: TypeAlias = QueryCalibrationState_Request
    Response: TypeAlias = QueryCalibrationState_Response
    Event: TypeAlias = QueryCalibrationState_Event

class QueryTrajectoryState_Request(Message):
    time: builtin_interfaces.msg.Time
    def __init__(
        self,
        *,
        time: builtin_interfaces.msg.Time = ...,
        check_fields: bool = ...,
    ) -> None: ...

class QueryTrajectoryState_Response(Message):
    success: bool
    message: str
    name: list[str]
    @property
    def position(self) -> array.array[float]: ...
    @position.setter
    def position(self, value: Iterable[float]) -> None: ...
    @property
    def velocity(self) -> array.array[float]: ...
    @velocity.setter
    def velocity(self, value: Iterable[float]) -> None: ...
    @property
    def acceleration(self) -> array.array[float]: ...
    @acceleration.setter
    def acceleration(self, value: Iterable[float]) -> None: ...
    def __init__(
        self,
        *,
        success: bool = ...,
        message: str = ...,
        name: list[str] = ...,
        position: Iterable[float] = ...,
        velocity: Iterable[float] = ...,
        acceleration: Iterable[float] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class QueryTrajectoryState_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[QueryTrajectoryState_Request]
    response: list[QueryTrajectoryState_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[QueryTrajectoryState_Request] = ...,
        response: list[QueryTrajectoryState_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class QueryTrajectoryState(Service[QueryTrajectoryState_Request, QueryTrajectoryState_Response]):
    Request: TypeAlias = QueryTrajectoryState_Request
    Response: TypeAlias = QueryTrajectoryState_Response
    Event: TypeAlias = QueryTrajectoryState_Event
