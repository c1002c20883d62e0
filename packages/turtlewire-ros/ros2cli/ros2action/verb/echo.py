"""``ros2 action echo``."""

from __future__ import annotations

import argparse
from enum import Enum
from typing import TYPE_CHECKING, Any

from ros2action.verb import VerbExtension
from ros2cli.arguments import argument
from ros2cli.completion import action_names, action_types
from ros2cli.message_text import DEFAULT_TRUNCATE_LENGTH, TEXT_ARGUMENTS, event_text, message_text
from ros2cli.output import tell
from ros2cli.qos import QOS_ARGUMENTS, asked_for, matching_publishers, with_options

if TYPE_CHECKING:
    from rclpy.qos import QoSProfile
    from ros2cli.node.direct import DirectNode

__all__ = ["ARGUMENTS", "DEFAULT_TRUNCATE_LENGTH", "ActionInterfaces", "EchoVerb", "main"]


class ActionInterfaces(Enum):
    """The services and topics of an action."""

    GOAL_SERVICE = "GOAL_SERVICE"
    CANCEL_SERVICE = "CANCEL_SERVICE"
    RESULT_SERVICE = "RESULT_SERVICE"
    FEEDBACK_TOPIC = "FEEDBACK_TOPIC"
    STATUS_TOPIC = "STATUS_TOPIC"


#: The topic of each interface below the action's name, and its type, an attribute of ``Impl``.
_TOPICS = {
    ActionInterfaces.GOAL_SERVICE: ("send_goal/_service_event", "SendGoalService"),
    ActionInterfaces.CANCEL_SERVICE: ("cancel_goal/_service_event", "CancelGoalService"),
    ActionInterfaces.RESULT_SERVICE: ("get_result/_service_event", "GetResultService"),
    ActionInterfaces.FEEDBACK_TOPIC: ("feedback", "FeedbackMessage"),
    ActionInterfaces.STATUS_TOPIC: ("status", "GoalStatusMessage"),
}


ARGUMENTS = (
    argument(
        "action_name",
        help="Name of the action, for example /turtle1/rotate_absolute",
        completer=action_names,
    ),
    argument(
        "action_type",
        nargs="?",
        help="Type of the action (default: the type of the existing action)",
        completer=action_types,
    ),
    *QOS_ARGUMENTS,
    argument(
        "-i",
        "--interfaces",
        metavar="INTERFACES",
        help=f"Show only these, joined by '|': {', '.join(part.value for part in _TOPICS)}",
    ),
    *TEXT_ARGUMENTS,
)


def main(args: argparse.Namespace) -> str | None:
    """Print the messages and events until Ctrl-C."""
    from ros2action.api import get_action_class
    from ros2cli.graph import actions
    from ros2cli.node.direct import DirectNode
    from ros2cli.suggestion import say_what_was_meant, warn_of_other_type

    try:
        interfaces = _chosen(args.interfaces)
    except ValueError as error:
        return str(error)
    # A wrong type is rejected before anything is started.
    action_class = None if args.action_type is None else _class_of_type(args)
    with DirectNode(args) as direct:
        action = direct.node.resolve_topic_name(args.action_name)
        known = dict(actions(direct.graph))
        if action_class is None:
            action_class = get_action_class(direct, action)
        else:
            warn_of_other_type("action", action, args.action_type, known)
            say_what_was_meant(action, known)
        if not sum([_subscribe(direct, action, action_class, each, args) for each in interfaces]):
            _say_that_nothing_is_published(action, interfaces)
        direct.spin()
    return None


def _chosen(text: str | None) -> list[ActionInterfaces]:
    """Return the interfaces in an option, each once; all without the option.

    Raises:
        ValueError: A name is wrong or missing.
    """
    if text is None:
        return list(ActionInterfaces)
    if not text.strip():
        raise ValueError("Input action interface name is empty.")
    chosen = []
    for name in map(str.strip, text.split("|")):
        if name not in ActionInterfaces.__members__:
            from ros2cli.suggestion import did_you_mean

            meant = did_you_mean(name, ActionInterfaces.__members__)
            known = "" if meant else f"\nInterfaces: {', '.join(ActionInterfaces.__members__)}"
            raise ValueError(f'"{name}" is incorrect interface name.{meant}{known}')
        chosen.append(ActionInterfaces[name])
    return list(dict.fromkeys(chosen))


def _class_of_type(args: argparse.Namespace) -> Any:
    from rosidl_runtime_py.utilities import get_action

    try:
        return get_action(args.action_type)
    except (AttributeError, ModuleNotFoundError, ValueError):
        from ros2cli.suggestion import interface_meant

        # ROS 2 names the action here, although the type is wrong.
        wrong = f"The action name '{args.action_name}' is invalid"
        near = interface_meant(args.action_type, "action")
        raise RuntimeError(
            wrong + (near or f"\nThere is no action type '{args.action_type}'")
        ) from None


def _subscribe(
    direct: DirectNode,
    action: str,
    action_class: Any,
    interface: ActionInterfaces,
    args: argparse.Namespace,
) -> int:
    """Print what comes on a topic of an action; return the number of its publishers now."""
    name, kind_name = _TOPICS[interface]
    topic = f"{action}/_action/{name}"
    kind = getattr(action_class.Impl, kind_name)
    is_service = kind_name.endswith("Service")
    text = event_text if is_service else message_text

    def show(message: Any) -> None:
        shown = text(message, args)
        print(
            f"{interface.value},{shown}" if args.csv else f"interface: {interface.value}\n{shown}"
        )

    subscription = direct.node.create_subscription(
        kind.Event if is_service else kind, topic, show, _qos(direct, topic, interface, args)
    )
    return subscription.get_publisher_count()


def _qos(
    direct: DirectNode, topic: str, interface: ActionInterfaces, args: argparse.Namespace
) -> QoSProfile:
    if not asked_for(args) and direct.node.count_publishers(topic):
        return matching_publishers(direct.graph, topic)
    is_status = interface is ActionInterfaces.STATUS_TOPIC
    return with_options(args, "action_status_default" if is_status else "services_default")


def _say_that_nothing_is_published(action: str, interfaces: list[ActionInterfaces]) -> None:
    topics = ", ".join(f"'{action}/_action/{_TOPICS[each][0]}'" for each in interfaces)
    tell(
        f"No publishers on {topics}; is a server of the action running, and, for its services, is"
        " introspection of the client or server enabled?"
    )


class EchoVerb(VerbExtension, module=__name__):
    """Show the goals, results, feedback and states of an action."""
