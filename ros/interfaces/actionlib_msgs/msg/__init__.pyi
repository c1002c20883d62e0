"""Types of actionlib_msgs.msg; generated."""

import builtin_interfaces.msg
import std_msgs.msg
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "GoalID",
    "GoalStatus",
    "GoalStatusArray",
]

class GoalID(Message):
    stamp: builtin_interfaces.msg.Time
    id: str
    def __init__(
        self,
        *,
        stamp: builtin_interfaces.msg.Time = ...,
        id: str = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GoalStatus(Message):
    PENDING: ClassVar[int]
    ACTIVE: ClassVar[int]
    PREEMPTED: ClassVar[int]
    SUCCEEDED: ClassVar[int]
    ABORTED: ClassVar[int]
    REJECTED: ClassVar[int]
    PREEMPTING: ClassVar[int]
    RECALLING: ClassVar[int]
    RECALLED: ClassVar[int]
    LOST: ClassVar[int]
    goal_id: GoalID
    status: int
    text: str
    def __init__(
        self,
        *,
        goal_id: GoalID = ...,
        status: int = ...,
        text: str = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GoalStatusArray(Message):
    header: std_msgs.msg.Header
    status_list: list[GoalStatus]
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        status_list: list[GoalStatus] = ...,
        check_fields: bool = ...,
    ) -> None: ...
