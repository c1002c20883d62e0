"""Types of map_msgs.msg; generated."""

import array
import nav_msgs.msg
import sensor_msgs.msg
import std_msgs.msg
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "OccupancyGridUpdate",
    "PointCloud2Update",
    "ProjectedMap",
    "ProjectedMapInfo",
]

class OccupancyGridUpdate(Message):
    header: std_msgs.msg.Header
    x: int
    y: int
    width: int
    height: int
    @property
    def data(self) -> array.array[int]: ...
    @data.setter
    def data(self, value: Iterable[int]) -> None: ...
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        x: int = ...,
        y: int = ...,
        width: int = ...,
        height: int = ...,
        data: Iterable[int] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class PointCloud2Update(Message):
    ADD: ClassVar[int]
    DELETE: ClassVar[int]
    header: std_msgs.msg.Header
    type: int
    points: sensor_msgs.msg.PointCloud2
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        type: int = ...,
        points: sensor_msgs.msg.PointCloud2 = ...,
        check_fields: bool = ...,
    ) -> None: ...

class ProjectedMap(Message):
    map: nav_msgs.msg.OccupancyGrid
    min_z: float
    max_z: float
    def __init__(
        self,
        *,
        map: nav_msgs.msg.OccupancyGrid = ...,
        min_z: float = ...,
        max_z: float = ...,
        check_fields: bool = ...,
    ) -> None: ...

class ProjectedMapInfo(Message):
    frame_id: str
    x: float
    y: float
    width: float
    height: float
    min_z: float
    max_z: float
    def __init__(
        self,
        *,
        frame_id: str = ...,
        x: float = ...,
        y: float = ...,
        width: float = ...,
        height: float = ...,
        min_z: float = ...,
        max_z: float = ...,
        check_fields: bool = ...,
    ) -> None: ...
