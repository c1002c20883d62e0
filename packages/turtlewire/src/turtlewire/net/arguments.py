"""Checks of the arguments of a connection."""

from __future__ import annotations

from turtlewire import msg

__all__ = ["check_type", "message_type"]


def message_type(topic: object, given: object, caller: str) -> type[msg.Message]:
    """Return the class of the messages of a topic, by itself or by its name.

    Args:
        topic: The topic; only to find out whether it was swapped with the type.
        given: The class or its name.
        caller: The method of the connection that was called.

    Raises:
        InterfaceError: The type does not exist.
        TypeError: ``given`` is something else, topic and type are swapped, or the topic is not a
            str.
    """
    if _looks_like_a_type(topic) and isinstance(given, str) and not _looks_like_a_type(given):
        shown = topic.__name__ if isinstance(topic, type) else repr(topic)
        raise TypeError(f"topic and type are swapped: write {caller}({given!r}, {shown})")
    check_type("topic", topic, str)
    if isinstance(given, str):
        return msg.get_message(given)
    if isinstance(given, type) and issubclass(given, msg.Message):
        return given
    if caller == "subscribe" and callable(given) and not isinstance(given, type):
        raise TypeError("subscribe() takes no callback; write `for message in subscription`")
    shown = f"the class {given.__name__}" if isinstance(given, type) else type(given).__name__
    raise TypeError(
        "type must be a class of messages or its name, for example 'std_msgs/msg/String', not "
        f"{shown}"
    )


def _looks_like_a_type(value: object) -> bool:
    if isinstance(value, str):
        parts = value.split("/")
        return len(parts) == 3 and all(parts) and parts[1] == "msg"
    return isinstance(value, type) and issubclass(value, msg.Message)


def check_type(argument: str, value: object, wanted: type) -> None:
    """Raise TypeError if an argument is of another type."""
    if not isinstance(value, wanted):
        home = "" if wanted.__module__ == "builtins" else f"{wanted.__module__}."
        advice = "; write QoS(depth=...)" if argument == "qos" and isinstance(value, int) else ""
        given = type(value).__name__
        raise TypeError(f"{argument} must be {home}{wanted.__name__}, not {given}{advice}")
