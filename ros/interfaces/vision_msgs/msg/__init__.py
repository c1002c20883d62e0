"""The msg interfaces of vision_msgs: classes made at first access."""

from turtlewire.msg import lazy_classes

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

__getattr__ = lazy_classes(__name__)


def __dir__() -> list[str]:
    return __all__
