"""The srv interfaces of map_msgs: classes made at first access."""

from turtlewire.msg import lazy_classes

__all__ = [
    "GetMapROI",
    "GetPointMap",
    "GetPointMapROI",
    "ProjectedMapsInfo",
    "SaveMap",
    "SetMapProjections",
]

__getattr__ = lazy_classes(__name__)


def __dir__() -> list[str]:
    return __all__
