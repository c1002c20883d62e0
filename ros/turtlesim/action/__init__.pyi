"""Types of turtlesim.action; generated."""

import action_msgs.msg
import action_msgs.srv
import builtin_interfaces.msg
import service_msgs.msg
import unique_identifier_msgs.msg
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "RotateAbsolute",
]

class RotateAbsolute_Goal(Message):
    theta: float
    def __init__(self, *, theta: float = ..., check_fields: bool = ...) -> None: ...

class RotateAbsolute_Result(Message):
    delta: float
    def __init__(self, *, delta: float = ..., check_fields: bool = ...) -> None: ...

class RotateAbsolute_Feedback(Message):
    remaining: float
    def __init__(self, *, remaining: float = ..., check_fields: bool = ...) -> None: ...

class RotateAbsolute_FeedbackMessage(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    feedback: RotateAbsolute_Feedback
    def __init__(
        self,
        *,
        goal_id: unique_identifier_msgs.msg.UUID = ...,
        feedback: RotateAbsolute_Feedback = ...,
        check_fields: bool = ...,
    ) -> None: ...

class RotateAbsolute_SendGoal_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    goal: RotateAbsolute_Goal
    def __init__(
        self,
        *,
        goal_id: unique_identifier_msgs.msg.UUID = ...,
        goal: RotateAbsolute_Goal = ...,
        check_fields: bool = ...,
    ) -> None: ...

class RotateAbsolute_SendGoal_Response(Message):
    accepted: bool
    stamp: builtin_interfaces.msg.Time
    def __init__(
        self,
        *,
        accepted: bool = ...,
        stamp: builtin_interfaces.msg.Time = ...,
        check_fields: bool = ...,
    ) -> None: ...

class RotateAbsolute_SendGoal_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[RotateAbsolute_SendGoal_Request]
    response: list[RotateAbsolute_SendGoal_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[RotateAbsolute_SendGoal_Request] = ...,
        response: list[RotateAbsolute_SendGoal_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class RotateAbsolute_SendGoal(
    Service[
        RotateAbsolute_SendGoal_Request,
        RotateAbsolute_SendGoal_Response,
    ]
):
    Request: TypeAlias = RotateAbsolute_SendGoal_Request
    Response: TypeAlias = RotateAbsolute_SendGoal_Response
    Event: TypeAlias = RotateAbsolute_SendGoal_Event

class RotateAbsolute_GetResult_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    def __init__(
        self,
        *,
        goal_id: unique_identifier_msgs.msg.UUID = ...,
        check_fields: bool = ...,
    ) -> None: ...

class RotateAbsolute_GetResult_Response(Message):
    status: int
    result: RotateAbsolute_Result
    def __init__(
        self,
        *,
        status: int = ...,
        result: RotateAbsolute_Result = ...,
        check_fields: bool = ...,
    ) -> None: ...

class RotateAbsolute_GetResult_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[RotateAbsolute_GetResult_Request]
    response: list[RotateAbsolute_GetResult_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[RotateAbsolute_GetResult_Request] = ...,
        response: list[RotateAbsolute_GetResult_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class RotateAbsolute_GetResult(
    Service[
        RotateAbsolute_GetResult_Request,
        RotateAbsolute_GetResult_Response,
    ]
):
    Request: TypeAlias = RotateAbsolute_GetResult_Request
    Response: TypeAlias = RotateAbsolute_GetResult_Response
    Event: TypeAlias = RotateAbsolute_GetResult_Event

class RotateAbsolute(Action[RotateAbsolute_Goal, RotateAbsolute_Result, RotateAbsolute_Feedback]):
    Goal: TypeAlias = RotateAbsolute_Goal
    Result: TypeAlias = RotateAbsolute_Result
    Feedback: TypeAlias = RotateAbsolute_Feedback
    class Impl:
        SendGoalService: TypeAlias = RotateAbsolute_SendGoal
        GetResultService: TypeAlias = RotateAbsolute_GetResult
        FeedbackMessage: TypeAlias = RotateAbsolute_FeedbackMessage
        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal
        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray
