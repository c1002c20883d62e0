"""Reads one parameter of one node through its parameter service, like ``ros2 param get``."""

from __future__ import annotations

import logging
from typing import TYPE_CHECKING, Any

from turtlewire import msg
from turtlewire.errors import CdrError, UncallableServiceError
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS
from turtlewire.wire.services import require_callable
from turtlewire_view.service_watch import ServiceWatch
from turtlewire_view.source import ParameterAnswer, ServiceAnswer

if TYPE_CHECKING:
    from collections.abc import Callable

    from turtlewire.wire.base import Context, Node

__all__ = ["ParameterWatch"]

_logger = logging.getLogger(__name__)

_SERVICE = "rcl_interfaces/srv/GetParameters"
_SUFFIX = "/get_parameters"
_EVENTS, _EVENT = "/parameter_events", "rcl_interfaces/msg/ParameterEvent"
#: ROS 2's for the topic of all nodes' parameters.
_EVENTS_QOS = QoS(depth=1000)
#: Types of ParameterValue by number.
_TYPES = (
    "not set", "a bool", "an integer", "a double", "a string", "a byte array", "a bool array",
    "an integer array", "a double array", "a string array",
)  # fmt: skip
_STRING = 4
_MOST_NAMED = 5


class ParameterWatch:
    """Asks for a text parameter when its node appears or announces a change.

    Args:
        context: The participant.
        node: The node that the client belongs to.
        owner: Fully qualified, valid name of the node that has the parameter.
        parameter: The parameter's name.
        on_answer: Called with each answer, in order, on a thread of the watch.
    """

    def __init__(
        self,
        context: Context,
        node: Node,
        owner: str,
        parameter: str,
        on_answer: Callable[[ParameterAnswer], None],
    ) -> None:
        self._context, self._owner, self._parameter = context, owner, parameter
        self._on_answer = on_answer
        self._interface = msg.get_service(_SERVICE)
        self._calls = ServiceWatch(
            context,
            node,
            owner + _SUFFIX,
            _SERVICE,
            msg.serialize(self._interface.Request(names=[parameter])),
            self._take_answer,
            absent=self._absent,
            waiting=f"the node {owner} does not answer yet",
        )
        event = TypeId(_EVENT, msg.type_hash(_EVENT))
        self._events = node.create_subscription(
            _EVENTS, event, _EVENTS_QOS, lambda cdr, _: self._take_event(cdr)
        )

    def close(self) -> None:
        """Ask no more."""
        self._events.close()
        self._calls.close()

    def _take_event(self, cdr: bytes) -> None:
        """Ask again when the parameter has changed: the value itself may be of another type now."""
        try:
            event: Any = msg.deserialize(msg.get_message(_EVENT), cdr)
        except CdrError as error:
            _logger.warning("A message on %s cannot be read: %s", _EVENTS, error)
            return
        changed = [*event.new_parameters, *event.changed_parameters, *event.deleted_parameters]
        if event.node != self._owner or self._parameter not in {each.name for each in changed}:
            return
        self._calls.again()

    def _absent(self) -> str:
        """The reason why no node can be asked, and the candidates."""
        try:
            require_callable(self._context.graph, self._owner + _SUFFIX)
        except UncallableServiceError as error:
            return error.in_one_line()
        services = self._context.graph.service_names_and_types()
        nodes = sorted(name.removesuffix(_SUFFIX) for name in services if name.endswith(_SUFFIX))
        more = f" and {len(nodes) - _MOST_NAMED} more" if len(nodes) > _MOST_NAMED else ""
        there = ", ".join(nodes[:_MOST_NAMED]) + more or "none"
        return f"there is no node {self._owner} with parameters; nodes with parameters: {there}"

    def _take_answer(self, answer: ServiceAnswer) -> None:
        problem = answer.problem
        self._on_answer(ParameterAnswer(problem=problem) if problem else self._answer(answer.cdr))

    def _answer(self, cdr: bytes) -> ParameterAnswer:
        try:
            response: Any = msg.deserialize(self._interface.Response, cdr)
        except CdrError as error:
            return ParameterAnswer(problem=f"the answer of {self._owner} cannot be read: {error}")
        value = response.values[0] if response.values else None
        if value is None or not value.type:
            return ParameterAnswer(
                problem=f"the node {self._owner} has no parameter '{self._parameter}'"
            )
        if value.type != _STRING:
            found = _TYPES[value.type] if value.type < len(_TYPES) else f"of type {value.type}"
            return ParameterAnswer(
                problem=f"the parameter '{self._parameter}' of {self._owner} is {found}, no string"
            )
        return ParameterAnswer(value.string_value)
