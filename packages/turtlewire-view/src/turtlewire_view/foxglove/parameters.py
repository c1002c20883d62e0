"""The parameters of all nodes, as ``/node.name``."""

from __future__ import annotations

import asyncio
import base64
import binascii
import math
from collections.abc import Awaitable, Callable, Iterable
from typing import TYPE_CHECKING, Any

from turtlewire.errors import CdrError, WireError
from turtlewire.msg import deserialize, get_message, get_service, serialize, type_hash
from turtlewire.msg.json_messages import json_value
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS
from turtlewire.wire.report import warn_once
from turtlewire_view.foxglove.caller import ServiceCallError

if TYPE_CHECKING:
    from turtlewire.web.loop_calls import LoopCalls
    from turtlewire.wire.base import MessageInfo, Node, Subscription
    from turtlewire_view.foxglove.caller import Caller
    from turtlewire_view.foxglove.options import Patterns

__all__ = [
    "DOUBLE_TYPES",
    "ParameterEvents",
    "Parameters",
    "from_json",
    "to_json",
]

#: Numbers of ``rcl_interfaces/msg/ParameterType``, with the fields of ``ParameterValue``.
_FIELDS = {
    1: "bool_value",
    2: "integer_value",
    3: "double_value",
    4: "string_value",
    5: "byte_array_value",
    6: "bool_array_value",
    7: "integer_array_value",
    8: "double_array_value",
    9: "string_array_value",
}
_BOOL, _INTEGER, _DOUBLE, _STRING, _BYTES = 1, 2, 3, 4, 5
_ARRAY_OF = {_BOOL: 6, _INTEGER: 7, _DOUBLE: 8, _STRING: 9}
#: The types that hold floating-point numbers.
DOUBLE_TYPES = (3, 8)
_SPECIAL = {"NaN": math.nan, "Infinity": math.inf, "-Infinity": -math.inf}
_JSON_TYPES = {_DOUBLE: "float64", 8: "float64_array", _BYTES: "byte_array"}


def to_json(name: str, value: Any) -> dict[str, Any]:
    """Return a parameter as clients read it; one that is not set has no value.

    JSON does not distinguish 2 from 2.0, so floating-point numbers are sent with a type.

    Args:
        name: Its name.
        value: A ``rcl_interfaces/msg/ParameterValue``.
    """
    shown: dict[str, Any] = {"name": name}
    if value.type not in _FIELDS:
        return shown
    plain = getattr(value, _FIELDS[value.type])
    if value.type == _BYTES:
        plain = base64.b64encode(b"".join(plain)).decode()
    shown["value"] = json_value(plain)
    if value.type in _JSON_TYPES:
        shown["type"] = _JSON_TYPES[value.type]
    return shown


def from_json(value: Any, type_name: str | None, present_type: int) -> Any:
    """Return a ``rcl_interfaces/msg/ParameterValue`` of a client's value; None unsets a parameter.

    Args:
        value: The value.
        type_name: What the client says of its type, if it does.
        present_type: The parameter's type now, as ROS 2's number; integers are taken for
            floating-point numbers where it has such.

    Raises:
        ValueError: No parameter can have this value.
    """
    message: Any = get_message("rcl_interfaces/msg/ParameterValue")()
    if value is None:
        return message
    if type_name == "byte_array":
        number, value = _BYTES, _bytes(value)
    else:
        as_double = type_name in {"float64", "float64_array"} or (
            type_name is None and present_type in DOUBLE_TYPES
        )
        number, value = _typed(value, as_double, present_type)
    message.type = number
    try:
        setattr(message, _FIELDS[number], value)
    except (OverflowError, TypeError) as error:
        raise ValueError(str(error)) from error
    return message


def _typed(value: Any, as_double: bool, present_type: int) -> tuple[int, Any]:
    """Return the number of a value's type, and the value as Python has it."""
    if not isinstance(value, list):
        return _scalar(value, as_double)
    items = [_scalar(item, as_double) for item in value]
    kinds = {kind for kind, _ in items}
    if kinds == {_INTEGER, _DOUBLE}:
        return _ARRAY_OF[_DOUBLE], [float(item) for _, item in items]
    if len(kinds) > 1:
        raise ValueError("the items of a list are of different types")
    plain = [item for _, item in items]
    if not kinds:  # only the parameter determines the type of an empty list
        empty = present_type if present_type in _ARRAY_OF.values() else _ARRAY_OF[_STRING]
        return (_ARRAY_OF[_DOUBLE] if as_double else empty), plain
    return _ARRAY_OF[kinds.pop()], plain


