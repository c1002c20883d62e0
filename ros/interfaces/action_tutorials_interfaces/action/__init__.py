"""The action interfaces of action_tutorials_interfaces: classes made at first access."""

from turtlewire.msg import lazy_classes

__all__ = [
    "Fibonacci",
]

__getattr__ = lazy_classes(__name__)


def __dir__() -> list[str]:
    return __all__
