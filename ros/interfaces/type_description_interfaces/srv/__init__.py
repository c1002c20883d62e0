"""The srv interfaces of type_description_interfaces: classes made at first access."""

from turtlewire.msg import lazy_classes

__all__ = [
    "GetTypeDescription",
]

__getattr__ = lazy_classes(__name__)


def __dir__() -> list[str]:
    return __all__
