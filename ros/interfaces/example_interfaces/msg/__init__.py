"""The msg interfaces of example_interfaces: classes made at first access."""

from turtlewire.msg import lazy_classes

__all__ = [
    "Bool",
    "Byte",
    "ByteMultiArray",
    "Char",
    "Empty",
    "Float32",
    "Float32MultiArray",
    "Float64",
    "Float64MultiArray",
    "Int8",
    "Int8MultiArray",
    "Int16",
    "Int16MultiArray",
    "Int32",
    "Int32MultiArray",
    "Int64",
    "Int64MultiArray",
    "MultiArrayDimension",
    "MultiArrayLayout",
    "String",
    "UInt8",
    "UInt8MultiArray",
    "UInt16",
    "UInt16MultiArray",
    "UInt32",
    "UInt32MultiArray",
    "UInt64",
    "UInt64MultiArray",
    "WString",
]

__getattr__ = lazy_classes(__name__)


def __dir__() -> list[str]:
    return __all__
