"""Calls a service whenever one of its servers appears, and on demand; reads parameters so."""

from __future__ import annotations

import logging
import threading
from collections import deque
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from turtlewire import msg
from turtlewire.errors import CdrError, UncallableServiceError, WireError
from turtlewire.wire.base import Client, ServiceTypes, TypeId
from turtlewire.wire.names import request_topic
from turtlewire.wire.qos import QoS
from turtlewire.wire.services import require_callable
from turtlewire_view.source import ParameterAnswer, ServiceAnswer

if TYPE_CHECKING:
    from turtlewire.wire.base import Context, Node

__all__ = [
    "ParameterWatch",
    "ServiceWatch",
]


class ServiceWatch:
    """Calls a service when a server appears, and again when another one does.

    A separate thread waits for the responses and reports them, without holding a lock.

    Args:
        context: The participant.
        node: The node that the client belongs to.
        name: Fully qualified, valid name of the service.
        type_name: Its type.
        request: The request as CDR bytes.
        on_answer: Called with each answer, in order, on the watch's thread.
        absent: Returns the problem to report while no server exists.
        waiting: The problem to report until the response to a new server's request arrives; empty
            for none.
    """

    def __init__(
        self,
        context: Context,
        node: Node,
        name: str,
        type_name: str,
        request: bytes,
        on_answer: Callable[[ServiceAnswer], None],
        *,
        absent: Callable[[], str],
        waiting: str = "",
    ) -> None:
        self._name, self._request = name, request
        self._absent, self._waiting = absent, waiting
        self._graph = context.graph
        self._on_answer = on_answer
        self._lock = threading.Lock()
        self._servers: frozenset[bytes] | None = None
        self._asked = 0
        self._answers: deque[ServiceAnswer] = deque()
        self._is_closed = False
        names = (f"{type_name}_Request", f"{type_name}_Response")
        request_id, response_id = (TypeId(each, msg.type_hash(each)) for each in names)
        types = ServiceTypes(type_name, request_id, response_id, msg.type_hash)
        self._client = node.create_client(name, types, QoS(depth=10))
        self._wait_set = context.create_wait_set()
        self._wait_set.attach(self._client)
        self._thread = threading.Thread(target=self._take, name="view-service", daemon=True)
        self._thread.start()
        self._end = context.graph.add_listener(self._look)
        self._look()

    def again(self) -> None:
        """Call the service again if it has a server."""
        with self._lock:
            if self._servers and not self._is_closed:
                self._ask()
                self._wait_set.wake()

    def close(self) -> None:
        """Call no more."""
        self._end()
        with self._lock:
            self._is_closed = True
        self._wait_set.wake()
        self._thread.join()
        self._client.close()
        self._wait_set.close()

    def _look(self) -> None:
        """Call the service if its servers have changed; report that it has none."""
        with self._lock:
            servers = self._find_servers()
            if servers == self._servers or self._is_closed:
                return
            self._servers = servers
            problem = self._waiting if servers else self._absent()
            if problem:
                self._answers.append(ServiceAnswer(problem=problem))
            if servers:
                self._ask()
            self._wait_set.wake()

    def _find_servers(self) -> frozenset[bytes]:
        """Return the servers, which differ when one starts just as another ends."""
        if not self._client.is_ready():
            return frozenset()
        requests = self._graph.endpoints_of(request_topic(self._name), "subscription")
        return frozenset(endpoint.gid for endpoint in requests)

    def _ask(self) -> None:
        try:
            self._asked = self._client.send_request(self._request)
        except WireError as error:  # a server that would misread it has just appeared, for example
            self._answers.append(ServiceAnswer(problem=error.in_one_line()))

    def _take(self) -> None:
        while not self._is_closed:
            for client in self._wait_set.wait():
                if isinstance(client, Client):
                    for number, cdr in self._responses(client):
                        with self._lock:  # the request's number may be unknown earlier
                            if number == self._asked:
                                self._answers.append(ServiceAnswer(cdr))
            while self._answers and not self._is_closed:
                self._on_answer(self._answers.popleft())

    def _responses(self, client: Client) -> list[tuple[int, bytes]]:
        try:
            return client.take()
        except WireError:  # the context has been closed in the meantime
            self._is_closed = True
            return []


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
