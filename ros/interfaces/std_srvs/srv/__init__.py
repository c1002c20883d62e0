"""The srv interfaces of std_srvs: classes made at first access."""

from turtlewire.msg import lazy_classes

__all__ = [
    "Empty",
    "SetBool",
    "Trigger",
]

__getattr__ = lazy_classes(__name__)


def __dir__() -> list[str]:
    return __all__
