"""The properties of message and service classes that the middleware needs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Generic, TypeVar

from turtlewire import msg
from turtlewire.wire.base import ServiceTypes, TypeId

from .exceptions import NoTypeSupportImportedException
from .impl.hints import described, with_hint

__all__ = [
    "Action",
    "EventMessage",
    "FeedbackMessage",
    "GetResultServiceRequest",
    "GetResultServiceResponse",
    "Msg",
    "SendGoalServiceRequest",
    "SendGoalServiceResponse",
    "Srv",
    "check_for_type_support",
    "check_is_valid_msg_type",
    "check_is_valid_srv_type",
    "service_types",
    "type_id",
]

if TYPE_CHECKING:
    from builtin_interfaces.msg import Time
    from service_msgs.msg import ServiceEventInfo
    from unique_identifier_msgs.msg import UUID

# The bases of all interface classes, under Kilted's names for annotations.
Msg = msg.Message
Srv = msg.Service
Action = msg.Action

_GoalT = TypeVar("_GoalT")
_ResultT = TypeVar("_ResultT")
_FeedbackT = TypeVar("_FeedbackT")


class EventMessage(msg.Message):
    """Annotates an event of a service, such as ``SetBool.Event``."""

    if TYPE_CHECKING:
        info: ServiceEventInfo


class SendGoalServiceRequest(msg.Message, Generic[_GoalT]):
    """Annotates the request that sends a goal, of an action's ``Impl.SendGoalService``."""

    if TYPE_CHECKING:
        goal_id: UUID
        goal: _GoalT


class SendGoalServiceResponse(msg.Message):
    """Annotates the response to a goal, of an action's ``Impl.SendGoalService``."""

    if TYPE_CHECKING:
        accepted: bool
        stamp: Time


class GetResultServiceRequest(msg.Message):
    """Annotates the request for a result, of an action's ``Impl.GetResultService``."""

    if TYPE_CHECKING:
        goal_id: UUID


class GetResultServiceResponse(msg.Message, Generic[_ResultT]):
    """Annotates the response with a result, of an action's ``Impl.GetResultService``."""

    if TYPE_CHECKING:
        status: int
        result: _ResultT


class FeedbackMessage(msg.Message, Generic[_FeedbackT]):
    """Annotates a message of an action's feedback topic, its ``Impl.FeedbackMessage``."""

    if TYPE_CHECKING:
        goal_id: UUID
        feedback: _FeedbackT


_ROS_1_HINT = (
    " This might be a ROS 1 message type but it should be a ROS 2 message type."
    " Make sure to source your ROS 2 workspace after your ROS 1 workspace."
)


def check_for_type_support(msg_or_srv_type: Any) -> None:
    """Make sure that something is a generated message, service or action class.

    Raises:
        AttributeError: The type is not supported; the message is ROS 2's.
        NoTypeSupportImportedException: ROS 2's own code generator made it, for its C libraries.
    """
    if not isinstance(msg_or_srv_type, type) or not issubclass(
        msg_or_srv_type, (msg.Message, msg.Service, msg.Action)
    ):
        # ROS 2's generator puts this attribute into a metaclass.
        if hasattr(type(msg_or_srv_type), "_TYPE_SUPPORT"):
            raise with_hint(
                NoTypeSupportImportedException(),
                f"{described(msg_or_srv_type)} comes from another ROS 2 installation; remove that "
                "path from PYTHONPATH, or build the package of its definition here",
            )
        kind = type(msg_or_srv_type).__name__
        error = AttributeError(
            f"type object '{kind}' has no attribute '_TYPE_SUPPORT'{_ROS_1_HINT}"
        )
        raise with_hint(
            error, f"Expected a class such as std_msgs.msg.String, not {described(msg_or_srv_type)}"
        )


def check_is_valid_msg_type(msg_type: Any) -> None:
    """Make sure that something is a message class.

    Raises:
        RuntimeError: The type is a service or action class. (AttributeError if it is not an
            interface class.)
    """
    check_for_type_support(msg_type)
    if not issubclass(msg_type, msg.Message):
        raise RuntimeError(  # noqa: TRY004 - ROS 2's
            f"The message type provided is not valid ({msg_type}),"
            " this might be a service or action"
        )


def check_is_valid_srv_type(srv_type: Any) -> None:
    """Make sure that something is a service class.

    Raises:
        RuntimeError: The type is a message or action class. (AttributeError if it is not an
            interface class.)
    """
    check_for_type_support(srv_type)
    if not issubclass(srv_type, msg.Service):
        raise RuntimeError(  # noqa: TRY004 - likewise
            f"The service type provided is not valid ({srv_type}),"
            " this might be a message or action"
        )


def type_id(name: str) -> TypeId:
    """Return a name, such as ``turtlesim/msg/Pose``, with its hash."""
    return TypeId(name, msg.type_hash(name))


def service_types(name: str) -> ServiceTypes:
    """Return the names and hashes by which peers identify the type ``turtlesim/srv/Spawn``."""
    return ServiceTypes(
        name, type_id(f"{name}_Request"), type_id(f"{name}_Response"), msg.type_hash
    )
