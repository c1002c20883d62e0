"""Types of geographic_msgs.msg; generated."""

import geometry_msgs.msg
import numpy
import numpy.typing
import std_msgs.msg
import unique_identifier_msgs.msg
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "BoundingBox",
    "GeoPath",
    "GeoPoint",
    "GeoPointStamped",
    "GeoPose",
    "GeoPoseStamped",
    "GeoPoseWithCovariance",
    "GeoPoseWithCovarianceStamped",
    "GeographicMap",
    "GeographicMapChanges",
    "KeyValue",
    "MapFeature",
    "RouteNetwork",
    "RoutePath",
    "RouteSegment",
    "WayPoint",
]

class BoundingBox(Message):
    min_pt: GeoPoint
    max_pt: GeoPoint
    def __init__(
        self,
        *,
        min_pt: GeoPoint = ...,
        max_pt: GeoPoint = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GeoPath(Message):
    header: std_msgs.msg.Header
    poses: list[GeoPoseStamped]
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        poses: list[GeoPoseStamped] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GeoPoint(Message):
    latitude: float
    longitude: float
    altitude: float
    def __init__(
        self,
        *,
        latitude: float = ...,
        longitude: float = ...,
        altitude: float = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GeoPointStamped(Message):
    header: std_msgs.msg.Header
    position: GeoPoint
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        position: GeoPoint = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GeoPose(Message):
    position: GeoPoint
    orientation: geometry_msgs.msg.Quaternion
    def __init__(
        self,
        *,
        position: GeoPoint = ...,
        orientation: geometry_msgs.msg.Quaternion = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GeoPoseStamped(Message):
    header: std_msgs.msg.Header
    pose: GeoPose
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        pose: GeoPose = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GeoPoseWithCovariance(Message):
    pose: GeoPose
    @property
    def covariance(self) -> numpy.typing.NDArray[numpy.float64]: ...
    @covariance.setter
    def covariance(self, value: Iterable[Any]) -> None: ...
    def __init__(
        self,
        *,
        pose: GeoPose = ...,
        covariance: Iterable[Any] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GeoPoseWithCovarianceStamped(Message):
    header: std_msgs.msg.Header
    pose: GeoPoseWithCovariance
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        pose: GeoPoseWithCovariance = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GeographicMap(Message):
    header: std_msgs.msg.Header
    id: unique_identifier_msgs.msg.UUID
    bounds: BoundingBox
    points: list[WayPoint]
    features: list[MapFeature]
    props: list[KeyValue]
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        id: unique_identifier_msgs.msg.UUID = ...,
        bounds: BoundingBox = ...,
        points: list[WayPoint] = ...,
        features: list[MapFeature] = ...,
        props: list[KeyValue] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GeographicMapChanges(Message):
    header: std_msgs.msg.Header
    diffs: GeographicMap
    deletes: list[unique_identifier_msgs.msg.UUID]
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        diffs: GeographicMap = ...,
        deletes: list[unique_identifier_msgs.msg.UUID] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class KeyValue(Message):
    key: str
    value: str
    def __init__(self, *, key: str = ..., value: str = ..., check_fields: bool = ...) -> None: ...

class MapFeature(Message):
    id: unique_identifier_msgs.msg.UUID
    components: list[unique_identifier_msgs.msg.UUID]
    props: list[KeyValue]
    def __init__(
        self,
        *,
        id: unique_identifier_msgs.msg.UUID = ...,
        components: list[unique_identifier_msgs.msg.UUID] = ...,
        props: list[KeyValue] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class RouteNetwork(Message):
    header: std_msgs.msg.Header
    id: unique_identifier_msgs.msg.UUID
    bounds: BoundingBox
    points: list[WayPoint]
    segments: list[RouteSegment]
    props: list[KeyValue]
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        id: unique_identifier_msgs.msg.UUID = ...,
        bounds: BoundingBox = ...,
        points: list[WayPoint] = ...,
        segments: list[RouteSegment] = ...,
        props: list[KeyValue] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class RoutePath(Message):
    header: std_msgs.msg.Header
    network: unique_identifier_msgs.msg.UUID
    segments: list[unique_identifier_msgs.msg.UUID]
    props: list[KeyValue]
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        network: unique_identifier_msgs.msg.UUID = ...,
        segments: list[unique_identifier_msgs.msg.UUID] = ...,
        props: list[KeyValue] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class RouteSegment(Message):
    id: unique_identifier_msgs.msg.UUID
    start: unique_identifier_msgs.msg.UUID
    end: unique_identifier_msgs.msg.UUID
    props: list[KeyValue]
    def __init__(
        self,
        *,
        id: unique_identifier_msgs.msg.UUID = ...,
        start: unique_identifier_msgs.msg.UUID = ...,
        end: unique_identifier_msgs.msg.UUID = ...,
        props: list[KeyValue] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class WayPoint(Message):
    id: unique_identifier_msgs.msg.UUID
    position: GeoPoint
    props: list[KeyValue]
    def __init__(
        self,
        *,
        id: unique_identifier_msgs.msg.UUID = ...,
        position: GeoPoint = ...,
        props: list[KeyValue] = ...,
        check_fields: bool = ...,
    ) -> None: ...
