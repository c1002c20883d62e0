"""The msg interfaces of rcl_interfaces: classes made at first access."""

from turtlewire.msg import lazy_classes

__all__ = [
    "FloatingPointRange",
    "IntegerRange",
    "ListParametersResult",
    "Log",
    "LoggerLevel",
    "Parameter",
    "ParameterDescriptor",
    "ParameterEvent",
    "ParameterEventDescriptors",
    "ParameterType",
    "ParameterValue",
    "SetLoggerLevelsResult",
    "SetParametersResult",
]

__getattr__ = lazy_classes(__name__)


def __dir__() -> list[str]:
    return __all__
