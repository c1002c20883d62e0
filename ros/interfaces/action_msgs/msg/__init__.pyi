"""Types of action_msgs.msg; generated."""

import builtin_interfaces.msg
import unique_identifier_msgs.msg
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "GoalInfo",
    "GoalStatus",
    "GoalStatusArray",
]

class GoalInfo(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    stamp: builtin_interfaces.msg.Time
    def __init__(
        self,
        *,
        goal_id: unique_identifier_msgs.msg.UUID = ...,
        stamp: builtin_interfaces.msg.Time = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GoalStatus(Message):
    STATUS_UNKNOWN: ClassVar[int]
    STATUS_ACCEPTED: ClassVar[int]
    STATUS_EXECUTING: ClassVar[int]
    STATUS_CANCELING: ClassVar[int]
    STATUS_SUCCEEDED: ClassVar[int]
    STATUS_CANCELED: ClassVar[int]
    STATUS_ABORTED: ClassVar[int]
    goal_info: GoalInfo
    status: int
    def __init__(
        self,
        *,
        goal_info: GoalInfo = ...,
        status: int = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GoalStatusArray(Message):
    status_list: list[GoalStatus]
    def __init__(
        self,
        *,
        status_list: list[GoalStatus] = ...,
        check_fields: bool = ...,
    ) -> None: ...
