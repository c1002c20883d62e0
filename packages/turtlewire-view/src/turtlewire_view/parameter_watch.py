"""Reads one parameter of one node through its parameter service, like ``ros2 param get``."""

from __future__ import annotations

import logging
import threading
from collections import deque
from typing import TYPE_CHECKING, Any

from turtlewire import msg
from turtlewire.errors import CdrError, UncallableServiceError, WireError
from turtlewire.wire.base import Client, ServiceTypes, TypeId
from turtlewire.wire.qos import QoS
from turtlewire.wire.services import require_callable
from turtlewire_view.source import ParameterAnswer

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
    """Asks for a text parameter when its node is there, comes again or says that it has changed.

    A separate thread waits for the responses and reports them, without holding a lock.

    Args:
        context: The participant.
        node: Whose client asks.
        owner: Fully qualified, valid name of the node that has the parameter.
        parameter: The parameter's name.
        on_answer: Called with each answer, in their order, on the watch's thread.
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
        self._lock = threading.Lock()
        self._is_there: bool | None = None
        self._asked = 0
        self._answers: deque[ParameterAnswer] = deque()
        self._is_closed = False
        self._interface = msg.get_service(_SERVICE)
        request, response = _type_id(f"{_SERVICE}_Request"), _type_id(f"{_SERVICE}_Response")
        types = ServiceTypes(_SERVICE, request, response, msg.type_hash)
        self._client = node.create_client(owner + _SUFFIX, types, QoS(depth=10))
        self._wait_set = context.create_wait_set()
        self._wait_set.attach(self._client)
        self._thread = threading.Thread(target=self._take, name="view-parameter", daemon=True)
        self._thread.start()
        self._events = node.create_subscription(
            _EVENTS, _type_id(_EVENT), _EVENTS_QOS, lambda cdr, _: self._take_event(cdr)
        )
        self._end = context.graph.add_listener(self._look)
        self._look()

    def close(self) -> None:
        """Ask no more."""
        self._end()
        with self._lock:
            self._is_closed = True
        self._events.close()
        self._wait_set.wake()
        self._thread.join()
        self._client.close()
        self._wait_set.close()

    def _look(self) -> None:
        """The graph has changed: ask when the node has come, say when it is not there."""
        with self._lock:
            is_there = self._client.is_ready()
            if is_there == self._is_there or self._is_closed:
                return
            self._is_there = is_there
            problem = f"the node {self._owner} does not answer yet" if is_there else self._absent()
            self._answers.append(ParameterAnswer(problem=problem))
            if is_there:
                self._ask()
            self._wait_set.wake()

    def _ask(self) -> None:
        request = self._interface.Request(names=[self._parameter])
        try:
            self._asked = self._client.send_request(msg.serialize(request))
        except UncallableServiceError as error:  # this server has just appeared
            self._answers.append(ParameterAnswer(problem=error.in_one_line()))
            self._wait_set.wake()

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
        with self._lock:
            if self._is_there and not self._is_closed:
                self._ask()

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

    def _take(self) -> None:
        while not self._is_closed:
            for client in self._wait_set.wait():
                if isinstance(client, Client):
                    for number, cdr in self._responses(client):
                        with self._lock:  # the request's number may be unknown earlier
                            if number == self._asked:
                                self._answers.append(self._answer(cdr))
            while self._answers and not self._is_closed:
                self._on_answer(self._answers.popleft())

    def _responses(self, client: Client) -> list[tuple[int, bytes]]:
        try:
            return client.take()
        except WireError:  # the context has been closed in the meantime
            self._is_closed = True
            return []

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


def _type_id(name: str) -> TypeId:
    return TypeId(name, msg.type_hash(name))
