"""ROS names: their rules, their expansion, and their spelling in the middleware.

A name travels in three spellings::

    as typed   pose, ~/pose or {ns}/pose, which expand_topic_name() expands
    ROS        /turtle1/pose     turtlesim/msg/Pose            /spawn
    DDS        rt/turtle1/pose   turtlesim::msg::dds_::Pose_   rq/spawnRequest, rr/spawnReply

The checks return the texts and the index of ROS 2's validators; rclpy raises the errors.
"""

from __future__ import annotations

import re
from typing import NamedTuple

_TOPIC_MAX = 247
_NAMESPACE_MAX = 245
_NODE_MAX = 255

_UNMATCHED_BRACE = "topic name must not have unmatched (unbalanced) curly braces '{}'"
_NOT_IN_NODE = re.compile(r"[^A-Za-z0-9_]")
_NOT_IN_FULL_TOPIC = re.compile(r"[^A-Za-z0-9_/]")
_BAD_TOKEN_START = re.compile(r"/[/0-9]")
_DIGIT_AFTER_SLASH = re.compile(r"/[0-9]")
_SUBSTITUTION = re.compile(r"\{[^}]*\}")
_DDS_TYPE = re.compile(r"(.+)::dds_::([^:]+)_")


class NameFault(NamedTuple):
    """The reason why a name is not valid.

    Attributes:
        message: ROS 2's text, for example ``topic name must not be empty string``.
        invalid_index: Position in the name where it goes wrong.
    """

    message: str
    invalid_index: int


def validate_topic_name(name: str) -> NameFault | None:
    """Check a topic or service name as a user types it.

    Relative, private (``~``) and with substitutions allowed.
    """
    if not name:
        return NameFault("topic name must not be empty string", 0)
    if _is_digit(name[0]):
        return NameFault("topic name token must not start with a number", 0)
    if name.endswith("/"):
        return NameFault("topic name must not end with a forward slash", len(name) - 1)
    return _check_braces_and_characters(name) or _check_tokens(name)


def _check_braces_and_characters(name: str) -> NameFault | None:
    opened = None  # index of the brace that is open
    for index, char in enumerate(name):
        message = (
            _fault_in_braces(char, index - opened)
            if opened is not None
            else _fault_outside_braces(char, index)
        )
        if message:
            return NameFault(message, index)
        if char == "{":
            opened = index
        elif char == "}":
            opened = None
    return None if opened is None else NameFault(_UNMATCHED_BRACE, opened)


def _fault_outside_braces(char: str, index: int) -> str:
    if char == "~":
        return (
            "topic name must not have tilde '~' unless it is the first character" if index else ""
        )
    if char == "}":
        return _UNMATCHED_BRACE
    allowed = _is_word(char) or char in "/{"
    return (
        ""
        if allowed
        else "topic name must not contain characters other than alphanumerics, '_', '~', '{', or "
        "'}'"
    )


def _fault_in_braces(char: str, distance: int) -> str:
    if distance == 1 and _is_digit(char):
        return "substitution name must not start with a number"
    return (
        ""
        if _is_word(char) or char == "}"
        else "substitution name must not contain characters other than alphanumerics or '_'"
    )


def _check_tokens(name: str) -> NameFault | None:
    if name[0] == "~" and len(name) > 1 and name[1] != "/":
        return NameFault(
            "topic name must not have a tilde '~' that is not followed by a forward slash '/'", 1
        )
    digit = _DIGIT_AFTER_SLASH.search(name)
    return (
        NameFault("topic name token must not start with a number", digit.start() + 1)
        if digit
        else None
    )


def validate_full_topic_name(name: str) -> NameFault | None:
    """Check a fully qualified topic or service name (``/turtle1/pose``)."""
    return _check_absolute(
        name, "topic name", "topic name must not end with a '/'"
    ) or _check_length(name, "topic length should not exceed '255U - 8U'", _TOPIC_MAX)


def validate_namespace(namespace: str) -> NameFault | None:
    """Check a namespace: ``/``, or like a fully qualified topic name."""
    if namespace == "/":
        return None
    fault = _check_absolute(
        namespace, "namespace", "namespace must not end with a '/', unless only a '/'"
    )
    text = "namespace should not exceed 'RMW_NAMESPACE_MAX_NAME_LENGTH'"
    return fault or _check_length(namespace, text, _NAMESPACE_MAX)


def validate_node_name(name: str) -> NameFault | None:
    """Check a node's base name (no slashes)."""
    if not name:
        return NameFault("node name must not be empty", 0)
    bad = _NOT_IN_NODE.search(name)
    if bad is not None:
        return NameFault(
            "node name must not contain characters other than alphanumerics or '_'", bad.start()
        )
    if _is_digit(name[0]):
        return NameFault("node name must not start with a number", 0)
    return _check_length(name, f"node name length should not exceed '{_NODE_MAX}'", _NODE_MAX)


