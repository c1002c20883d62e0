"""Types of action_tutorials_interfaces.action; generated."""

import action_msgs.msg
import action_msgs.srv
import array
import builtin_interfaces.msg
import service_msgs.msg
import unique_identifier_msgs.msg
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "Fibonacci",
]

class Fibonacci_Goal(Message):
    order: int
    def __init__(self, *, order: int = ..., check_fields: bool = ...) -> None: ...

class Fibonacci_Result(Message):
    @property
    def sequence(self) -> array.array[int]: ...
    @sequence.setter
    def sequence(self, value: Iterable[int]) -> None: ...
    def __init__(self, *, sequence: Iterable[int] = ..., check_fields: bool = ...) -> None: ...

class Fibonacci_Feedback(Message):
    @property
    def partial_sequence(self) -> array.array[int]: ...
    @partial_sequence.setter
    def partial_sequence(self, value: Iterable[int]) -> None: ...
    def __init__(
        self,
        *,
        partial_sequence: Iterable[int] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Fibonacci_FeedbackMessage(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    feedback: Fibonacci_Feedback
    def __init__(
        self,
        *,
        goal_id: unique_identifier_msgs.msg.UUID = ...,
        feedback: Fibonacci_Feedback = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Fibonacci_SendGoal_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    goal: Fibonacci_Goal
    def __init__(
        self,
        *,
        goal_id: unique_identifier_msgs.msg.UUID = ...,
        goal: Fibonacci_Goal = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Fibonacci_SendGoal_Response(Message):
    accepted: bool
    stamp: builtin_interfaces.msg.Time
    def __init__(
        self,
        *,
        accepted: bool = ...,
        stamp: builtin_interfaces.msg.Time = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Fibonacci_SendGoal_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[Fibonacci_SendGoal_Request]
    response: list[Fibonacci_SendGoal_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[Fibonacci_SendGoal_Request] = ...,
        response: list[Fibonacci_SendGoal_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Fibonacci_SendGoal(Service[Fibonacci_SendGoal_Request, Fibonacci_SendGoal_Response]):
    Request: TypeAlias = Fibonacci_SendGoal_Request
    Response: TypeAlias = Fibonacci_SendGoal_Response
    Event: TypeAlias = Fibonacci_SendGoal_Event

class Fibonacci_GetResult_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    def __init__(
        self,
        *,
        goal_id: unique_identifier_msgs.msg.UUID = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Fibonacci_GetResult_Response(Message):
    status: int
    result: Fibonacci_Result
    def __init__(
        self,
        *,
        status: int = ...,
        result: Fibonacci_Result = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Fibonacci_GetResult_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[Fibonacci_GetResult_Request]
    response: list[Fibonacci_GetResult_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[Fibonacci_GetResult_Request] = ...,
        response: list[Fibonacci_GetResult_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Fibonacci_GetResult(Service[Fibonacci_GetResult_Request, Fibonacci_GetResult_Response]):
    Request: TypeAlias = Fibonacci_GetResult_Request
    Response: TypeAlias = Fibonacci_GetResult_Response
    Event: TypeAlias = Fibonacci_GetResult_Event

class Fibonacci(Action[Fibonacci_Goal, Fibonacci_Result, Fibonacci_Feedback]):
    Goal: TypeAlias = Fibonacci_Goal
    Result: TypeAlias = Fibonacci_Result
    Feedback: TypeAlias = Fibonacci_Feedback
    class Impl:
        SendGoalService: TypeAlias = Fibonacci_SendGoal
        GetResultService: TypeAlias = Fibonacci_GetResult
        FeedbackMessage: TypeAlias = Fibonacci_FeedbackMessage
        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal
        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray
