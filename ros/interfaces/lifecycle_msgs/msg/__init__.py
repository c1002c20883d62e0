"""The msg interfaces of lifecycle_msgs: classes made at first access."""

from turtlewire.msg import lazy_classes

__all__ = [
    "State",
    "Transition",
    "TransitionDescription",
    "TransitionEvent",
]

__getattr__ = lazy_classes(__name__)


def __dir__() -> list[str]:
    return __all__
