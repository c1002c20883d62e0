"""Topics of the graph and their message classes, QoS on the command line, completions."""

from __future__ import annotations

import argparse
from typing import Any

from ros2cli import completion, qos
from ros2cli.arguments import positive_float, positive_int
from ros2cli.json_lines import remark_printer
from ros2cli.node.direct import DirectNode
from ros2cli.output import tell
from ros2cli.qos import (
    add_qos_arguments,
    choose_qos,
    profile_configure_short_keys,
    qos_profile_from_short_keys,
)
from turtlewire.distro import KILTED, since

__all__ = [
    "TopicMessagePrototypeCompleter",
    "TopicNameCompleter",
    "TopicTypeCompleter",
    "add_qos_arguments",
    "choose_qos",
    "get_msg_class",
    "get_topic_names",
    "get_topic_names_and_types",
    "message_class",
    "message_type_completer",
    "positive_float",
    "positive_int",
    "profile_configure_short_keys",
    "qos_profile_from_short_keys",
    "type_of_topic",
]


def get_topic_names_and_types(
    *, node: Any, include_hidden_topics: bool = False
) -> list[tuple[str, list[str]]]:
    """Return the names and types of the topics that a node sees, sorted by name."""
    from turtlewire.wire.names import is_hidden

    found: list[tuple[str, list[str]]] = node.get_topic_names_and_types()
    return [each for each in found if include_hidden_topics or not is_hidden(each[0])]


def get_topic_names(*, node: Any, include_hidden_topics: bool = False) -> list[str]:
    """Return the names of the topics that a node sees, sorted."""
    found = get_topic_names_and_types(node=node, include_hidden_topics=include_hidden_topics)
    return [name for name, _ in found]


def get_msg_class(
    node: Any,
    topic: str,
    blocking: bool = False,
    include_hidden_topics: bool = False,
) -> Any:
    """Return the message class of a topic; None if there is no such topic.

    Args:
        node: The node that looks.
        topic: Name of the topic; relative to the node's namespace unless it starts with a slash.
        blocking: Whether to wait for the topic.
        include_hidden_topics: Accepted as in ROS 2.

    Raises:
        RuntimeError: The topic has several types, or one that is not installed.
    """
    direct = DirectNode.around(node)
    return type_of_topic(direct, direct.node.resolve_topic_name(topic), blocking=blocking)


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


def type_of_topic(
    direct: DirectNode, topic: str, *, blocking: bool = False, as_json: bool = False
) -> Any:
    """Return the message class of a topic that has publishers or subscriptions.

    Args:
        direct: The node that asks.
        topic: Full name of the topic.
        blocking: Wait for the topic to appear.
        as_json: Print ROS 2's warning about an unknown topic to stderr instead of stdout.

    Returns:
        The class, or None if there is no such topic.

    Raises:
        RuntimeError: The topic has several types, or a type that is not installed.
    """
    graph = direct.graph
    types = graph.topic_names_and_types().get(topic, [])
    if not types:
        remark = remark_printer(as_json=as_json)
        remark(f"WARNING: topic [{topic}] does not appear to be published yet")
        from ros2cli.suggestion import did_you_mean
        from turtlewire.doctor.network import other_domains_hint

        near = did_you_mean(topic, graph.topic_names_and_types()).lstrip("\n")
        # Without a similar name, the publisher may be in another domain.
        hint = near or other_domains_hint(direct.node.context.get_domain_id())
        if hint:
            tell(hint)
        if not blocking:
            return None
        direct.wait_for(lambda: bool(graph.topic_names_and_types().get(topic)))
        types = graph.topic_names_and_types()[topic]
    if len(types) > 1:
        # ROS 2's text, for all verbs and not only `echo`.
        raise RuntimeError(
            f"Cannot echo topic '{topic}', as it contains more than one type: [{', '.join(types)}]"
        )
    try:
        return message_class(types[0])
    except RuntimeError:
        from ros2cli.suggestion import source_meant

        raise RuntimeError(
            f"The message type '{types[0]}' is invalid{source_meant(types[0])}"
        ) from None


class TopicNameCompleter:
    """Offers names of topics to the shell.

    Args:
        include_hidden_topics_key: Attribute of the command line that asks for hidden topics.
    """

    def __init__(self, *, include_hidden_topics_key: str | None = None) -> None:
        self.include_hidden_topics_key = include_hidden_topics_key

    def __call__(self, prefix: str, parsed_args: argparse.Namespace, **kwargs: Any) -> list[str]:
        """Return the names of the topics there are now."""
        hidden = getattr(parsed_args, self.include_hidden_topics_key or "", False)
        with DirectNode(parsed_args) as node:
            return get_topic_names(node=node, include_hidden_topics=hidden)


class TopicTypeCompleter:
    """Offers the type of the topic on the command line to the shell.

    Args:
        topic_name_key: Attribute of the command line that is the topic.
    """

    def __init__(self, *, topic_name_key: str | None = None) -> None:
        self.topic_name_key = topic_name_key

    def __call__(self, prefix: str, parsed_args: argparse.Namespace, **kwargs: Any) -> list[str]:
        """Return the type of the topic, or all messages."""
        topic = getattr(parsed_args, self.topic_name_key or "", None)
        with DirectNode(parsed_args) as node:
            found = get_topic_names_and_types(node=node, include_hidden_topics=True)
        return dict(found).get(topic or "") or message_type_completer()


class TopicMessagePrototypeCompleter:
    """Offers the default values of the message type on the command line to the shell.

    Args:
        topic_type_key: Attribute of the command line that is the type.
    """

    def __init__(self, *, topic_type_key: str | None = None) -> None:
        self.topic_type_key = topic_type_key

    def __call__(self, prefix: str, parsed_args: argparse.Namespace, **kwargs: Any) -> list[str]:
        """Return the default values, as YAML."""
        return completion.prototype("msg", getattr(parsed_args, self.topic_type_key or ""))


def message_type_completer(**kwargs: Any) -> list[str]:
    """Return the full names of all messages."""
    return completion.message_types(**kwargs)


if not since(KILTED):

    def add_qos_arguments(  # type: ignore[misc]  # Jazzy's parameters
        parser: argparse.ArgumentParser, subscribe_or_publish: str, default_profile_str: str
    ) -> None:
        """Add ``--qos-profile``, ``--qos-depth`` and the other policies.

        Args:
            parser: The parser.
            subscribe_or_publish: ``"subscribe"`` or ``"publish"``, for the help.
            default_profile_str: Name of the profile that is used without options, for the help.
        """
        qos.add_qos_arguments(parser, subscribe_or_publish, default_profile_str)
