"""The msg interfaces of stereo_msgs: classes made at first access."""

from turtlewire.msg import lazy_classes

__all__ = [
    "DisparityImage",
]

__getattr__ = lazy_classes(__name__)


def __dir__() -> list[str]:
    return __all__