def _scalar(value: Any, as_double: bool) -> tuple[int, Any]:
    if isinstance(value, bool):
        return _BOOL, value
    if as_double and isinstance(value, str) and value in _SPECIAL:
        return _DOUBLE, _SPECIAL[value]
    if isinstance(value, float) or (as_double and isinstance(value, int)):
        try:
            return _DOUBLE, float(value)
        except OverflowError as error:
            raise ValueError(f"{value} does not fit into 64 bits") from error
    if isinstance(value, int):
        if not -(2**63) <= value < 2**63:
            raise ValueError(f"{value} does not fit into 64 bits")
        return _INTEGER, value
    if isinstance(value, str):
        return _STRING, value
    raise ValueError("a parameter must be a bool, a number, a string or a list of them")


def _bytes(value: Any) -> list[bytes]:
    if not isinstance(value, str):
        raise ValueError("a byte array must be a string in base64")  # noqa: TRY004 - as all others
    try:
        return [bytes((byte,)) for byte in base64.b64decode(value, validate=True)]
    except binascii.Error as error:
        raise ValueError(f"a byte array is not valid base64: {error}") from error


#: How long a node may take to answer [s].
_LIMIT = 5.0
_LIST = "/list_parameters"
_EVENTS, _EVENT_TYPE = "/parameter_events", "rcl_interfaces/msg/ParameterEvent"


class Parameters:
    """Reads and sets parameters by calling the nodes' services.

    Args:
        caller: What calls them.
        allowed: Which parameters clients may see.
        services: Returns the names of all services.
    """

    def __init__(
        self, caller: Caller, allowed: Patterns, services: Callable[[], Iterable[str]]
    ) -> None:
        self._caller = caller
        self._allowed = allowed
        self._services = services

    async def read(self, names: list[str]) -> tuple[list[dict[str, Any]], list[str]]:
        """Return the values of parameters, in JSON, and the reasons why others were not read.

        Those that are not set are left out.

        Args:
            names: Their names, ``/node.name``; none means all parameters of all nodes.
        """
        if names:
            values, problems = await self._values(names)
        else:
            values, problems = await self._all_values()
        shown = [to_json(name, value) for name, value in values.items()]
        return [parameter for parameter in shown if "value" in parameter], problems

    async def write(self, wanted: list[dict[str, Any]]) -> list[str]:
        """Set parameters as JSON has them, or unset those without a value; what was refused."""
        by_name = {each["name"]: each for each in wanted}  # of several values the last one counts
        names_of_node, problems = self._by_node(by_name)
        # Of which types they are now; a node may take parameters that it does not have yet.
        present, _ = await self._values(by_name)
        of_node: dict[str, list[Any]] = {}
        for node, names in names_of_node.items():
            for parameter in names:
                name = f"{node}.{parameter}"
                each, type_now = by_name[name], present[name].type if name in present else 0
                try:
                    value = from_json(each.get("value"), each.get("type"), type_now)
                except ValueError as error:
                    problems.append(f"parameter {name}: {error}")
                    continue
                message = get_message("rcl_interfaces/msg/Parameter")(name=parameter, value=value)
                of_node.setdefault(node, []).append(message)
        for _, found in await _each(self._write_node(*item) for item in of_node.items()):
            problems += found
        return problems

    async def _write_node(self, node: str, parameters: list[Any]) -> tuple[None, list[str]]:
        response = await self._ask(node, "SetParameters", parameters=parameters)
        return None, [
            f"parameter {node}.{parameter.name} was not set: {result.reason or 'refused'}"
            for parameter, result in zip(parameters, response.results, strict=False)
            if not result.successful
        ]

    async def _all_values(self) -> tuple[dict[str, Any], list[str]]:
        nodes = [name.removesuffix(_LIST) for name in self._services() if name.endswith(_LIST)]
        values: dict[str, Any] = {}
        problems: list[str] = []
        for found, faults in await _each(self._node_values(node, None) for node in nodes):
            values.update(found or {})
            problems += faults
        return values, problems

    async def _values(self, names: Iterable[str]) -> tuple[dict[str, Any], list[str]]:
        of_node, problems = self._by_node(names)
        values: dict[str, Any] = {}
        for found, faults in await _each(self._node_values(*item) for item in of_node.items()):
            values.update(found or {})
            problems += faults
        return values, problems

    def _by_node(self, names: Iterable[str]) -> tuple[dict[str, list[str]], list[str]]:
        """Parameters by the nodes that have them."""
        services = set(self._services())
        problems, of_node = [], dict[str, list[str]]()
        for name in names:
            node, dot, parameter = name.partition(".")
            if not dot or not parameter or not self._allowed.match(name):
                problems.append(f"there is no parameter {name} here; names are /node.parameter")
            elif node + _LIST not in services:
                problems.append(f"there is no node {node} with parameters")
            else:
                of_node.setdefault(node, []).append(parameter)
        return of_node, problems

    async def _node_values(
        self, node: str, names: list[str] | None
    ) -> tuple[dict[str, Any], list[str]]:
        if names is None:
            listed = await self._ask(node, "ListParameters")
            names = [name for name in listed.result.names if self._allowed.match(f"{node}.{name}")]
        if not names:
            return {}, []
        response = await self._ask(node, "GetParameters", names=names)
        # A node that forbids undeclared parameters answers nothing if one of them is not declared.
        if len(response.values) != len(names) and len(names) > 1:
            return await self._one_by_one(node, names)
        values = dict(zip((f"{node}.{name}" for name in names), response.values, strict=False))
        missing = [] if response.values else [f"node {node} has no parameter {names[0]}"]
        return values, missing

    async def _one_by_one(self, node: str, names: list[str]) -> tuple[dict[str, Any], list[str]]:
        values, problems = dict[str, Any](), list[str]()
        for name in names:
            found, faults = await self._node_values(node, [name])
            values.update(found)
            problems += faults
        return values, problems

    async def _ask(self, node: str, service: str, **fields: Any) -> Any:
        """Call one of a node's parameter services: ``ListParameters`` is ``list_parameters``."""
        type_name = f"rcl_interfaces/srv/{service}"
        name = "".join(f"_{letter.lower()}" if letter.isupper() else letter for letter in service)
        interface = get_service(type_name)
        cdr = await self._caller.call(
            f"{node}/{name[1:]}", type_name, serialize(interface.Request(**fields)), _LIMIT
        )
        return deserialize(interface.Response, cdr)


