"""Types of control_msgs.msg; generated."""

import array
import builtin_interfaces.msg
import std_msgs.msg
import trajectory_msgs.msg
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "DynamicJointState",
    "GripperCommand",
    "InterfaceValue",
    "JointComponentTolerance",
    "JointControllerState",
    "JointJog",
    "JointTolerance",
    "JointTrajectoryControllerState",
    "MultiDOFCommand",
    "MultiDOFStateStamped",
    "PidState",
    "SingleDOFState",
    "SingleDOFStateStamped",
]

class DynamicJointState(Message):
    header: std_msgs.msg.Header
    joint_names: list[str]
    interface_values: list[InterfaceValue]
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        joint_names: list[str] = ...,
        interface_values: list[InterfaceValue] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GripperCommand(Message):
    position: float
    max_effort: float
    def __init__(
        self,
        *,
        position: float = ...,
        max_effort: float = ...,
        check_fields: bool = ...,
    ) -> None: ...

class InterfaceValue(Message):
    interface_names: list[str]
    @property
    def values(self) -> array.array[float]: ...
    @values.setter
    def values(self, value: Iterable[float]) -> None: ...
    def __init__(
        self,
        *,
        interface_names: list[str] = ...,
        values: Iterable[float] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class JointComponentTolerance(Message):
    X_AXIS: ClassVar[int]
    Y_AXIS: ClassVar[int]
    Z_AXIS: ClassVar[int]
    TRANSLATION: ClassVar[int]
    ROTATION: ClassVar[int]
    joint_name: str
    component: int
    position: float
    velocity: float
    acceleration: float
    def __init__(
        self,
        *,
        joint_name: str = ...,
        component: int = ...,
        position: float = ...,
        velocity: float = ...,
        acceleration: float = ...,
        check_fields: bool = ...,
    ) -> None: ...

class JointControllerState(Message):
    header: std_msgs.msg.Header
    set_point: float
    process_value: float
    process_value_dot: float
    error: float
    time_step: float
    command: float
    p: float
    i: float
    d: float
    i_clamp: float
    antiwindup: bool
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        set_point: float = ...,
        process_value: float = ...,
        process_value_dot: float = ...,
        error: float = ...,
        time_step: float = ...,
        command: float = ...,
        p: float = ...,
        i: float = ...,
        d: float = ...,
        i_clamp: float = ...,
        antiwindup: bool = ...,
        check_fields: bool = ...,
    ) -> None: ...

class JointJog(Message):
    header: std_msgs.msg.Header
    joint_names: list[str]
    @property
    def displacements(self) -> array.array[float]: ...
    @displacements.setter
    def displacements(self, value: Iterable[float]) -> None: ...
    @property
    def velocities(self) -> array.array[float]: ...
    @velocities.setter
    def velocities(self, value: Iterable[float]) -> None: ...
    duration: float
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        joint_names: list[str] = ...,
        displacements: Iterable[float] = ...,
        velocities: Iterable[float] = ...,
        duration: float = ...,
        check_fields: bool = ...,
    ) -> None: ...

class JointTolerance(Message):
    name: str
    position: float
    velocity: float
    acceleration: float
    def __init__(
        self,
        *,
        name: str = ...,
        position: float = ...,
        velocity: float = ...,
        acceleration: float = ...,
        check_fields: bool = ...,
    ) -> None: ...

class JointTrajectoryControllerState(Message):
    header: std_msgs.msg.Header
    joint_names: list[str]
    reference: trajectory_msgs.msg.JointTrajectoryPoint
    feedback: trajectory_msgs.msg.JointTrajectoryPoint
    error: trajectory_msgs.msg.JointTrajectoryPoint
    output: trajectory_msgs.msg.JointTrajectoryPoint
    multi_dof_joint_names: list[str]
    multi_dof_reference: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint
    multi_dof_feedback: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint
    multi_dof_error: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint
    multi_dof_output: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        joint_names: list[str] = ...,
        reference: trajectory_msgs.msg.JointTrajectoryPoint = ...,
        feedback: trajectory_msgs.msg.JointTrajectoryPoint = ...,
        error: trajectory_msgs.msg.JointTrajectoryPoint = ...,
        output: trajectory_msgs.msg.JointTrajectoryPoint = ...,
        multi_dof_joint_names: list[str] = ...,
        multi_dof_reference: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint = ...,
        multi_dof_feedback: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint = ...,
        multi_dof_error: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint = ...,
        multi_dof_output: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint = ...,
        check_fields: bool = ...,
    ) -> None: ...

class MultiDOFCommand(Message):
    dof_names: list[str]
    @property
    def values(self) -> array.array[float]: ...
    @values.setter
    def values(self, value: Iterable[float]) -> None: ...
    @property
    def values_dot(self) -> array.array[float]: ...
    @values_dot.setter
    def values_dot(self, value: Iterable[float]) -> None: ...
    def __init__(
        self,
        *,
        dof_names: list[str] = ...,
        values: Iterable[float] = ...,
        values_dot: Iterable[float] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class MultiDOFStateStamped(Message):
    header: std_msgs.msg.Header
    dof_states: list[SingleDOFState]
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        dof_states: list[SingleDOFState] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class PidState(Message):
    header: std_msgs.msg.Header
    timestep: builtin_interfaces.msg.Duration
    error: float
    error_dot: float
    p_error: float
    i_error: float
    d_error: float
    p_term: float
    i_term: float
    d_term: float
    i_max: float
    i_min: float
    output: float
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        timestep: builtin_interfaces.msg.Duration = ...,
        error: float = ...,
        error_dot: float = ...,
        p_error: float = ...,
        i_error: float = ...,
        d_error: float = ...,
        p_term: float = ...,
        i_term: float = ...,
        d_term: float = ...,
        i_max: float = ...,
        i_min: float = ...,
        output: float = ...,
        check_fields: bool = ...,
    ) -> None: ...

class SingleDOFState(Message):
    name: str
    reference: float
    feedback: float
    feedback_dot: float
    error: float
    error_dot: float
    time_step: float
    output: float
    def __init__(
        self,
        *,
        name: str = ...,
        reference: float = ...,
        feedback: float = ...,
        feedback_dot: float = ...,
        error: float = ...,
        error_dot: float = ...,
        time_step: float = ...,
        output: float = ...,
        check_fields: bool = ...,
    ) -> None: ...

class SingleDOFStateStamped(Message):
    header: std_msgs.msg.Header
    dof_state: SingleDOFState
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        dof_state: SingleDOFState = ...,
        check_fields: bool = ...,
    ) -> None: ...
