"""Parsed interface files.

Fields, constants, and the messages that services and actions imply.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from turtlewire.msg.types import AbstractNestedType, BasicType, BoundedSequence, NamespacedType

if TYPE_CHECKING:
    from turtlewire.msg.types import AbstractType


def split_name(full_name: str) -> tuple[str, str, str]:
    """Split ``"pkg/msg/Name"`` into its three parts."""
    package, kind, name = full_name.split("/")
    return package, kind, name


class Field(NamedTuple):
    """One field of a message.

    Attributes:
        name: The field's name.
        type: Its type.
        default: The default value of the definition as a Python value, or None where the definition
            gives none.
    """

    name: str
    type: AbstractType
    default: Any = None


class Constant(NamedTuple):
    """One constant of a message.

    Attributes:
        name: The constant's name.
        type: Its type.
        value: Its Python value (``bytes`` of length one for ``byte``).
    """

    name: str
    type: AbstractType
    value: Any


class MessageDefinition:
    """A message, or one of the messages that a service or an action consists of.

    Attributes:
        full_name: ``"geometry_msgs/msg/Vector3"``, ``"turtlesim/srv/Spawn_Request"``.
        fields: The fields in order.
        constants: The constants in order.
    """

    __slots__ = ("constants", "fields", "full_name")

    def __init__(
        self, full_name: str, fields: tuple[Field, ...], constants: tuple[Constant, ...] = ()
    ) -> None:
        self.full_name = full_name
        self.fields = fields
        self.constants = constants


def nested_types(definition: MessageDefinition) -> list[str]:
    """Return the names of the messages that are fields of a message, in order."""
    types = (
        field.type.value_type if isinstance(field.type, AbstractNestedType) else field.type
        for field in definition.fields
    )
    return [type_.full_name for type_ in types if isinstance(type_, NamespacedType)]


class ServiceDefinition:
    """A service: its request and response as given, and the event that follows from them.

    Attributes:
        full_name: ``"turtlesim/srv/Spawn"``.
        request: The request.
        response: The response.
        event: What service introspection publishes.
    """

    __slots__ = ("event", "full_name", "request", "response")

    def __init__(
        self, full_name: str, request: MessageDefinition, response: MessageDefinition
    ) -> None:
        self.full_name = full_name
        self.request = request
        self.response = response
        self.event = MessageDefinition(
            f"{full_name}_Event",
            (
                Field("info", NamespacedType.parse("service_msgs/msg/ServiceEventInfo")),
                Field("request", BoundedSequence(NamespacedType.parse(request.full_name), 1)),
                Field("response", BoundedSequence(NamespacedType.parse(response.full_name), 1)),
            ),
        )

    def messages(self) -> tuple[MessageDefinition, ...]:
        """Request, response and event."""
        return (self.request, self.response, self.event)


class ActionDefinition:
    """An action: goal, result and feedback, and the two services and the message that carry them.

    Attributes:
        full_name: ``"turtlesim/action/RotateAbsolute"``.
        goal: The goal.
        result: The result.
        feedback: The feedback.
        send_goal: The service that sends a goal.
        get_result: The service that waits for its result.
        feedback_message: The feedback with the id of its goal.
    """

    __slots__ = (
        "feedback",
        "feedback_message",
        "full_name",
        "get_result",
        "goal",
        "result",
        "send_goal",
    )

    def __init__(
        self,
        full_name: str,
        goal: MessageDefinition,
        result: MessageDefinition,
        feedback: MessageDefinition,
    ) -> None:
        self.full_name = full_name
        self.goal = goal
        self.result = result
        self.feedback = feedback
        goal_id = Field("goal_id", NamespacedType.parse("unique_identifier_msgs/msg/UUID"))
        stamp = Field("stamp", NamespacedType.parse("builtin_interfaces/msg/Time"))
        self.send_goal = ServiceDefinition(
            f"{full_name}_SendGoal",
            MessageDefinition(
                f"{full_name}_SendGoal_Request",
                (goal_id, Field("goal", NamespacedType.parse(goal.full_name))),
            ),
            MessageDefinition(
                f"{full_name}_SendGoal_Response", (Field("accepted", BasicType("boolean")), stamp)
            ),
        )
        self.get_result = ServiceDefinition(
            f"{full_name}_GetResult",
            MessageDefinition(f"{full_name}_GetResult_Request", (goal_id,)),
            MessageDefinition(
                f"{full_name}_GetResult_Response",
                (
                    Field("status", BasicType("int8")),
                    Field("result", NamespacedType.parse(result.full_name)),
                ),
            ),
        )
        self.feedback_message = MessageDefinition(
            f"{full_name}_FeedbackMessage",
            (goal_id, Field("feedback", NamespacedType.parse(feedback.full_name))),
        )

    def messages(self) -> tuple[MessageDefinition, ...]:
        """Return all messages of the action, its services' included."""
        return (
            self.goal,
            self.result,
            self.feedback,
            self.feedback_message,
            *self.send_goal.messages(),
            *self.get_result.messages(),
        )
