"""The msg interfaces of map_msgs: classes made at first access."""

from turtlewire.msg import lazy_classes

__all__ = [
    "OccupancyGridUpdate",
    "PointCloud2Update",
    "ProjectedMap",
    "ProjectedMapInfo",
]

__getattr__ = lazy_classes(__name__)


def __dir__() -> list[str]:
    return __all__
