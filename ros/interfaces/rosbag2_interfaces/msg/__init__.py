"""The msg interfaces of rosbag2_interfaces: classes made at first access."""

from turtlewire.msg import lazy_classes

__all__ = [
    "ReadSplitEvent",
    "WriteSplitEvent",
]

__getattr__ = lazy_classes(__name__)


def __dir__() -> list[str]:
    return __all__
