"""Types of vision_msgs.msg; generated."""

import geometry_msgs.msg
import std_msgs.msg
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "BoundingBox2D",
    "BoundingBox2DArray",
    "BoundingBox3D",
    "BoundingBox3DArray",
    "Classification",
    "Detection2D",
    "Detection2DArray",
    "Detection3D",
    "Detection3DArray",
    "LabelInfo",
    "ObjectHypothesis",
    "ObjectHypothesisWithPose",
    "Point2D",
    "Pose2D",
    "VisionClass",
    "VisionInfo",
]

class BoundingBox2D(Message):
    center: Pose2D
    size_x: float
    size_y: float
    def __init__(
        self,
        *,
        center: Pose2D = ...,
        size_x: float = ...,
        size_y: float = ...,
        check_fields: bool = ...,
    ) -> None: ...

class BoundingBox2DArray(Message):
    header: std_msgs.msg.Header
    boxes: list[BoundingBox2D]
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        boxes: list[BoundingBox2D] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class BoundingBox3D(Message):
    center: geometry_msgs.msg.Pose
    size: geometry_msgs.msg.Vector3
    def __init__(
        self,
        *,
        center: geometry_msgs.msg.Pose = ...,
        size: geometry_msgs.msg.Vector3 = ...,
        check_fields: bool = ...,
    ) -> None: ...

class BoundingBox3DArray(Message):
    header: std_msgs.msg.Header
    boxes: list[BoundingBox3D]
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        boxes: list[BoundingBox3D] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Classification(Message):
    header: std_msgs.msg.Header
    results: list[ObjectHypothesis]
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        results: list[ObjectHypothesis] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Detection2D(Message):
    header: std_msgs.msg.Header
    results: list[ObjectHypothesisWithPose]
    bbox: BoundingBox2D
    id: str
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        results: list[ObjectHypothesisWithPose] = ...,
        bbox: BoundingBox2D = ...,
        id: str = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Detection2DArray(Message):
    header: std_msgs.msg.Header
    detections: list[Detection2D]
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        detections: list[Detection2D] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Detection3D(Message):
    header: std_msgs.msg.Header
    results: list[ObjectHypothesisWithPose]
    bbox: BoundingBox3D
    id: str
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        results: list[ObjectHypothesisWithPose] = ...,
        bbox: BoundingBox3D = ...,
        id: str = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Detection3DArray(Message):
    header: std_msgs.msg.Header
    detections: list[Detection3D]
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        detections: list[Detection3D] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class LabelInfo(Message):
    header: std_msgs.msg.Header
    class_map: list[VisionClass]
    threshold: float
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        class_map: list[VisionClass] = ...,
        threshold: float = ...,
        check_fields: bool = ...,
    ) -> None: ...

class ObjectHypothesis(Message):
    class_id: str
    score: float
    def __init__(
        self,
        *,
        class_id: str = ...,
        score: float = ...,
        check_fields: bool = ...,
    ) -> None: ...

class ObjectHypothesisWithPose(Message):
    hypothesis: ObjectHypothesis
    pose: geometry_msgs.msg.PoseWithCovariance
    def __init__(
        self,
        *,
        hypothesis: ObjectHypothesis = ...,
        pose: geometry_msgs.msg.PoseWithCovariance = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Point2D(Message):
    x: float
    y: float
    def __init__(self, *, x: float = ..., y: float = ..., check_fields: bool = ...) -> None: ...

class Pose2D(Message):
    position: Point2D
    theta: float
    def __init__(
        self,
        *,
        position: Point2D = ...,
        theta: float = ...,
        check_fields: bool = ...,
    ) -> None: ...

class VisionClass(Message):
    class_id: int
    class_name: str
    def __init__(
        self,
        *,
        class_id: int = ...,
        class_name: str = ...,
        check_fields: bool = ...,
    ) -> None: ...

class VisionInfo(Message):
    header: std_msgs.msg.Header
    method: str
    database_location: str
    database_version: int
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        method: str = ...,
        database_location: str = ...,
        database_version: int = ...,
        check_fields: bool = ...,
    ) -> None: ...
