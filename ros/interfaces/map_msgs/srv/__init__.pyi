"""Types of map_msgs.srv; generated."""

import map_msgs.msg
import nav_msgs.msg
import sensor_msgs.msg
import service_msgs.msg
import std_msgs.msg
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "GetMapROI",
    "GetPointMap",
    "GetPointMapROI",
    "ProjectedMapsInfo",
    "SaveMap",
    "SetMapProjections",
]

class GetMapROI_Request(Message):
    x: float
    y: float
    l_x: float
    l_y: float
    def __init__(
        self,
        *,
        x: float = ...,
        y: float = ...,
        l_x: float = ...,
        l_y: float = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GetMapROI_Response(Message):
    sub_map: nav_msgs.msg.OccupancyGrid
    def __init__(
        self,
        *,
        sub_map: nav_msgs.msg.OccupancyGrid = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GetMapROI_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[GetMapROI_Request]
    response: list[GetMapROI_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[GetMapROI_Request] = ...,
        response: list[GetMapROI_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GetMapROI(Service[GetMapROI_Request, GetMapROI_Response]):
    Request: TypeAlias = GetMapROI_Request
    Response: TypeAlias = GetMapROI_Response
    Event: TypeAlias = GetMapROI_Event

class GetPointMap_Request(Message):
    def __init__(self, *, check_fields: bool = ...) -> None: ...

class GetPointMap_Response(Message):
    map: sensor_msgs.msg.PointCloud2
    def __init__(
        self,
        *,
        map: sensor_msgs.msg.PointCloud2 = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GetPointMap_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[GetPointMap_Request]
    response: list[GetPointMap_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[GetPointMap_Request] = ...,
        response: list[GetPointMap_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GetPointMap(Service[GetPointMap_Request, GetPointMap_Response]):
    Request: TypeAlias = GetPointMap_Request
    Response: TypeAlias = GetPointMap_Response
    Event: TypeAlias = GetPointMap_Event

class GetPointMapROI_Request(Message):
    x: float
    y: float
    z: float
    r: float
    l_x: float
    l_y: float
    l_z: float
    def __init__(
        self,
        *,
        x: float = ...,
        y: float = ...,
        z: float = ...,
        r: float = ...,
        l_x: float = ...,
        l_y: float = ...,
        l_z: float = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GetPointMapROI_Response(Message):
    sub_map: sensor_msgs.msg.PointCloud2
    def __init__(
        self,
        *,
        sub_map: sensor_msgs.msg.PointCloud2 = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GetPointMapROI_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[GetPointMapROI_Request]
    response: list[GetPointMapROI_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[GetPointMapROI_Request] = ...,
        response: list[GetPointMapROI_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GetPointMapROI(Service[GetPointMapROI_Request, GetPointMapROI_Response]):
    Request: TypeAlias = GetPointMapROI_Request
    Response: TypeAlias = GetPointMapROI_Response
    Event: TypeAlias = GetPointMapROI_Event

class ProjectedMapsInfo_Request(Message):
    projected_maps_info: list[map_msgs.msg.ProjectedMapInfo]
    def __init__(
        self,
        *,
        projected_maps_info: list[map_msgs.msg.ProjectedMapInfo] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class ProjectedMapsInfo_Response(Message):
    def __init__(self, *, check_fields: bool = ...) -> None: ...

class ProjectedMapsInfo_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[ProjectedMapsInfo_Request]
    response: list[ProjectedMapsInfo_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[ProjectedMapsInfo_Request] = ...,
        response: list[ProjectedMapsInfo_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class ProjectedMapsInfo(Service[ProjectedMapsInfo_Request, ProjectedMapsInfo_Response]):
    Request: TypeAlias = ProjectedMapsInfo_Request
    Response: TypeAlias = ProjectedMapsInfo_Response
    Event: TypeAlias = ProjectedMapsInfo_Event

class SaveMap_Request(Message):
    filename: std_msgs.msg.String
    def __init__(
        self,
        *,
        filename: std_msgs.msg.String = ...,
        check_fields: bool = ...,
    ) -> None: ...

class SaveMap_Response(Message):
    def __init__(self, *, check_fields: bool = ...) -> None: ...

class SaveMap_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[SaveMap_Request]
    response: list[SaveMap_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[SaveMap_Request] = ...,
        response: list[SaveMap_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class SaveMap(Service[SaveMap_Request, SaveMap_Response]):
    Request: TypeAlias = SaveMap_Request
    Response: TypeAlias = SaveMap_Response
    Event: TypeAlias = SaveMap_Event

class SetMapProjections_Request(Message):
    def __init__(self, *, check_fields: bool = ...) -> None: ...

class SetMapProjections_Response(Message):
    projected_maps_info: list[map_msgs.msg.ProjectedMapInfo]
    def __init__(
        self,
        *,
        projected_maps_info: list[map_msgs.msg.ProjectedMapInfo] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class SetMapProjections_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[SetMapProjections_Request]
    response: list[SetMapProjections_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[SetMapProjections_Request] = ...,
        response: list[SetMapProjections_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class SetMapProjections(Service[SetMapProjections_Request, SetMapProjections_Response]):
    Request: TypeAlias = SetMapProjections_Request
    Response: TypeAlias = SetMapProjections_Response
    Event: TypeAlias = SetMapProjections_Event
