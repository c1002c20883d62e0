"""Types of foxglove_msgs.msg; generated."""

import array
import builtin_interfaces.msg
import geometry_msgs.msg
import numpy
import numpy.typing
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "ArrowPrimitive",
    "CameraCalibration",
    "CircleAnnotation",
    "Color",
    "CompressedAudio",
    "CompressedImage",
    "CompressedPointCloud",
    "CompressedVideo",
    "CubePrimitive",
    "CylinderPrimitive",
    "FrameTransform",
    "FrameTransforms",
    "GeoJSON",
    "Grid",
    "ImageAnnotations",
    "JointState",
    "JointStates",
    "KeyValuePair",
    "LaserScan",
    "LinePrimitive",
    "LocationFix",
    "LocationFixes",
    "Log",
    "ModelPrimitive",
    "Odometry",
    "PackedElementField",
    "Point2",
    "PointCloud",
    "PointsAnnotation",
    "PoseInFrame",
    "PosesInFrame",
    "RawAudio",
    "RawImage",
    "SceneEntity",
    "SceneEntityDeletion",
    "SceneUpdate",
    "SpherePrimitive",
    "TextAnnotation",
    "TextPrimitive",
    "TriangleListPrimitive",
    "Vector2",
    "VoxelGrid",
]

class ArrowPrimitive(Message):
    pose: geometry_msgs.msg.Pose
    shaft_length: float
    shaft_diameter: float
    head_length: float
    head_diameter: float
    color: Color
    def __init__(
        self,
        *,
        pose: geometry_msgs.msg.Pose = ...,
        shaft_length: float = ...,
        shaft_diameter: float = ...,
        head_length: float = ...,
        head_diameter: float = ...,
        color: Color = ...,
        check_fields: bool = ...,
    ) -> None: ...

class CameraCalibration(Message):
    timestamp: builtin_interfaces.msg.Time
    frame_id: str
    width: int
    height: int
    distortion_model: str
    @property
    def d(self) -> array.array[float]: ...
    @d.setter
    def d(self, value: Iterable[float]) -> None: ...
    @property
    def k(self) -> numpy.typing.NDArray[numpy.float64]: ...
    @k.setter
    def k(self, value: Iterable[Any]) -> None: ...
    @property
    def r(self) -> numpy.typing.NDArray[numpy.float64]: ...
    @r.setter
    def r(self, value: Iterable[Any]) -> None: ...
    @property
    def p(self) -> numpy.typing.NDArray[numpy.float64]: ...
    @p.setter
    def p(self, value: Iterable[Any]) -> None: ...
    def __init__(
        self,
        *,
        timestamp: builtin_interfaces.msg.Time = ...,
        frame_id: str = ...,
        width: int = ...,
        height: int = ...,
        distortion_model: str = ...,
        d: Iterable[float] = ...,
        k: Iterable[Any] = ...,
        r: Iterable[Any] = ...,
        p: Iterable[Any] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class CircleAnnotation(Message):
    timestamp: builtin_interfaces.msg.Time
    position: Point2
    diameter: float
    thickness: float
    fill_color: Color
    outline_color: Color
    metadata: list[KeyValuePair]
    def __init__(
        self,
        *,
        timestamp: builtin_interfaces.msg.Time = ...,
        position: Point2 = ...,
        diameter: float = ...,
        thickness: float = ...,
        fill_color: Color = ...,
        outline_color: Color = ...,
        metadata: list[KeyValuePair] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Color(Message):
    r: float
    g: float
    b: float
    a: float
    def __init__(
        self,
        *,
        r: float = ...,
        g: float = ...,
        b: float = ...,
        a: float = ...,
        check_fields: bool = ...,
    ) -> None: ...

class CompressedAudio(Message):
    timestamp: builtin_interfaces.msg.Time
    @property
    def data(self) -> array.array[int]: ...
    @data.setter
    def data(self, value: Iterable[int]) -> None: ...
    format: str
    def __init__(
        self,
        *,
        timestamp: builtin_interfaces.msg.Time = ...,
        data: Iterable[int] = ...,
        format: str = ...,
        check_fields: bool = ...,
    ) -> None: ...

class CompressedImage(Message):
    timestamp: builtin_interfaces.msg.Time
    frame_id: str
    @property
    def data(self) -> array.array[int]: ...
    @data.setter
    def data(self, value: Iterable[int]) -> None: ...
    format: str
    def __init__(
        self,
        *,
        timestamp: builtin_interfaces.msg.Time = ...,
        frame_id: str = ...,
        data: Iterable[int] = ...,
        format: str = ...,
        check_fields: bool = ...,
    ) -> None: ...

class CompressedPointCloud(Message):
    timestamp: builtin_interfaces.msg.Time
    frame_id: str
    pose: geometry_msgs.msg.Pose
    @property
    def data(self) -> array.array[int]: ...
    @data.setter
    def data(self, value: Iterable[int]) -> None: ...
    format: str
    def __init__(
        self,
        *,
        timestamp: builtin_interfaces.msg.Time = ...,
        frame_id: str = ...,
        pose: geometry_msgs.msg.Pose = ...,
        data: Iterable[int] = ...,
        format: str = ...,
        check_fields: bool = ...,
    ) -> None: ...

class CompressedVideo(Message):
    timestamp: builtin_interfaces.msg.Time
    frame_id: str
    @property
    def data(self) -> array.array[int]: ...
    @data.setter
    def data(self, value: Iterable[int]) -> None: ...
    format: str
    def __init__(
        self,
        *,
        timestamp: builtin_interfaces.msg.Time = ...,
        frame_id: str = ...,
        data: Iterable[int] = ...,
        format: str = ...,
        check_fields: bool = ...,
    ) -> None: ...

class CubePrimitive(Message):
    pose: geometry_msgs.msg.Pose
    size: geometry_msgs.msg.Vector3
    color: Color
    def __init__(
        self,
        *,
        pose: geometry_msgs.msg.Pose = ...,
        size: geometry_msgs.msg.Vector3 = ...,
        color: Color = ...,
        check_fields: bool = ...,
    ) -> None: ...

class CylinderPrimitive(Message):
    pose: geometry_msgs.msg.Pose
    size: geometry_msgs.msg.Vector3
    bottom_scale: float
    top_scale: float
    color: Color
    def __init__(
        self,
        *,
        pose: geometry_msgs.msg.Pose = ...,
        size: geometry_msgs.msg.Vector3 = ...,
        bottom_scale: float = ...,
        top_scale: float = ...,
        color: Color = ...,
        check_fields: bool = ...,
    ) -> None: ...

class FrameTransform(Message):
    timestamp: builtin_interfaces.msg.Time
    parent_frame_id: str
    child_frame_id: str
    translation: geometry_msgs.msg.Vector3
    rotation: geometry_msgs.msg.Quaternion
    def __init__(
        self,
        *,
        timestamp: builtin_interfaces.msg.Time = ...,
        parent_frame_id: str = ...,
        child_frame_id: str = ...,
        translation: geometry_msgs.msg.Vector3 = ...,
        rotation: geometry_msgs.msg.Quaternion = ...,
        check_fields: bool = ...,
    ) -> None: ...

class FrameTransforms(Message):
    transforms: list[FrameTransform]
    def __init__(
        self,
        *,
        transforms: list[FrameTransform] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GeoJSON(Message):
    geojson: str
    def __init__(self, *, geojson: str = ..., check_fields: bool = ...) -> None: ...

class Grid(Message):
    timestamp: builtin_interfaces.msg.Time
    frame_id: str
    pose: geometry_msgs.msg.Pose
    column_count: int
    cell_size: Vector2
    row_stride: int
    cell_stride: int
    fields: list[PackedElementField]
    @property
    def data(self) -> array.array[int]: ...
    @data.setter
    def data(self, value: Iterable[int]) -> None: ...
    def __init__(
        self,
        *,
        timestamp: builtin_interfaces.msg.Time = ...,
        frame_id: str = ...,
        pose: geometry_msgs.msg.Pose = ...,
        column_count: int = ...,
        cell_size: Vector2 = ...,
        row_stride: int = ...,
        cell_stride: int = ...,
        fields: list[PackedElementField] = ...,
        data: Iterable[int] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class ImageAnnotations(Message):
    timestamp: builtin_interfaces.msg.Time
    circles: list[CircleAnnotation]
    points: list[PointsAnnotation]
    texts: list[TextAnnotation]
    metadata: list[KeyValuePair]
    def __init__(
        self,
        *,
        timestamp: builtin_interfaces.msg.Time = ...,
        circles: list[CircleAnnotation] = ...,
        points: list[PointsAnnotation] = ...,
        texts: list[TextAnnotation] = ...,
        metadata: list[KeyValuePair] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class JointState(Message):
    name: str
    position: float
    velocity: float
    acceleration: float
    effort: float
    def __init__(
        self,
        *,
        name: str = ...,
        position: float = ...,
        velocity: float = ...,
        acceleration: float = ...,
        effort: float = ...,
        check_fields: bool = ...,
    ) -> None: ...

class JointStates(Message):
    timestamp: builtin_interfaces.msg.Time
    joints: list[JointState]
    def __init__(
        self,
        *,
        timestamp: builtin_interfaces.msg.Time = ...,
        joints: list[JointState] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class KeyValuePair(Message):
    key: str
    value: str
    def __init__(self, *, key: str = ..., value: str = ..., check_fields: bool = ...) -> None: ...

class LaserScan(Message):
    timestamp: builtin_interfaces.msg.Time
    frame_id: str
    pose: geometry_msgs.msg.Pose
    start_angle: float
    end_angle: float
    @property
    def ranges(self) -> array.array[float]: ...
    @ranges.setter
    def ranges(self, value: Iterable[float]) -> None: ...
    @property
    def intensities(self) -> array.array[float]: ...
    @intensities.setter
    def intensities(self, value: Iterable[float]) -> None: ...
    def __init__(
        self,
        *,
        timestamp: builtin_interfaces.msg.Time = ...,
        frame_id: str = ...,
        pose: geometry_msgs.msg.Pose = ...,
        start_angle: float = ...,
        end_angle: float = ...,
        ranges: Iterable[float] = ...,
        intensities: Iterable[float] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class LinePrimitive(Message):
    LINE_STRIP: ClassVar[int]
    LINE_LOOP: ClassVar[int]
    LINE_LIST: ClassVar[int]
    type: int
    pose: geometry_msgs.msg.Pose
    thickness: float
    scale_invariant: bool
    points: list[geometry_msgs.msg.Point]
    color: Color
    colors: list[Color]
    @property
    def indices(self) -> array.array[int]: ...
    @indices.setter
    def indices(self, value: Iterable[int]) -> None: ...
    def __init__(
        self,
        *,
        type: int = ...,
        pose: geometry_msgs.msg.Pose = ...,
        thickness: float = ...,
        scale_invariant: bool = ...,
        points: list[geometry_msgs.msg.Point] = ...,
        color: Color = ...,
        colors: list[Color] = ...,
        indices: Iterable[int] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class LocationFix(Message):
    UNKNOWN: ClassVar[int]
    APPROXIMATED: ClassVar[int]
    DIAGONAL_KNOWN: ClassVar[int]
    KNOWN: ClassVar[int]
    timestamp: builtin_interfaces.msg.Time
    frame_id: str
    latitude: float
    longitude: float
    altitude: float
    @property
    def position_covariance(self) -> numpy.typing.NDArray[numpy.float64]: ...
    @position_covariance.setter
    def position_covariance(self, value: Iterable[Any]) -> None: ...
    position_covariance_type: int
    heading: float
    velocity: geometry_msgs.msg.Vector3
    color: Color
    metadata: list[KeyValuePair]
    def __init__(
        self,
        *,
        timestamp: builtin_interfaces.msg.Time = ...,
        frame_id: str = ...,
        latitude: float = ...,
        longitude: float = ...,
        altitude: float = ...,
        position_covariance: Iterable[Any] = ...,
        position_covariance_type: int = ...,
        heading: float = ...,
        velocity: geometry_msgs.msg.Vector3 = ...,
        color: Color = ...,
        metadata: list[KeyValuePair] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class LocationFixes(Message):
    fixes: list[LocationFix]
    def __init__(self, *, fixes: list[LocationFix] = ..., check_fields: bool = ...) -> None: ...

class Log(Message):
    UNKNOWN: ClassVar[int]
    DEBUG: ClassVar[int]
    INFO: ClassVar[int]
    WARNING: ClassVar[int]
    ERROR: ClassVar[int]
    FATAL: ClassVar[int]
    timestamp: builtin_interfaces.msg.Time
    level: int
    message: str
    name: str
    file: str
    line: int
    def __init__(
        self,
        *,
        timestamp: builtin_interfaces.msg.Time = ...,
        level: int = ...,
        message: str = ...,
        name: str = ...,
        file: str = ...,
        line: int = ...,
        check_fields: bool = ...,
    ) -> None: ...

class ModelPrimitive(Message):
    pose: geometry_msgs.msg.Pose
    scale: geometry_msgs.msg.Vector3
    color: Color
    override_color: bool
    url: str
    media_type: str
    @property
    def data(self) -> array.array[int]: ...
    @data.setter
    def data(self, value: Iterable[int]) -> None: ...
    def __init__(
        self,
        *,
        pose: geometry_msgs.msg.Pose = ...,
        scale: geometry_msgs.msg.Vector3 = ...,
        color: Color = ...,
        override_color: bool = ...,
        url: str = ...,
        media_type: str = ...,
        data: Iterable[int] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Odometry(Message):
    timestamp: builtin_interfaces.msg.Time
    frame_id: str
    body_frame_id: str
    pose: geometry_msgs.msg.Pose
    linear_velocity: geometry_msgs.msg.Vector3
    angular_velocity: geometry_msgs.msg.Vector3
    @property
    def pose_covariance(self) -> numpy.typing.NDArray[numpy.float64]: ...
    @pose_covariance.setter
    def pose_covariance(self, value: Iterable[Any]) -> None: ...
    @property
    def velocity_covariance(self) -> numpy.typing.NDArray[numpy.float64]: ...
    @velocity_covariance.setter
    def velocity_covariance(self, value: Iterable[Any]) -> None: ...
    metadata: list[KeyValuePair]
    def __init__(
        self,
        *,
        timestamp: builtin_interfaces.msg.Time = ...,
        frame_id: str = ...,
        body_frame_id: str = ...,
        pose: geometry_msgs.msg.Pose = ...,
        linear_velocity: geometry_msgs.msg.Vector3 = ...,
        angular_velocity: geometry_msgs.msg.Vector3 = ...,
        pose_covariance: Iterable[Any] = ...,
        velocity_covariance: Iterable[Any] = ...,
        metadata: list[KeyValuePair] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class PackedElementField(Message):
    UNKNOWN: ClassVar[int]
    UINT8: ClassVar[int]
    INT8: ClassVar[int]
    UINT16: ClassVar[int]
    INT16: ClassVar[int]
    UINT32: ClassVar[int]
    INT32: ClassVar[int]
    FLOAT32: ClassVar[int]
    FLOAT64: ClassVar[int]
    name: str
    offset: int
    type: int
    def __init__(
        self,
        *,
        name: str = ...,
        offset: int = ...,
        type: int = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Point2(Message):
    x: float
    y: float
    def __init__(self, *, x: float = ..., y: float = ..., check_fields: bool = ...) -> None: ...

class PointCloud(Message):
    timestamp: builtin_interfaces.msg.Time
    frame_id: str
    pose: geometry_msgs.msg.Pose
    point_stride: int
    fields: list[PackedElementField]
    @property
    def data(self) -> array.array[int]: ...
    @data.setter
    def data(self, value: Iterable[int]) -> None: ...
    def __init__(
        self,
        *,
        timestamp: builtin_interfaces.msg.Time = ...,
        frame_id: str = ...,
        pose: geometry_msgs.msg.Pose = ...,
        point_stride: int = ...,
        fields: list[PackedElementField] = ...,
        data: Iterable[int] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class PointsAnnotation(Message):
    UNKNOWN: ClassVar[int]
    POINTS: ClassVar[int]
    LINE_LOOP: ClassVar[int]
    LINE_STRIP: ClassVar[int]
    LINE_LIST: ClassVar[int]
    timestamp: builtin_interfaces.msg.Time
    type: int
    points: list[Point2]
    outline_color: Color
    outline_colors: list[Color]
    fill_color: Color
    thickness: float
    metadata: list[KeyValuePair]
    def __init__(
        self,
        *,
        timestamp: builtin_interfaces.msg.Time = ...,
        type: int = ...,
        points: list[Point2] = ...,
        outline_color: Color = ...,
        outline_colors: list[Color] = ...,
        fill_color: Color = ...,
        thickness: float = ...,
        metadata: list[KeyValuePair] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class PoseInFrame(Message):
    timestamp: builtin_interfaces.msg.Time
    frame_id: str
    pose: geometry_msgs.msg.Pose
    def __init__(
        self,
        *,
        timestamp: builtin_interfaces.msg.Time = ...,
        frame_id: str = ...,
        pose: geometry_msgs.msg.Pose = ...,
        check_fields: bool = ...,
    ) -> None: ...

class PosesInFrame(Message):
    timestamp: builtin_interfaces.msg.Time
    frame_id: str
    poses: list[geometry_msgs.msg.Pose]
    def __init__(
        self,
        *,
        timestamp: builtin_interfaces.msg.Time = ...,
        frame_id: str = ...,
        poses: list[geometry_msgs.msg.Pose] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class RawAudio(Message):
    timestamp: builtin_interfaces.msg.Time
    @property
    def data(self) -> array.array[int]: ...
    @data.setter
    def data(self, value: Iterable[int]) -> None: ...
    format: str
    sample_rate: int
    number_of_channels: int
    def __init__(
        self,
        *,
        timestamp: builtin_interfaces.msg.Time = ...,
        data: Iterable[int] = ...,
        format: str = ...,
        sample_rate: int = ...,
        number_of_channels: int = ...,
        check_fields: bool = ...,
    ) -> None: ...

class RawImage(Message):
    timestamp: builtin_interfaces.msg.Time
    frame_id: str
    width: int
    height: int
    encoding: str
    step: int
    @property
    def data(self) -> array.array[int]: ...
    @data.setter
    def data(self, value: Iterable[int]) -> None: ...
    def __init__(
        self,
        *,
        timestamp: builtin_interfaces.msg.Time = ...,
        frame_id: str = ...,
        width: int = ...,
        height: int = ...,
        encoding: str = ...,
        step: int = ...,
        data: Iterable[int] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class SceneEntity(Message):
    timestamp: builtin_interfaces.msg.Time
    frame_id: str
    id: str
    lifetime: builtin_interfaces.msg.Duration
    frame_locked: bool
    metadata: list[KeyValuePair]
    arrows: list[ArrowPrimitive]
    cubes: list[CubePrimitive]
    spheres: list[SpherePrimitive]
    cylinders: list[CylinderPrimitive]
    lines: list[LinePrimitive]
    triangles: list[TriangleListPrimitive]
    texts: list[TextPrimitive]
    models: list[ModelPrimitive]
    def __init__(
        self,
        *,
        timestamp: builtin_interfaces.msg.Time = ...,
        frame_id: str = ...,
        id: str = ...,
        lifetime: builtin_interfaces.msg.Duration = ...,
        frame_locked: bool = ...,
        metadata: list[KeyValuePair] = ...,
        arrows: list[ArrowPrimitive] = ...,
        cubes: list[CubePrimitive] = ...,
        spheres: list[SpherePrimitive] = ...,
        cylinders: list[CylinderPrimitive] = ...,
        lines: list[LinePrimitive] = ...,
        triangles: list[TriangleListPrimitive] = ...,
        texts: list[TextPrimitive] = ...,
        models: list[ModelPrimitive] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class SceneEntityDeletion(Message):
    MATCHING_ID: ClassVar[int]
    ALL: ClassVar[int]
    timestamp: builtin_interfaces.msg.Time
    type: int
    id: str
    def __init__(
        self,
        *,
        timestamp: builtin_interfaces.msg.Time = ...,
        type: int = ...,
        id: str = ...,
        check_fields: bool = ...,
    ) -> None: ...

class SceneUpdate(Message):
    deletions: list[SceneEntityDeletion]
    entities: list[SceneEntity]
    def __init__(
        self,
        *,
        deletions: list[SceneEntityDeletion] = ...,
        entities: list[SceneEntity] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class SpherePrimitive(Message):
    pose: geometry_msgs.msg.Pose
    size: geometry_msgs.msg.Vector3
    color: Color
    def __init__(
        self,
        *,
        pose: geometry_msgs.msg.Pose = ...,
        size: geometry_msgs.msg.Vector3 = ...,
        color: Color = ...,
        check_fields: bool = ...,
    ) -> None: ...

class TextAnnotation(Message):
    timestamp: builtin_interfaces.msg.Time
    position: Point2
    text: str
    font_size: float
    text_color: Color
    background_color: Color
    metadata: list[KeyValuePair]
    def __init__(
        self,
        *,
        timestamp: builtin_interfaces.msg.Time = ...,
        position: Point2 = ...,
        text: str = ...,
        font_size: float = ...,
        text_color: Color = ...,
        background_color: Color = ...,
        metadata: list[KeyValuePair] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class TextPrimitive(Message):
    pose: geometry_msgs.msg.Pose
    billboard: bool
    font_size: float
    scale_invariant: bool
    color: Color
    text: str
    def __init__(
        self,
        *,
        pose: geometry_msgs.msg.Pose = ...,
        billboard: bool = ...,
        font_size: float = ...,
        scale_invariant: bool = ...,
        color: Color = ...,
        text: str = ...,
        check_fields: bool = ...,
    ) -> None: ...

class TriangleListPrimitive(Message):
    pose: geometry_msgs.msg.Pose
    points: list[geometry_msgs.msg.Point]
    color: Color
    colors: list[Color]
    @property
    def indices(self) -> array.array[int]: ...
    @indices.setter
    def indices(self, value: Iterable[int]) -> None: ...
    def __init__(
        self,
        *,
        pose: geometry_msgs.msg.Pose = ...,
        points: list[geometry_msgs.msg.Point] = ...,
        color: Color = ...,
        colors: list[Color] = ...,
        indices: Iterable[int] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Vector2(Message):
    x: float
    y: float
    def __init__(self, *, x: float = ..., y: float = ..., check_fields: bool = ...) -> None: ...

class VoxelGrid(Message):
    timestamp: builtin_interfaces.msg.Time
    frame_id: str
    pose: geometry_msgs.msg.Pose
    row_count: int
    column_count: int
    cell_size: geometry_msgs.msg.Vector3
    slice_stride: int
    row_stride: int
    cell_stride: int
    fields: list[PackedElementField]
    @property
    def data(self) -> array.array[int]: ...
    @data.setter
    def data(self, value: Iterable[int]) -> None: ...
    def __init__(
        self,
        *,
        timestamp: builtin_interfaces.msg.Time = ...,
        frame_id: str = ...,
        pose: geometry_msgs.msg.Pose = ...,
        row_count: int = ...,
        column_count: int = ...,
        cell_size: geometry_msgs.msg.Vector3 = ...,
        slice_stride: int = ...,
        row_stride: int = ...,
        cell_stride: int = ...,
        fields: list[PackedElementField] = ...,
        data: Iterable[int] = ...,
        check_fields: bool = ...,
    ) -> None: ...
