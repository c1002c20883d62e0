"""Types of control_msgs.action; generated."""

import action_msgs.msg
import action_msgs.srv
import builtin_interfaces.msg
import control_msgs.msg
import geometry_msgs.msg
import sensor_msgs.msg
import service_msgs.msg
import std_msgs.msg
import trajectory_msgs.msg
import unique_identifier_msgs.msg
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "FollowJointTrajectory",
    "GripperCommand",
    "JointTrajectory",
    "ParallelGripperCommand",
    "PointHead",
    "SingleJointPosition",
]

class FollowJointTrajectory_Goal(Message):
    trajectory: trajectory_msgs.msg.JointTrajectory
    multi_dof_trajectory: trajectory_msgs.msg.MultiDOFJointTrajectory
    path_tolerance: list[control_msgs.msg.JointTolerance]
    component_path_tolerance: list[control_msgs.msg.JointComponentTolerance]
    goal_tolerance: list[control_msgs.msg.JointTolerance]
    component_goal_tolerance: list[control_msgs.msg.JointComponentTolerance]
    goal_time_tolerance: builtin_interfaces.msg.Duration
    def __init__(
        self,
        *,
        trajectory: trajectory_msgs.msg.JointTrajectory = ...,
        multi_dof_trajectory: trajectory_msgs.msg.MultiDOFJointTrajectory = ...,
        path_tolerance: list[control_msgs.msg.JointTolerance] = ...,
        component_path_tolerance: list[control_msgs.msg.JointComponentTolerance] = ...,
        goal_tolerance: list[control_msgs.msg.JointTolerance] = ...,
        component_goal_tolerance: list[control_msgs.msg.JointComponentTolerance] = ...,
        goal_time_tolerance: builtin_interfaces.msg.Duration = ...,
        check_fields: bool = ...,
    ) -> None: ...

class FollowJointTrajectory_Result(Message):
    SUCCESSFUL: ClassVar[int]
    INVALID_GOAL: ClassVar[int]
    INVALID_JOINTS: ClassVar[int]
    OLD_HEADER_TIMESTAMP: ClassVar[int]
    PATH_TOLERANCE_VIOLATED: ClassVar[int]
    GOAL_TOLERANCE_VIOLATED: ClassVar[int]
    error_code: int
    error_string: str
    def __init__(
        self,
        *,
        error_code: int = ...,
        error_string: str = ...,
        check_fields: bool = ...,
    ) -> None: ...

class FollowJointTrajectory_Feedback(Message):
    header: std_msgs.msg.Header
    joint_names: list[str]
    desired: trajectory_msgs.msg.JointTrajectoryPoint
    actual: trajectory_msgs.msg.JointTrajectoryPoint
    error: trajectory_msgs.msg.JointTrajectoryPoint
    multi_dof_joint_names: list[str]
    multi_dof_desired: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint
    multi_dof_actual: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint
    multi_dof_error: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        joint_names: list[str] = ...,
        desired: trajectory_msgs.msg.JointTrajectoryPoint = ...,
        actual: trajectory_msgs.msg.JointTrajectoryPoint = ...,
        error: trajectory_msgs.msg.JointTrajectoryPoint = ...,
        multi_dof_joint_names: list[str] = ...,
        multi_dof_desired: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint = ...,
        multi_dof_actual: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint = ...,
        multi_dof_error: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint = ...,
        check_fields: bool = ...,
    ) -> None: ...

