"""The srv interfaces of rcl_interfaces: classes made at first access."""

from turtlewire.msg import lazy_classes

__all__ = [
    "DescribeParameters",
    "GetLoggerLevels",
    "GetParameterTypes",
    "GetParameters",
    "ListParameters",
    "SetLoggerLevels",
    "SetParameters",
    "SetParametersAtomically",
]

__getattr__ = lazy_classes(__name__)


def __dir__() -> list[str]:
    return __all__
