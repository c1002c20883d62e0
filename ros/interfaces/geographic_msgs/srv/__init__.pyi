"""Types of geographic_msgs.srv; generated."""

import geographic_msgs.msg
import service_msgs.msg
import unique_identifier_msgs.msg
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "GetGeoPath",
    "GetGeographicMap",
    "GetRoutePlan",
    "UpdateGeographicMap",
]

class GetGeoPath_Request(Message):
    start: geographic_msgs.msg.GeoPoint
    goal: geographic_msgs.msg.GeoPoint
    def __init__(
        self,
        *,
        start: geographic_msgs.msg.GeoPoint = ...,
        goal: geographic_msgs.msg.GeoPoint = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GetGeoPath_Response(Message):
    success: bool
    status: str
    plan: geographic_msgs.msg.GeoPath
    network: unique_identifier_msgs.msg.UUID
    start_seg: unique_identifier_msgs.msg.UUID
    goal_seg: unique_identifier_msgs.msg.UUID
    distance: float
    def __init__(
        self,
        *,
        success: bool = ...,
        status: str = ...,
        plan: geographic_msgs.msg.GeoPath = ...,
        network: unique_identifier_msgs.msg.UUID = ...,
        start_seg: unique_identifier_msgs.msg.UUID = ...,
        goal_seg: unique_identifier_msgs.msg.UUID = ...,
        distance: float = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GetGeoPath_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[GetGeoPath_Request]
    response: list[GetGeoPath_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[GetGeoPath_Request] = ...,
        response: list[GetGeoPath_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GetGeoPath(Service[GetGeoPath_Request, GetGeoPath_Response]):
    Request: TypeAlias = GetGeoPath_Request
    Response: TypeAlias = GetGeoPath_Response
    Event: TypeAlias = GetGeoPath_Event

class GetGeographicMap_Request(Message):
    url: str
    bounds: geographic_msgs.msg.BoundingBox
    def __init__(
        self,
        *,
        url: str = ...,
        bounds: geographic_msgs.msg.BoundingBox = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GetGeographicMap_Response(Message):
    success: bool
    status: str
    map: geographic_msgs.msg.GeographicMap
    def __init__(
        self,
        *,
        success: bool = ...,
        status: str = ...,
        map: geographic_msgs.msg.GeographicMap = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GetGeographicMap_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[GetGeographicMap_Request]
    response: list[GetGeographicMap_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[GetGeographicMap_Request] = ...,
        response: list[GetGeographicMap_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GetGeographicMap(Service[GetGeographicMap_Request, GetGeographicMap_Response]):
    Request: TypeAlias = GetGeographicMap_Request
    Response: TypeAlias = GetGeographicMap_Response
    Event: TypeAlias = GetGeographicMap_Event

class GetRoutePlan_Request(Message):
    network: unique_identifier_msgs.msg.UUID
    start: unique_identifier_msgs.msg.UUID
    goal: unique_identifier_msgs.msg.UUID
    def __init__(
        self,
        *,
        network: unique_identifier_msgs.msg.UUID = ...,
        start: unique_identifier_msgs.msg.UUID = ...,
        goal: unique_identifier_msgs.msg.UUID = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GetRoutePlan_Response(Message):
    success: bool
    status: str
    plan: geographic_msgs.msg.RoutePath
    def __init__(
        self,
        *,
        success: bool = ...,
        status: str = ...,
        plan: geographic_msgs.msg.RoutePath = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GetRoutePlan_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[GetRoutePlan_Request]
    response: list[GetRoutePlan_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[GetRoutePlan_Request] = ...,
        response: list[GetRoutePlan_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GetRoutePlan(Service[GetRoutePlan_Request, GetRoutePlan_Response]):
    Request: TypeAlias = GetRoutePlan_Request
    Response: TypeAlias = GetRoutePlan_Response
    Event: TypeAlias = GetRoutePlan_Event

class UpdateGeographicMap_Request(Message):
    updates: geographic_msgs.msg.GeographicMapChanges
    def __init__(
        self,
        *,
        updates: geographic_msgs.msg.GeographicMapChanges = ...,
        check_fields: bool = ...,
    ) -> None: ...

class UpdateGeographicMap_Response(Message):
    success: bool
    status: str
    def __init__(
        self,
        *,
        success: bool = ...,
        status: str = ...,
        check_fields: bool = ...,
    ) -> None: ...

class UpdateGeographicMap_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[UpdateGeographicMap_Request]
    response: list[UpdateGeographicMap_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[UpdateGeographicMap_Request] = ...,
        response: list[UpdateGeographicMap_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class UpdateGeographicMap(Service[UpdateGeographicMap_Request, UpdateGeographicMap_Response]):
    Request: TypeAlias = UpdateGeographicMap_Request
    Response: TypeAlias = UpdateGeographicMap_Response
    Event: TypeAlias = UpdateGeographicMap_Event
