"""From a topic name as typed to a fully qualified one."""

from __future__ import annotations

from turtlewire.wire import names


def expand_topic_name(topic_name: str, node_name: str, node_namespace: str) -> str:
    """Expand a topic or service name.

    ``~/x`` becomes ``/ns/node/x``, ``x`` becomes ``/ns/x``, ``{node}`` and ``{ns}`` are filled in.

    Raises:
        ValueError: A name is invalid.
    """
    for what, name, check in (
        ("topic name", topic_name, names.validate_topic_name),
        ("node name", node_name, names.validate_node_name),
        ("node namespace", node_namespace, names.validate_namespace),
    ):
        fault = check(name)
        if fault is not None:
            raise ValueError(f"{what} '{name}' is invalid: {fault.message}")
    try:
        return names.expand_topic_name(topic_name, node_name, node_namespace)
    except ValueError as error:
        raise ValueError(f"topic name '{topic_name}' is invalid: {error}") from None
