"""The names of a node's topics and services: expanded, remapped and checked."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rclpy.exceptions import InvalidServiceNameException, InvalidTopicNameException
from rclpy.impl.hints import described
from turtlewire.wire import names

if TYPE_CHECKING:
    from rclpy._node.state import NodeState


class NameResolver:
    """Makes full names of what a program gives as names."""

    def __init__(self, core: NodeState) -> None:
        self._core = core

    def resolve_topic(self, topic: str, *, only_expand: bool = False) -> str:
        """Return the fully qualified name of a topic, remapped unless ``only_expand``.

        Raises:
            InvalidTopicNameException: The name breaks the rules.
            ValueError: The name has an unknown substitution.
        """
        expanded = self._expand(topic, InvalidTopicNameException)
        if only_expand:
            return expanded
        return self._core.arguments.remap_topic(expanded, self._core.name, self._core.namespace)

    def resolve_service(self, service: str, *, only_expand: bool = False) -> str:
        """Return the fully qualified name of a service, remapped unless ``only_expand``.

        Raises:
            InvalidServiceNameException: The name breaks the rules.
            ValueError: The name has an unknown substitution.
        """
        expanded = self._expand(service, InvalidServiceNameException)
        if only_expand:
            return expanded
        return self._core.arguments.remap_service(expanded, self._core.name, self._core.namespace)

    def _expand(
        self, name: str, error: type[InvalidTopicNameException | InvalidServiceNameException]
    ) -> str:
        if not isinstance(name, str):
            raise TypeError(f"The name of a topic or service is a str, not {described(name)}")
        fault = names.validate_topic_name(name)
        if fault is not None:
            raise error(name, fault.message, fault.invalid_index)
        expanded = names.expand_topic_name(name, self._core.name, self._core.namespace)
        # Substitutions can make a valid name invalid; the error then shows the expanded name.
        fault = names.validate_full_topic_name(expanded)
        if fault is not None:
            raise error(expanded, fault.message, fault.invalid_index)
        return expanded
