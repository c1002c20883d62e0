"""The srv interfaces of rosbag2_interfaces: classes made at first access."""

from turtlewire.msg import lazy_classes

__all__ = [
    "Burst",
    "GetRate",
    "IsPaused",
    "Pause",
    "Play",
    "PlayNext",
    "Resume",
    "Seek",
    "SetRate",
    "Snapshot",
    "SplitBagfile",
    "Stop",
    "TogglePaused",
]

__getattr__ = lazy_classes(__name__)


def __dir__() -> list[str]:
    return __all__
