"""The msg interfaces of foxglove_msgs: classes made at first access."""

from turtlewire.msg import lazy_classes

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

__getattr__ = lazy_classes(__name__)


def __dir__() -> list[str]:
    return __all__
