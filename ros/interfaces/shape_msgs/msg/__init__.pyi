"""Types of shape_msgs.msg; generated."""

import array
import geometry_msgs.msg
import numpy
import numpy.typing
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "Mesh",
    "MeshTriangle",
    "Plane",
    "SolidPrimitive",
]

class Mesh(Message):
    triangles: list[MeshTriangle]
    vertices: list[geometry_msgs.msg.Point]
    def __init__(
        self,
        *,
        triangles: list[MeshTriangle] = ...,
        vertices: list[geometry_msgs.msg.Point] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class MeshTriangle(Message):
    @property
    def vertex_indices(self) -> numpy.typing.NDArray[numpy.uint32]: ...
    @vertex_indices.setter
    def vertex_indices(self, value: Iterable[Any]) -> None: ...
    def __init__(
        self,
        *,
        vertex_indices: Iterable[Any] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Plane(Message):
    @property
    def coef(self) -> numpy.typing.NDArray[numpy.float64]: ...
    @coef.setter
    def coef(self, value: Iterable[Any]) -> None: ...
    def __init__(self, *, coef: Iterable[Any] = ..., check_fields: bool = ...) -> None: ...

class SolidPrimitive(Message):
    BOX: ClassVar[int]
    SPHERE: ClassVar[int]
    CYLINDER: ClassVar[int]
    CONE: ClassVar[int]
    PRISM: ClassVar[int]
    BOX_X: ClassVar[int]
    BOX_Y: ClassVar[int]
    BOX_Z: ClassVar[int]
    SPHERE_RADIUS: ClassVar[int]
    CYLINDER_HEIGHT: ClassVar[int]
    CYLINDER_RADIUS: ClassVar[int]
    CONE_HEIGHT: ClassVar[int]
    CONE_RADIUS: ClassVar[int]
    PRISM_HEIGHT: ClassVar[int]
    type: int
    @property
    def dimensions(self) -> array.array[float]: ...
    @dimensions.setter
    def dimensions(self, value: Iterable[float]) -> None: ...
    polygon: geometry_msgs.msg.Polygon
    def __init__(
        self,
        *,
        type: int = ...,
        dimensions: Iterable[float] = ...,
        polygon: geometry_msgs.msg.Polygon = ...,
        check_fields: bool = ...,
    ) -> None: ...
