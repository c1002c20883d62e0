"""``ros2 topic``."""

from __future__ import annotations

from ros2cli.listing import hidden_argument

__all__ = ["ARGUMENTS", "VERBS"]

VERBS = {
    "bw": "Show the bandwidth of a topic",
    "delay": "Show the delay of a topic, by the stamps in its headers",
    "echo": "Show the messages of a topic",
    "find": "List the topics of a type",
    "hz": "Show the rate of a topic",
    "info": "Show who publishes and subscribes to a topic",
    "list": "List the topics",
    "pub": "Publish messages to a topic",
    "type": "Show the type of a topic",
}


ARGUMENTS = (hidden_argument("topic"),)