def _check_absolute(name: str, what: str, ends_with_slash: str) -> NameFault | None:
    if not name:
        return NameFault(f"{what} must not be empty", 0)
    if name[0] != "/":
        return NameFault(f"{what} must be absolute, it must lead with a '/'", 0)
    if name.endswith("/"):
        return NameFault(ends_with_slash, len(name) - 1)
    bad = _NOT_IN_FULL_TOPIC.search(name)
    if bad:
        return NameFault(
            f"{what} must not contain characters other than alphanumerics, '_', or '/'", bad.start()
        )
    bad = _BAD_TOKEN_START.search(name)
    if bad:
        rest = (
            "contain repeated '/'"
            if bad.group() == "//"
            else "have a token that starts with a number"
        )
        return NameFault(f"{what} must not {rest}", bad.end() - 1)
    return None


def _check_length(name: str, text: str, limit: int) -> NameFault | None:
    """Compare with a limit; ROS 2's ``text`` may name a macro of C instead of the number."""
    return NameFault(text, limit - 1) if len(name) > limit else None


def _is_digit(char: str) -> bool:
    return "0" <= char <= "9"


def _is_word(char: str) -> bool:
    return char == "_" or (char.isascii() and char.isalnum())


def expand_topic_name(name: str, node_name: str, namespace: str) -> str:
    """Expand a topic or service name to its fully qualified form.

    Args:
        name: As typed; already valid by :func:`validate_topic_name`.
        node_name: Base name of the node, for ``~`` and ``{node}``.
        namespace: Namespace of the node, for relative names, ``{ns}`` and ``{namespace}``.

    Raises:
        ValueError: The name has a substitution other than ``{node}``, ``{ns}`` and ``{namespace}``.
    """
    node = fully_qualified_node_name(node_name, namespace)
    if name.startswith("~"):
        name = node + name[1:]
    known = {"{node}": node_name, "{ns}": namespace, "{namespace}": namespace}

    def substitute(match: re.Match[str]) -> str:
        if match.group() not in known:
            raise ValueError(f"unknown substitution: {match.group()}")
        return known[match.group()]

    name = _SUBSTITUTION.sub(substitute, name)
    if name.startswith("/"):
        return name
    return f"{namespace.rstrip('/')}/{name}"


def fully_qualified_node_name(node_name: str, namespace: str) -> str:
    """``("turtle", "/")`` becomes ``/turtle``, ``("turtle", "/ns")`` becomes ``/ns/turtle``."""
    return f"{namespace.rstrip('/')}/{node_name}"


def is_hidden(name: str) -> bool:
    """Return True if tools leave this topic, service or node out by default.

    One of its tokens starts with an underscore.
    """
    return any(token.startswith("_") for token in name.split("/"))


def topic_to_dds(topic: str, *, bare: bool = False) -> str:
    """``/turtle1/pose`` becomes ``rt/turtle1/pose``.

    It stays when ``bare`` (QoS ``avoid_ros_namespace_conventions``).
    """
    return topic if bare else "rt" + topic


def topic_from_dds(dds_topic: str) -> str | None:
    """``rt/turtle1/pose`` becomes ``/turtle1/pose``.

    None when it is not a ROS topic (a service's, or foreign).
    """
    return dds_topic[2:] if dds_topic.startswith("rt/") else None


def request_topic(service: str) -> str:
    """``/spawn`` becomes ``rq/spawnRequest``."""
    return f"rq{service}Request"


def reply_topic(service: str) -> str:
    """``/spawn`` becomes ``rr/spawnReply``."""
    return f"rr{service}Reply"


def service_from_dds(dds_topic: str) -> str | None:
    """``rq/spawnRequest`` and ``rr/spawnReply`` become ``/spawn``; None for other topics."""
    if dds_topic.startswith("rq/") and dds_topic.endswith("Request"):
        return dds_topic[2:-7]
    if dds_topic.startswith("rr/") and dds_topic.endswith("Reply"):
        return dds_topic[2:-5]
    return None


def service_of_requests(dds_topic: str) -> str | None:
    """``rq/spawnRequest`` becomes ``/spawn``; None for other topics, the one of replies as well.

    Its publishers are the clients of the service, its subscriptions the servers.
    """
    return service_from_dds(dds_topic) if dds_topic.startswith("rq/") else None


def type_to_dds(type_name: str) -> str:
    """``turtlesim/msg/Pose`` becomes ``turtlesim::msg::dds_::Pose_``.

    Names that are not ROS names stay unchanged.
    """
    package, _, base = type_name.rpartition("/")
    return f"{package.replace('/', '::')}::dds_::{base}_" if package else type_name


def type_from_dds(dds_type: str) -> str:
    """``turtlesim::msg::dds_::Pose_`` becomes ``turtlesim/msg/Pose``.

    Names that are not ROS names stay unchanged.
    """
    match = _DDS_TYPE.fullmatch(dds_type)
    return f"{match.group(1).replace('::', '/')}/{match.group(2)}" if match else dds_type


def service_type(part_name: str) -> str:
    """``turtlesim/srv/Spawn_Request`` and ``…_Response`` become ``turtlesim/srv/Spawn``."""
    return part_name.removesuffix("_Request").removesuffix("_Response")
