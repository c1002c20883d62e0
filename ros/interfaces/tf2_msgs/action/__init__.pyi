"""Types of tf2_msgs.action; generated."""

import action_msgs.msg
import action_msgs.srv
import builtin_interfaces.msg
import geometry_msgs.msg
import service_msgs.msg
import tf2_msgs.msg
import unique_identifier_msgs.msg
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "LookupTransform",
]

class LookupTransform_Goal(Message):
    target_frame: str
    source_frame: str
    source_time: builtin_interfaces.msg.Time
    timeout: builtin_interfaces.msg.Duration
    target_time: builtin_interfaces.msg.Time
    fixed_frame: str
    advanced: bool
    def __init__(
        self,
        *,
        target_frame: str = ...,
        source_frame: str = ...,
        source_time: builtin_interfaces.msg.Time = ...,
        timeout: builtin_interfaces.msg.Duration = ...,
        target_time: builtin_interfaces.msg.Time = ...,
        fixed_frame: str = ...,
        advanced: bool = ...,
        check_fields: bool = ...,
    ) -> None: ...

class LookupTransform_Result(Message):
    transform: geometry_msgs.msg.TransformStamped
    error: tf2_msgs.msg.TF2Error
    def __init__(
        self,
        *,
        transform: geometry_msgs.msg.TransformStamped = ...,
        error: tf2_msgs.msg.TF2Error = ...,
        check_fields: bool = ...,
    ) -> None: ...

class LookupTransform_Feedback(Message):
    def __init__(self, *, check_fields: bool = ...) -> None: ...

class LookupTransform_FeedbackMessage(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    feedback: LookupTransform_Feedback
    def __init__(
        self,
        *,
        goal_id: unique_identifier_msgs.msg.UUID = ...,
        feedback: LookupTransform_Feedback = ...,
        check_fields: bool = ...,
    ) -> None: ...

class LookupTransform_SendGoal_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    goal: LookupTransform_Goal
    def __init__(
        self,
        *,
        goal_id: unique_identifier_msgs.msg.UUID = ...,
        goal: LookupTransform_Goal = ...,
        check_fields: bool = ...,
    ) -> None: ...

class LookupTransform_SendGoal_Response(Message):
    accepted: bool
    stamp: builtin_interfaces.msg.Time
    def __init__(
        self,
        *,
        accepted: bool = ...,
        stamp: builtin_interfaces.msg.Time = ...,
        check_fields: bool = ...,
    ) -> None: ...

class LookupTransform_SendGoal_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[LookupTransform_SendGoal_Request]
    response: list[LookupTransform_SendGoal_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[LookupTransform_SendGoal_Request] = ...,
        response: list[LookupTransform_SendGoal_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class LookupTransform_SendGoal(
    Service[
        LookupTransform_SendGoal_Request,
        LookupTransform_SendGoal_Response,
    ]
):
    Request: TypeAlias = LookupTransform_SendGoal_Request
    Response: TypeAlias = LookupTransform_SendGoal_Response
    Event: TypeAlias = LookupTransform_SendGoal_Event

class LookupTransform_GetResult_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    def __init__(
        self,
        *,
        goal_id: unique_identifier_msgs.msg.UUID = ...,
        check_fields: bool = ...,
    ) -> None: ...

class LookupTransform_GetResult_Response(Message):
    status: int
    result: LookupTransform_Result
    def __init__(
        self,
        *,
        status: int = ...,
        result: LookupTransform_Result = ...,
        check_fields: bool = ...,
    ) -> None: ...

class LookupTransform_GetResult_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[LookupTransform_GetResult_Request]
    response: list[LookupTransform_GetResult_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[LookupTransform_GetResult_Request] = ...,
        response: list[LookupTransform_GetResult_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class LookupTransform_GetResult(
    Service[
        LookupTransform_GetResult_Request,
        LookupTransform_GetResult_Response,
    ]
):
    Request: TypeAlias = LookupTransform_GetResult_Request
    Response: TypeAlias = LookupTransform_GetResult_Response
    Event: TypeAlias = LookupTransform_GetResult_Event

class LookupTransform(
    Action[
        LookupTransform_Goal,
        LookupTransform_Result,
        LookupTransform_Feedback,
    ]
):
    Goal: TypeAlias = LookupTransform_Goal
    Result: TypeAlias = LookupTransform_Result
    Feedback: TypeAlias = LookupTransform_Feedback
    class Impl:
        SendGoalService: TypeAlias = LookupTransform_SendGoal
        GetResultService: TypeAlias = LookupTransform_GetResult
        FeedbackMessage: TypeAlias = LookupTransform_FeedbackMessage
        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal
        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray
