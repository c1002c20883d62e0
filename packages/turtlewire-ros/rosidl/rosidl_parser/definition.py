"""The parts of interfaces: types of fields, structures, messages, services and actions.

`SLOT_TYPES` of message classes consists of the engine's types.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from rosidl_parser.idl_file import IdlContent, IdlFile, IdlLocator, Include
from turtlewire.msg.types import (
    AbstractGenericString,
    AbstractNestableType,
    AbstractNestedType,
    AbstractSequence,
    AbstractString,
    AbstractType,
    AbstractWString,
    Array,
    BasicType,
    BoundedSequence,
    BoundedString,
    BoundedWString,
    NamedType,
    NamespacedType,
    UnboundedSequence,
    UnboundedString,
    UnboundedWString,
)

__all__ = [
    "ACTION_FEEDBACK_MESSAGE_SUFFIX",
    "ACTION_FEEDBACK_SUFFIX",
    "ACTION_GOAL_SERVICE_SUFFIX",
    "ACTION_GOAL_SUFFIX",
    "ACTION_RESULT_SERVICE_SUFFIX",
    "ACTION_RESULT_SUFFIX",
    "BASIC_TYPES",
    "BOOLEAN_TYPE",
    "CHARACTER_TYPES",
    "CONSTANT_MODULE_SUFFIX",
    "EMPTY_STRUCTURE_REQUIRED_MEMBER_NAME",
    "EXPLICIT_INTEGER_TYPES",
    "FLOATING_POINT_TYPES",
    "INTEGER_TYPES",
    "NONEXPLICIT_INTEGER_TYPES",
    "OCTET_TYPE",
    "SERVICE_EVENT_MESSAGE_SUFFIX",
    "SERVICE_REQUEST_MESSAGE_SUFFIX",
    "SERVICE_RESPONSE_MESSAGE_SUFFIX",
    "SIGNED_EXPLICIT_INTEGER_TYPES",
    "SIGNED_INTEGER_TYPES",
    "SIGNED_NONEXPLICIT_INTEGER_TYPES",
    "UNSIGNED_EXPLICIT_INTEGER_TYPES",
    "UNSIGNED_INTEGER_TYPES",
    "UNSIGNED_NONEXPLICIT_INTEGER_TYPES",
    "AbstractGenericString",
    "AbstractNestableType",
    "AbstractNestedType",
    "AbstractSequence",
    "AbstractString",
    "AbstractType",
    "AbstractWString",
    "Action",
    "Annotatable",
    "Annotation",
    "Array",
    "BasicType",
    "BoundedSequence",
    "BoundedString",
    "BoundedWString",
    "Constant",
    "IdlContent",
    "IdlFile",
    "IdlLocator",
    "Include",
    "Member",
    "Message",
    "NamedType",
    "NamespacedType",
    "Service",
    "Structure",
    "UnboundedSequence",
    "UnboundedString",
    "UnboundedWString",
]

SIGNED_NONEXPLICIT_INTEGER_TYPES = ("short", "long", "long long")
UNSIGNED_NONEXPLICIT_INTEGER_TYPES = ("unsigned short", "unsigned long", "unsigned long long")
NONEXPLICIT_INTEGER_TYPES = SIGNED_NONEXPLICIT_INTEGER_TYPES + UNSIGNED_NONEXPLICIT_INTEGER_TYPES
SIGNED_EXPLICIT_INTEGER_TYPES = ("int8", "int16", "int32", "int64")
UNSIGNED_EXPLICIT_INTEGER_TYPES = ("uint8", "uint16", "uint32", "uint64")
EXPLICIT_INTEGER_TYPES = SIGNED_EXPLICIT_INTEGER_TYPES + UNSIGNED_EXPLICIT_INTEGER_TYPES
SIGNED_INTEGER_TYPES = SIGNED_NONEXPLICIT_INTEGER_TYPES + SIGNED_EXPLICIT_INTEGER_TYPES
UNSIGNED_INTEGER_TYPES = UNSIGNED_NONEXPLICIT_INTEGER_TYPES + UNSIGNED_EXPLICIT_INTEGER_TYPES
INTEGER_TYPES = SIGNED_INTEGER_TYPES + UNSIGNED_INTEGER_TYPES
FLOATING_POINT_TYPES = ("float", "double", "long double")
CHARACTER_TYPES = ("char", "wchar")
BOOLEAN_TYPE = "boolean"
OCTET_TYPE = "octet"
BASIC_TYPES = (*INTEGER_TYPES, *FLOATING_POINT_TYPES, *CHARACTER_TYPES, BOOLEAN_TYPE, OCTET_TYPE)

EMPTY_STRUCTURE_REQUIRED_MEMBER_NAME = "structure_needs_at_least_one_member"
CONSTANT_MODULE_SUFFIX = "_Constants"
SERVICE_REQUEST_MESSAGE_SUFFIX = "_Request"
SERVICE_RESPONSE_MESSAGE_SUFFIX = "_Response"
SERVICE_EVENT_MESSAGE_SUFFIX = "_Event"
ACTION_GOAL_SUFFIX = "_Goal"
ACTION_RESULT_SUFFIX = "_Result"
ACTION_FEEDBACK_SUFFIX = "_Feedback"
ACTION_GOAL_SERVICE_SUFFIX = "_SendGoal"
ACTION_RESULT_SERVICE_SUFFIX = "_GetResult"
ACTION_FEEDBACK_MESSAGE_SUFFIX = "_FeedbackMessage"


class Annotation:
    """A name and a value that stand before a definition, for example ``@unit(value="m")``.

    Attributes:
        name: The name.
        value: The value; several values by name are a dictionary.
    """

    __slots__ = ("name", "value")

    def __init__(self, name: str, value: Any) -> None:
        self.name = name
        self.value = value


class Annotatable:
    """Base of the definitions that may have annotations.

    Attributes:
        annotations: The annotations in their order.
    """

    __slots__ = ("annotations",)

    def __init__(self) -> None:
        self.annotations: list[Annotation] = []

    def get_annotation_value(self, name: str) -> Any:
        """Return the value of the only annotation of a name.

        Raises:
            ValueError: No annotation has the name, or several have.
        """
        (value,) = self.get_annotation_values(name)
        return value

    def get_annotation_values(self, name: str) -> list[Any]:
        """Return the values of the annotations of a name."""
        return [each.value for each in self.annotations if each.name == name]

    def get_comment_lines(self) -> list[str]:
        """Return the lines of the comments."""
        texts = [
            value["text"]
            for value in self.get_annotation_values("verbatim")
            if value.get("language") == "comment"
        ]
        return [line for text in texts for line in text.splitlines()]

    def has_annotation(self, name: str) -> bool:
        """Return True if there is exactly one annotation of a name."""
        return len(self.get_annotation_values(name)) == 1

    def has_annotations(self, name: str) -> bool:
        """Return True if there is an annotation of a name."""
        return bool(self.get_annotation_values(name))


class Member(Annotatable):
    """A field of a structure.

    Attributes:
        type: Its type.
        name: Its name.
    """

    __slots__ = ("name", "type")

    def __init__(self, type_: AbstractType, name: str) -> None:
        super().__init__()
        self.type = type_
        self.name = name


class Structure(Annotatable):
    """Fields under a name.

    Attributes:
        namespaced_type: The name.
        members: The fields in their order.
    """

    __slots__ = ("members", "namespaced_type")

    def __init__(
        self, namespaced_type: NamespacedType, members: Iterable[Member] | None = None
    ) -> None:
        super().__init__()
        self.namespaced_type = namespaced_type
        self.members = list(members or ())

    def has_any_member_with_annotation(self, name: str) -> bool:
        """Return True if one of the fields has exactly one annotation of a name."""
        return any(member.has_annotation(name) for member in self.members)


class Constant(Annotatable):
    """A constant.

    Attributes:
        name: Its name.
        type: Its type.
        value: Its value.
    """

    __slots__ = ("name", "type", "value")

    def __init__(self, name: str, type_: AbstractType, value: Any) -> None:
        super().__init__()
        self.name = name
        self.type = type_
        self.value = value


class Message:
    """A structure and its constants.

    Attributes:
        structure: The structure.
        constants: The constants.
    """

    __slots__ = ("constants", "structure")

    def __init__(self, structure: Structure) -> None:
        self.structure = structure
        self.constants: list[Constant] = []


class Service:
    """A request and a response, and the event that follows from them.

    Attributes:
        namespaced_type: Name of the service.
        request_message: The request.
        response_message: The response.
        event_message: What service introspection publishes.
    """

    __slots__ = ("event_message", "namespaced_type", "request_message", "response_message")

    def __init__(
        self, namespaced_type: NamespacedType, request: Message, response: Message
    ) -> None:
        self.namespaced_type = namespaced_type
        self.request_message = request
        self.response_message = response
        kinds = [each.structure.namespaced_type for each in (request, response)]
        self.event_message = _message(
            namespaced_type,
            SERVICE_EVENT_MESSAGE_SUFFIX,
            info=NamespacedType(("service_msgs", "msg"), "ServiceEventInfo"),
            # At most one: without `contents`, introspection leaves them out.
            request=BoundedSequence(kinds[0], 1),
            response=BoundedSequence(kinds[1], 1),
        )


class Action:
    """Goal, result and feedback, and the services and the message that carry them.

    Attributes:
        namespaced_type: Name of the action.
        goal: The goal.
        result: The result.
        feedback: The feedback.
        send_goal_service: The service that sends a goal.
        get_result_service: The service that waits for its result.
        feedback_message: The feedback with the id of its goal.
        implicit_includes: The files that these need.
    """

    __slots__ = (
        "feedback",
        "feedback_message",
        "get_result_service",
        "goal",
        "implicit_includes",
        "namespaced_type",
        "result",
        "send_goal_service",
    )

    def __init__(
        self, namespaced_type: NamespacedType, goal: Message, result: Message, feedback: Message
    ) -> None:
        self.namespaced_type = namespaced_type
        self.goal = goal
        self.result = result
        self.feedback = feedback
        goal_id = NamespacedType(("unique_identifier_msgs", "msg"), "UUID")
        stamp = NamespacedType(("builtin_interfaces", "msg"), "Time")
        goal_type, result_type, feedback_type = (
            each.structure.namespaced_type for each in (goal, result, feedback)
        )
        name = _named(namespaced_type, ACTION_GOAL_SERVICE_SUFFIX)
        self.send_goal_service = Service(
            name,
            _message(name, SERVICE_REQUEST_MESSAGE_SUFFIX, goal_id=goal_id, goal=goal_type),
            _message(
                name,
                SERVICE_RESPONSE_MESSAGE_SUFFIX,
                accepted=BasicType(BOOLEAN_TYPE),
                stamp=stamp,
            ),
        )
        name = _named(namespaced_type, ACTION_RESULT_SERVICE_SUFFIX)
        self.get_result_service = Service(
            name,
            _message(name, SERVICE_REQUEST_MESSAGE_SUFFIX, goal_id=goal_id),
            _message(
                name,
                SERVICE_RESPONSE_MESSAGE_SUFFIX,
                status=BasicType("int8"),
                result=result_type,
            ),
        )
        self.feedback_message = _message(
            namespaced_type,
            ACTION_FEEDBACK_MESSAGE_SUFFIX,
            goal_id=goal_id,
            feedback=feedback_type,
        )
        # The file of an action does not include them, because its text does not mention them.
        self.implicit_includes = [
            Include(f"{'/'.join(each.namespaced_name())}.idl") for each in (stamp, goal_id)
        ]


def _named(type_: NamespacedType, suffix: str) -> NamespacedType:
    return NamespacedType(type_.namespaces, f"{type_.name}{suffix}")


def _message(type_: NamespacedType, suffix: str, **members: AbstractType) -> Message:
    found = [Member(kind, name) for name, kind in members.items()]
    return Message(Structure(_named(type_, suffix), found))
