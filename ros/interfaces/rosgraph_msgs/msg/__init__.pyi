"""Types of rosgraph_msgs.msg; generated."""

import builtin_interfaces.msg
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "Clock",
]

class Clock(Message):
    clock: builtin_interfaces.msg.Time
    def __init__(
        self,
        *,
        clock: builtin_interfaces.msg.Time = ...,
        check_fields: bool = ...,
    ) -> None: ...