async def _each(
    works: Iterable[Awaitable[tuple[Any, list[str]]]],
) -> list[tuple[Any, list[str]]]:
    """The results of several nodes, side by side; a node that does not answer is a problem."""

    async def guarded(work: Awaitable[tuple[Any, list[str]]]) -> tuple[Any, list[str]]:
        try:
            return await work
        except (CdrError, ServiceCallError, WireError) as error:
            return None, [str(error)]

    return list(await asyncio.gather(*map(guarded, works)))


class ParameterEvents:
    """Listens to ``/parameter_events`` while anybody wants to know of changes.

    Args:
        node: Whose subscription it is.
        calls: Of the loop.
        allowed: Which parameters clients may see.
        tell: Called on the loop's thread with parameters that have changed, in JSON; one without a
            value was unset.
    """

    def __init__(
        self,
        node: Node,
        calls: LoopCalls,
        allowed: Patterns,
        tell: Callable[[list[dict[str, Any]]], None],
    ) -> None:
        self._node = node
        self._calls = calls
        self._allowed = allowed
        self._tell = tell
        self._subscription: Subscription | None = None

    def listen(self, wanted: bool) -> None:
        """Begin or end to listen."""
        if wanted and self._subscription is None:
            type_id = TypeId(_EVENT_TYPE, type_hash(_EVENT_TYPE))
            self._subscription = self._node.create_subscription(
                _EVENTS, type_id, QoS(depth=1000), self._receive
            )
        elif not wanted and self._subscription is not None:
            self._subscription.close()
            self._subscription = None

    def _receive(self, cdr: bytes, _info: MessageInfo) -> None:
        """Pass an event to the loop; runs on a thread of the middleware."""
        self._calls.soon(self._read, cdr)

    def _read(self, cdr: bytes) -> None:
        try:
            event: Any = deserialize(get_message(_EVENT_TYPE), cdr)
        except CdrError as error:
            warn_once(f"malformed {_EVENTS}", f"a message on {_EVENTS} was lost: {error}")
            return
        changed = [*event.new_parameters, *event.changed_parameters]
        shown = [to_json(f"{event.node}.{each.name}", each.value) for each in changed]
        shown += [{"name": f"{event.node}.{each.name}"} for each in event.deleted_parameters]
        self._tell([each for each in shown if self._allowed.match(each["name"])])
