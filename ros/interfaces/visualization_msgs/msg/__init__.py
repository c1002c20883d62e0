"""The msg interfaces of visualization_msgs: classes made at first access."""

from turtlewire.msg import lazy_classes

__all__ = [
    "ImageMarker",
    "InteractiveMarker",
    "InteractiveMarkerControl",
    "InteractiveMarkerFeedback",
    "InteractiveMarkerInit",
    "InteractiveMarkerPose",
    "InteractiveMarkerUpdate",
    "Marker",
    "MarkerArray",
    "MenuEntry",
    "MeshFile",
    "UVCoordinate",
]

__getattr__ = lazy_classes(__name__)


def __dir__() -> list[str]:
    return __all__
