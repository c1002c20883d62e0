"""The message class of a topic."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ros2cli.direct_node import DirectNode

__all__ = ["message_class", "type_of_topic"]


def message_class(type_name: str) -> Any:
    """Return the class of a message.

    Raises:
        RuntimeError: The name is unknown.
    """
    from rosidl_runtime_py.utilities import get_message

    try:
        return get_message(type_name)
    except (AttributeError, ModuleNotFoundError, ValueError):
        from ros2cli.suggestion import interface_meant

        raise RuntimeError(
            f"The passed message type is invalid{interface_meant(type_name, 'msg')}"
        ) from None


def type_of_topic(direct: DirectNode, topic: str, *, blocking: bool = False) -> Any:
    """Return the message class of a topic that has publishers or subscriptions.

    Args:
        direct: The node that asks.
        topic: Full name of the topic.
        blocking: Wait for the topic to appear.

    Returns:
        The class, or None if there is no such topic.

    Raises:
        RuntimeError: The topic has several types, or a type that is not installed.
    """
    graph = direct.graph
    types = graph.topic_names_and_types().get(topic, [])
    if not types:
        print(f"WARNING: topic [{topic}] does not appear to be published yet")
        from ros2cli.suggestion import say_what_was_meant

        say_what_was_meant(topic, graph.topic_names_and_types())
        if not blocking:
            return None
        direct.wait_for(lambda: bool(graph.topic_names_and_types().get(topic)))
        types = graph.topic_names_and_types()[topic]
    if len(types) > 1:
        raise RuntimeError(
            f"Cannot echo topic '{topic}', as it contains more than one type: [{', '.join(types)}]"
        )
    try:
        return message_class(types[0])
    except RuntimeError:
        raise RuntimeError(f"The message type '{types[0]}' is invalid") from None