class FollowJointTrajectory_FeedbackMessage(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    feedback: FollowJointTrajectory_Feedback
    def __init__(
        self,
        *,
        goal_id: unique_identifier_msgs.msg.UUID = ...,
        feedback: FollowJointTrajectory_Feedback = ...,
        check_fields: bool = ...,
    ) -> None: ...

class FollowJointTrajectory_SendGoal_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    goal: FollowJointTrajectory_Goal
    def __init__(
        self,
        *,
        goal_id: unique_identifier_msgs.msg.UUID = ...,
        goal: FollowJointTrajectory_Goal = ...,
        check_fields: bool = ...,
    ) -> None: ...

class FollowJointTrajectory_SendGoal_Response(Message):
    accepted: bool
    stamp: builtin_interfaces.msg.Time
    def __init__(
        self,
        *,
        accepted: bool = ...,
        stamp: builtin_interfaces.msg.Time = ...,
        check_fields: bool = ...,
    ) -> None: ...

class FollowJointTrajectory_SendGoal_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[FollowJointTrajectory_SendGoal_Request]
    response: list[FollowJointTrajectory_SendGoal_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[FollowJointTrajectory_SendGoal_Request] = ...,
        response: list[FollowJointTrajectory_SendGoal_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class FollowJointTrajectory_SendGoal(
    Service[
        FollowJointTrajectory_SendGoal_Request,
        FollowJointTrajectory_SendGoal_Response,
    ]
):
    Request: TypeAlias = FollowJointTrajectory_SendGoal_Request
    Response: TypeAlias = FollowJointTrajectory_SendGoal_Response
    Event: TypeAlias = FollowJointTrajectory_SendGoal_Event

class FollowJointTrajectory_GetResult_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    def __init__(
        self,
        *,
        goal_id: unique_identifier_msgs.msg.UUID = ...,
        check_fields: bool = ...,
    ) -> None: ...

class FollowJointTrajectory_GetResult_Response(Message):
    status: int
    result: FollowJointTrajectory_Result
    def __init__(
        self,
        *,
        status: int = ...,
        result: FollowJointTrajectory_Result = ...,
        check_fields: bool = ...,
    ) -> None: ...

class FollowJointTrajectory_GetResult_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[FollowJointTrajectory_GetResult_Request]
    response: list[FollowJointTrajectory_GetResult_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[FollowJointTrajectory_GetResult_Request] = ...,
        response: list[FollowJointTrajectory_GetResult_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class FollowJointTrajectory_GetResult(
    Service[
        FollowJointTrajectory_GetResult_Request,
        FollowJointTrajectory_GetResult_Response,
    ]
):
    Request: TypeAlias = FollowJointTrajectory_GetResult_Request
    Response: TypeAlias = FollowJointTrajectory_GetResult_Response
    Event: TypeAlias = FollowJointTrajectory_GetResult_Event

class FollowJointTrajectory(
    Action[
        FollowJointTrajectory_Goal,
        FollowJointTrajectory_Result,
        FollowJointTrajectory_Feedback,
    ]
):
    Goal: TypeAlias = FollowJointTrajectory_Goal
    Result: TypeAlias = FollowJointTrajectory_Result
    Feedback: TypeAlias = FollowJointTrajectory_Feedback
    class Impl:
        SendGoalService: TypeAlias = FollowJointTrajectory_SendGoal
        GetResultService: TypeAlias = FollowJointTrajectory_GetResult
        FeedbackMessage: TypeAlias = FollowJointTrajectory_FeedbackMessage
        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal
        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray

class GripperCommand_Goal(Message):
    command: control_msgs.msg.GripperCommand
    def __init__(
        self,
        *,
        command: control_msgs.msg.GripperCommand = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GripperCommand_Result(Message):
    position: float
    effort: float
    stalled: bool
    reached_goal: bool
    def __init__(
        self,
        *,
        position: float = ...,
        effort: float = ...,
        stalled: bool = ...,
        reached_goal: bool = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GripperCommand_Feedback(Message):
    position: float
    effort: float
    stalled: bool
    reached_goal: bool
    def __init__(
        self,
        *,
        position: float = ...,
        effort: float = ...,
        stalled: bool = ...,
        reached_goal: bool = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GripperCommand_FeedbackMessage(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    feedback: GripperCommand_Feedback
    def __init__(
        self,
        *,
        goal_id: unique_identifier_msgs.msg.UUID = ...,
        feedback: GripperCommand_Feedback = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GripperCommand_SendGoal_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    goal: GripperCommand_Goal
    def __init__(
        self,
        *,
        goal_id: unique_identifier_msgs.msg.UUID = ...,
        goal: GripperCommand_Goal = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GripperCommand_SendGoal_Response(Message):
    accepted: bool
    stamp: builtin_interfaces.msg.Time
    def __init__(
        self,
        *,
        accepted: bool = ...,
        stamp: builtin_interfaces.msg.Time = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GripperCommand_SendGoal_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[GripperCommand_SendGoal_Request]
    response: list[GripperCommand_SendGoal_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[GripperCommand_SendGoal_Request] = ...,
        response: list[GripperCommand_SendGoal_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GripperCommand_SendGoal(
    Service[
        GripperCommand_SendGoal_Request,
        GripperCommand_SendGoal_Response,
    ]
):
    Request: TypeAlias = GripperCommand_SendGoal_Request
    Response: TypeAlias = GripperCommand_SendGoal_Response
    Event: TypeAlias = GripperCommand_SendGoal_Event

class GripperCommand_GetResult_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    def __init__(
        self,
        *,
        goal_id: unique_identifier_msgs.msg.UUID = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GripperCommand_GetResult_Response(Message):
    status: int
    result: GripperCommand_Result
    def __init__(
        self,
        *,
        status: int = ...,
        result: GripperCommand_Result = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GripperCommand_GetResult_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[GripperCommand_GetResult_Request]
    response: list[GripperCommand_GetResult_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[GripperCommand_GetResult_Request] = ...,
        response: list[GripperCommand_GetResult_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GripperCommand_GetResult(
    Service[
        GripperCommand_GetResult_Request,
        GripperCommand_GetResult_Response,
    ]
):
    Request: TypeAlias = GripperCommand_GetResult_Request
    Response: TypeAlias = GripperCommand_GetResult_Response
    Event: TypeAlias = GripperCommand_GetResult_Event

class GripperCommand(Action[GripperCommand_Goal, GripperCommand_Result, GripperCommand_Feedback]):
    Goal: TypeAlias = GripperCommand_Goal
    Result: TypeAlias = GripperCommand_Result
    Feedback: TypeAlias = GripperCommand_Feedback
    class Impl:
        SendGoalService: TypeAlias = GripperCommand_SendGoal
        GetResultService: TypeAlias = GripperCommand_GetResult
        FeedbackMessage: TypeAlias = GripperCommand_FeedbackMessage
        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal
        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray

class JointTrajectory_Goal(Message):
    trajectory: trajectory_msgs.msg.JointTrajectory
    def __init__(
        self,
        *,
        trajectory: trajectory_msgs.msg.JointTrajectory = ...,
        check_fields: bool = ...,
    ) -> None: ...

class JointTrajectory_Result(Message):
    def __init__(self, *, check_fields: bool = ...) -> None: ...

class JointTrajectory_Feedback(Message):
    def __init__(self, *, check_fields: bool = ...) -> None: ...

class JointTrajectory_FeedbackMessage(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    feedback: JointTrajectory_Feedback
    def __init__(
        self,
        *,
        goal_id: unique_identifier_msgs.msg.UUID = ...,
        feedback: JointTrajectory_Feedback = ...,
        check_fields: bool = ...,
    ) -> None: ...

class JointTrajectory_SendGoal_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    goal: JointTrajectory_Goal
    def __init__(
        self,
        *,
        goal_id: unique_identifier_msgs.msg.UUID = ...,
        goal: JointTrajectory_Goal = ...,
        check_fields: bool = ...,
    ) -> None: ...

class JointTrajectory_SendGoal_Response(Message):
    accepted: bool
    stamp: builtin_interfaces.msg.Time
    def __init__(
        self,
        *,
        accepted: bool = ...,
        stamp: builtin_interfaces.msg.Time = ...,
        check_fields: bool = ...,
    ) -> None: ...

class JointTrajectory_SendGoal_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[JointTrajectory_SendGoal_Request]
    response: list[JointTrajectory_SendGoal_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[JointTrajectory_SendGoal_Request] = ...,
        response: list[JointTrajectory_SendGoal_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class JointTrajectory_SendGoal(
    Service[
        JointTrajectory_SendGoal_Request,
        JointTrajectory_SendGoal_Response,
    ]
):
    Request: TypeAlias = JointTrajectory_SendGoal_Request
    Response: TypeAlias = JointTrajectory_SendGoal_Response
    Event: TypeAlias = JointTrajectory_SendGoal_Event

class JointTrajectory_GetResult_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    def __init__(
        self,
        *,
        goal_id: unique_identifier_msgs.msg.UUID = ...,
        check_fields: bool = ...,
    ) -> None: ...

class JointTrajectory_GetResult_Response(Message):
    status: int
    result: JointTrajectory_Result
    def __init__(
        self,
        *,
        status: int = ...,
        result: JointTrajectory_Result = ...,
        check_fields: bool = ...,
    ) -> None: ...

class JointTrajectory_GetResult_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[JointTrajectory_GetResult_Request]
    response: list[JointTrajectory_GetResult_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[JointTrajectory_GetResult_Request] = ...,
        response: list[JointTrajectory_GetResult_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class JointTrajectory_GetResult(
    Service[
        JointTrajectory_GetResult_Request,
        JointTrajectory_GetResult_Response,
    ]
):
    Request: TypeAlias = JointTrajectory_GetResult_Request
    Response: TypeAlias = JointTrajectory_GetResult_Response
    Event: TypeAlias = JointTrajectory_GetResult_Event

class JointTrajectory(
    Action[
        JointTrajectory_Goal,
        JointTrajectory_Result,
        JointTrajectory_Feedback,
    ]
):
    Goal: TypeAlias = JointTrajectory_Goal
    Result: TypeAlias = JointTrajectory_Result
    Feedback: TypeAlias = JointTrajectory_Feedback
    class Impl:
        SendGoalService: TypeAlias = JointTrajectory_SendGoal
        GetResultService: TypeAlias = JointTrajectory_GetResult
        FeedbackMessage: TypeAlias = JointTrajectory_FeedbackMessage
        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal
        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray

class ParallelGripperCommand_Goal(Message):
    command: sensor_msgs.msg.JointState
    def __init__(
        self,
        *,
        command: sensor_msgs.msg.JointState = ...,
        check_fields: bool = ...,
    ) -> None: ...

class ParallelGripperCommand_Result(Message):
    state: sensor_msgs.msg.JointState
    stalled: bool
    reached_goal: bool
    def __init__(
        self,
        *,
        state: sensor_msgs.msg.JointState = ...,
        stalled: bool = ...,
        reached_goal: bool = ...,
        check_fields: bool = ...,
    ) -> None: ...

class ParallelGripperCommand_Feedback(Message):
    state: sensor_msgs.msg.JointState
    def __init__(
        self,
        *,
        state: sensor_msgs.msg.JointState = ...,
        check_fields: bool = ...,
    ) -> None: ...

class ParallelGripperCommand_FeedbackMessage(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    feedback: ParallelGripperCommand_Feedback
    def __init__(
        self,
        *,
        goal_id: unique_identifier_msgs.msg.UUID = ...,
        feedback: ParallelGripperCommand_Feedback = ...,
        check_fields: bool = ...,
    ) -> None: ...

class ParallelGripperCommand_SendGoal_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    goal: ParallelGripperCommand_Goal
    def __init__(
        self,
        *,
        goal_id: unique_identifier_msgs.msg.UUID = ...,
        goal: ParallelGripperCommand_Goal = ...,
        check_fields: bool = ...,
    ) -> None: ...

class ParallelGripperCommand_SendGoal_Response(Message):
    accepted: bool
    stamp: builtin_interfaces.msg.Time
    def __init__(
        self,
        *,
        accepted: bool = ...,
        stamp: builtin_interfaces.msg.Time = ...,
        check_fields: bool = ...,
    ) -> None: ...

class ParallelGripperCommand_SendGoal_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[ParallelGripperCommand_SendGoal_Request]
    response: list[ParallelGripperCommand_SendGoal_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[ParallelGripperCommand_SendGoal_Request] = ...,
        response: list[ParallelGripperCommand_SendGoal_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class ParallelGripperCommand_SendGoal(
    Service[
        ParallelGripperCommand_SendGoal_Request,
        ParallelGripperCommand_SendGoal_Response,
    ]
):
    Request: TypeAlias = ParallelGripperCommand_SendGoal_Request
    Response: TypeAlias = ParallelGripperCommand_SendGoal_Response
    Event: TypeAlias = ParallelGripperCommand_SendGoal_Event

class ParallelGripperCommand_GetResult_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    def __init__(
        self,
        *,
        goal_id: unique_identifier_msgs.msg.UUID = ...,
        check_fields: bool = ...,
    ) -> None: ...

class ParallelGripperCommand_GetResult_Response(Message):
    status: int
    result: ParallelGripperCommand_Result
    def __init__(
        self,
        *,
        status: int = ...,
        result: ParallelGripperCommand_Result = ...,
        check_fields: bool = ...,
    ) -> None: ...

class ParallelGripperCommand_GetResult_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[ParallelGripperCommand_GetResult_Request]
    response: list[ParallelGripperCommand_GetResult_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[ParallelGripperCommand_GetResult_Request] = ...,
        response: list[ParallelGripperCommand_GetResult_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class ParallelGripperCommand_GetResult(
    Service[
        ParallelGripperCommand_GetResult_Request,
        ParallelGripperCommand_GetResult_Response,
    ]
):
    Request: TypeAlias = ParallelGripperCommand_GetResult_Request
    Response: TypeAlias = ParallelGripperCommand_GetResult_Response
    Event: TypeAlias = ParallelGripperCommand_GetResult_Event

class ParallelGripperCommand(
    Action[
        ParallelGripperCommand_Goal,
        ParallelGripperCommand_Result,
        ParallelGripperCommand_Feedback,
    ]
):
    Goal: TypeAlias = ParallelGripperCommand_Goal
    Result: TypeAlias = ParallelGripperCommand_Result
    Feedback: TypeAlias = ParallelGripperCommand_Feedback
    class Impl:
        SendGoalService: TypeAlias = ParallelGripperCommand_SendGoal
        GetResultService: TypeAlias = ParallelGripperCommand_GetResult
        FeedbackMessage: TypeAlias = ParallelGripperCommand_FeedbackMessage
        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal
        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray

class PointHead_Goal(Message):
    target: geometry_msgs.msg.PointStamped
    pointing_axis: geometry_msgs.msg.Vector3
    pointing_frame: str
    min_duration: builtin_interfaces.msg.Duration
    max_velocity: float
    def __init__(
        self,
        *,
        target: geometry_msgs.msg.PointStamped = ...,
        pointing_axis: geometry_msgs.msg.Vector3 = ...,
        pointing_frame: str = ...,
        min_duration: builtin_interfaces.msg.Duration = ...,
        max_velocity: float = ...,
        check_fields: bool = ...,
    ) -> None: ...

class PointHead_Result(Message):
    def __init__(self, *, check_fields: bool = ...) -> None: ...

class PointHead_Feedback(Message):
    pointing_angle_error: float
    def __init__(self, *, pointing_angle_error: float = ..., check_fields: bool = ...) -> None: ...

class PointHead_FeedbackMessage(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    feedback: PointHead_Feedback
    def __init__(
        self,
        *,
        goal_id: unique_identifier_msgs.msg.UUID = ...,
        feedback: PointHead_Feedback = ...,
        check_fields: bool = ...,
    ) -> None: ...

class PointHead_SendGoal_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    goal: PointHead_Goal
    def __init__(
        self,
        *,
        goal_id: unique_identifier_msgs.msg.UUID = ...,
        goal: PointHead_Goal = ...,
        check_fields: bool = ...,
    ) -> None: ...

class PointHead_SendGoal_Response(Message):
    accepted: bool
    stamp: builtin_interfaces.msg.Time
    def __init__(
        self,
        *,
        accepted: bool = ...,
        stamp: builtin_interfaces.msg.Time = ...,
        check_fields: bool = ...,
    ) -> None: ...

class PointHead_SendGoal_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[PointHead_SendGoal_Request]
    response: list[PointHead_SendGoal_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[PointHead_SendGoal_Request] = ...,
        response: list[PointHead_SendGoal_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class PointHead_SendGoal(Service[PointHead_SendGoal_Request, PointHead_SendGoal_Response]):
    Request: TypeAlias = PointHead_SendGoal_Request
    Response: TypeAlias = PointHead_SendGoal_Response
    Event: TypeAlias = PointHead_SendGoal_Event

class PointHead_GetResult_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    def __init__(
        self,
        *,
        goal_id: unique_identifier_msgs.msg.UUID = ...,
        check_fields: bool = ...,
    ) -> None: ...

class PointHead_GetResult_Response(Message):
    status: int
    result: PointHead_Result
    def __init__(
        self,
        *,
        status: int = ...,
        result: PointHead_Result = ...,
        check_fields: bool = ...,
    ) -> None: ...

class PointHead_GetResult_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[PointHead_GetResult_Request]
    response: list[PointHead_GetResult_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[PointHead_GetResult_Request] = ...,
        response: list[PointHead_GetResult_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class PointHead_GetResult(Service[PointHead_GetResult_Request, PointHead_GetResult_Response]):
    Request: TypeAlias = PointHead_GetResult_Request
    Response: TypeAlias = PointHead_GetResult_Response
    Event: TypeAlias = PointHead_GetResult_Event

class PointHead(Action[PointHead_Goal, PointHead_Result, PointHead_Feedback]):
    Goal: TypeAlias = PointHead_Goal
    Result: TypeAlias = PointHead_Result
    Feedback: TypeAlias = PointHead_Feedback
    class Impl:
        SendGoalService: TypeAlias = PointHead_SendGoal
        GetResultService: TypeAlias = PointHead_GetResult
        FeedbackMessage: TypeAlias = PointHead_FeedbackMessage
        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal
        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray

class SingleJointPosition_Goal(Message):
    position: float
    min_duration: builtin_interfaces.msg.Duration
    max_velocity: float
    def __init__(
        self,
        *,
        position: float = ...,
        min_duration: builtin_interfaces.msg.Duration = ...,
        max_velocity: float = ...,
        check_fields: bool = ...,
    ) -> None: ...

class SingleJointPosition_Result(Message):
    def __init__(self, *, check_fields: bool = ...) -> None: ...

class SingleJointPosition_Feedback(Message):
    header: std_msgs.msg.Header
    position: float
    velocity: float
    error: float
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        position: float = ...,
        velocity: float = ...,
        error: float = ...,
        check_fields: bool = ...,
    ) -> None: ...

class SingleJointPosition_FeedbackMessage(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    feedback: SingleJointPosition_Feedback
    def __init__(
        self,
        *,
        goal_id: unique_identifier_msgs.msg.UUID = ...,
        feedback: SingleJointPosition_Feedback = ...,
        check_fields: bool = ...,
    ) -> None: ...

class SingleJointPosition_SendGoal_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    goal: SingleJointPosition_Goal
    def __init__(
        self,
        *,
        goal_id: unique_identifier_msgs.msg.UUID = ...,
        goal: SingleJointPosition_Goal = ...,
        check_fields: bool = ...,
    ) -> None: ...

class SingleJointPosition_SendGoal_Response(Message):
    accepted: bool
    stamp: builtin_interfaces.msg.Time
    def __init__(
        self,
        *,
        accepted: bool = ...,
        stamp: builtin_interfaces.msg.Time = ...,
        check_fields: bool = ...,
    ) -> None: ...

class SingleJointPosition_SendGoal_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[SingleJointPosition_SendGoal_Request]
    response: list[SingleJointPosition_SendGoal_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[SingleJointPosition_SendGoal_Request] = ...,
        response: list[SingleJointPosition_SendGoal_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class SingleJointPosition_SendGoal(
    Service[
        SingleJointPosition_SendGoal_Request,
        SingleJointPosition_SendGoal_Response,
    ]
):
    Request: TypeAlias = SingleJointPosition_SendGoal_Request
    Response: TypeAlias = SingleJointPosition_SendGoal_Response
    Event: TypeAlias = SingleJointPosition_SendGoal_Event

class SingleJointPosition_GetResult_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    def __init__(
        self,
        *,
        goal_id: unique_identifier_msgs.msg.UUID = ...,
        check_fields: bool = ...,
    ) -> None: ...

class SingleJointPosition_GetResult_Response(Message):
    status: int
    result: SingleJointPosition_Result
    def __init__(
        self,
        *,
        status: int = ...,
        result: SingleJointPosition_Result = ...,
        check_fields: bool = ...,
    ) -> None: ...

class SingleJointPosition_GetResult_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[SingleJointPosition_GetResult_Request]
    response: list[SingleJointPosition_GetResult_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[SingleJointPosition_GetResult_Request] = ...,
        response: list[SingleJointPosition_GetResult_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class SingleJointPosition_GetResult(
    Service[
        SingleJointPosition_GetResult_Request,
        SingleJointPosition_GetResult_Response,
    ]
):
    Request: TypeAlias = SingleJointPosition_GetResult_Request
    Response: TypeAlias = SingleJointPosition_GetResult_Response
    Event: TypeAlias = SingleJointPosition_GetResult_Event

class SingleJointPosition(
    Action[
        SingleJointPosition_Goal,
        SingleJointPosition_Result,
        SingleJointPosition_Feedback,
    ]
):
    Goal: TypeAlias = SingleJointPosition_Goal
    Result: TypeAlias = SingleJointPosition_Result
    Feedback: TypeAlias = SingleJointPosition_Feedback
    class Impl:
        SendGoalService: TypeAlias = SingleJointPosition_SendGoal
        GetResultService: TypeAlias = SingleJointPosition_GetResult
        FeedbackMessage: TypeAlias = SingleJointPosition_FeedbackMessage
        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal
        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray
