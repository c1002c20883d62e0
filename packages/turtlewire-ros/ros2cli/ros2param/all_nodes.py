"""Asks the parameter services of many nodes at the same time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ros2cli.output import tell, tell_failed_call
from ros2param.parameters import ParameterCall

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    from ros2cli.node.direct import DirectNode

__all__ = ["ask_all"]


def ask_all(
    direct: DirectNode,
    fields: Mapping[str, Mapping[str, Any]],
    service: str,
    timeout: float,
    *,
    raises: bool = False,
) -> tuple[dict[str, Any], set[str]]:
    """Call a service of all nodes, and print which failed.

    Args:
        direct: The node that asks.
        fields: The fields of the requests, by the names of the nodes that are asked.
        service: Name of the service, for example ``list_parameters``.
        timeout: Seconds to wait for the services, and again for their answers.
        raises: Whether a failure is raised instead of printed.

    Returns:
        The answers, and the nodes that could not be asked or did not answer. A node without the
        service is in neither.

    Raises:
        RuntimeError: A call failed, and ``raises`` is true.
    """
    serving = _serving(direct, fields, service, timeout)
    questions: dict[str, ParameterCall] = {
        name: ParameterCall(direct, name, service, timeout, **request)
        for name, request in fields.items()
        if name in serving
    }
    answers: dict[str, Any] = {}
    failed: set[str] = set()
    # All requests first, so that the nodes answer at the same time.
    for step in ("send", "answer"):
        for name, question in list(questions.items()):
            try:
                answers[name] = getattr(question, step)()
            except RuntimeError as error:  # noqa: PERF203  each node may fail on its own
                if raises:
                    raise
                failed.add(name)
                del questions[name]
                answers.pop(name, None)
                if isinstance(error.__cause__, TimeoutError):
                    tell(str(error))
                else:
                    tell_failed_call(name, error, service)
    return answers, failed


def _serving(direct: DirectNode, nodes: Collection[str], service: str, timeout: float) -> set[str]:
    """Return the nodes that have a service."""
    from ros2cli.graph import services

    def found() -> set[str]:
        known = {name for name, _ in services(direct.graph, hidden=True)}
        return {name for name in nodes if f"{name}/{service}" in known}

    # As in ROS 2, nodes without it are waited for: a node that has just started may be known before
    # its services are.
    direct.graph.wait_for(lambda: len(found()) == len(nodes), int(timeout * 1e9))
    return found()
