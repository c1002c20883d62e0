"""Types of action_msgs.srv; generated."""

import action_msgs.msg
import service_msgs.msg
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "CancelGoal",
]

class CancelGoal_Request(Message):
    goal_info: action_msgs.msg.GoalInfo
    def __init__(
        self,
        *,
        goal_info: action_msgs.msg.GoalInfo = ...,
        check_fields: bool = ...,
    ) -> None: ...

class CancelGoal_Response(Message):
    ERROR_NONE: ClassVar[int]
    ERROR_REJECTED: ClassVar[int]
    ERROR_UNKNOWN_GOAL_ID: ClassVar[int]
    ERROR_GOAL_TERMINATED: ClassVar[int]
    return_code: int
    goals_canceling: list[action_msgs.msg.GoalInfo]
    def __init__(
        self,
        *,
        return_code: int = ...,
        goals_canceling: list[action_msgs.msg.GoalInfo] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class CancelGoal_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[CancelGoal_Request]
    response: list[CancelGoal_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[CancelGoal_Request] = ...,
        response: list[CancelGoal_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class CancelGoal(Service[CancelGoal_Request, CancelGoal_Response]):
    Request: TypeAlias = CancelGoal_Request
    Response: TypeAlias = CancelGoal_Response
    Event: TypeAlias = CancelGoal_Event
