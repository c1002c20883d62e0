"""Types of nav_msgs.srv; generated."""

import geometry_msgs.msg
import nav_msgs.msg
import service_msgs.msg
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "GetMap",
    "GetPlan",
    "LoadMap",
    "SetMap",
]

class GetMap_Request(Message):
    def __init__(self, *, check_fields: bool = ...) -> None: ...

class GetMap_Response(Message):
    map: nav_msgs.msg.OccupancyGrid
    def __init__(
        self,
        *,
        map: nav_msgs.msg.OccupancyGrid = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GetMap_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[GetMap_Request]
    response: list[GetMap_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[GetMap_Request] = ...,
        response: list[GetMap_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GetMap(Service[GetMap_Request, GetMap_Response]):
    Request: TypeAlias = GetMap_Request
    Response: TypeAlias = GetMap_Response
    Event: TypeAlias = GetMap_Event

class GetPlan_Request(Message):
    start: geometry_msgs.msg.PoseStamped
    goal: geometry_msgs.msg.PoseStamped
    tolerance: float
    def __init__(
        self,
        *,
        start: geometry_msgs.msg.PoseStamped = ...,
        goal: geometry_msgs.msg.PoseStamped = ...,
        tolerance: float = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GetPlan_Response(Message):
    plan: nav_msgs.msg.Path
    def __init__(self, *, plan: nav_msgs.msg.Path = ..., check_fields: bool = ...) -> None: ...

class GetPlan_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[GetPlan_Request]
    response: list[GetPlan_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[GetPlan_Request] = ...,
        response: list[GetPlan_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GetPlan(Service[GetPlan_Request, GetPlan_Response]):
    Request: TypeAlias = GetPlan_Request
    Response: TypeAlias = GetPlan_Response
    Event: TypeAlias = GetPlan_Event

class LoadMap_Request(Message):
    map_url: str
    def __init__(self, *, map_url: str = ..., check_fields: bool = ...) -> None: ...

class LoadMap_Response(Message):
    RESULT_SUCCESS: ClassVar[int]
    RESULT_MAP_DOES_NOT_EXIST: ClassVar[int]
    RESULT_INVALID_MAP_DATA: ClassVar[int]
    RESULT_INVALID_MAP_METADATA: ClassVar[int]
    RESULT_UNDEFINED_FAILURE: ClassVar[int]
    map: nav_msgs.msg.OccupancyGrid
    result: int
    def __init__(
        self,
        *,
        map: nav_msgs.msg.OccupancyGrid = ...,
        result: int = ...,
        check_fields: bool = ...,
    ) -> None: ...

class LoadMap_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[LoadMap_Request]
    response: list[LoadMap_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[LoadMap_Request] = ...,
        response: list[LoadMap_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class LoadMap(Service[LoadMap_Request, LoadMap_Response]):
    Request: TypeAlias = LoadMap_Request
    Response: TypeAlias = LoadMap_Response
    Event: TypeAlias = LoadMap_Event

class SetMap_Request(Message):
    map: nav_msgs.msg.OccupancyGrid
    initial_pose: geometry_msgs.msg.PoseWithCovarianceStamped
    def __init__(
        self,
        *,
        map: nav_msgs.msg.OccupancyGrid = ...,
        initial_pose: geometry_msgs.msg.PoseWithCovarianceStamped = ...,
        check_fields: bool = ...,
    ) -> None: ...

class SetMap_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ..., check_fields: bool = ...) -> None: ...

class SetMap_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[SetMap_Request]
    response: list[SetMap_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[SetMap_Request] = ...,
        response: list[SetMap_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class SetMap(Service[SetMap_Request, SetMap_Response]):
    Request: TypeAlias = SetMap_Request
    Response: TypeAlias = SetMap_Response
    Event: TypeAlias = SetMap_Event
