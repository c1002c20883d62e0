"""Types of tf2_msgs.msg; generated."""

import geometry_msgs.msg
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "TF2Error",
    "TFMessage",
]

class TF2Error(Message):
    NO_ERROR: ClassVar[int]
    LOOKUP_ERROR: ClassVar[int]
    CONNECTIVITY_ERROR: ClassVar[int]
    EXTRAPOLATION_ERROR: ClassVar[int]
    INVALID_ARGUMENT_ERROR: ClassVar[int]
    TIMEOUT_ERROR: ClassVar[int]
    TRANSFORM_ERROR: ClassVar[int]
    error: int
    error_string: str
    def __init__(
        self,
        *,
        error: int = ...,
        error_string: str = ...,
        check_fields: bool = ...,
    ) -> None: ...

class TFMessage(Message):
    transforms: list[geometry_msgs.msg.TransformStamped]
    def __init__(
        self,
        *,
        transforms: list[geometry_msgs.msg.TransformStamped] = ...,
        check_fields: bool = ...,
    ) -> None: ...
