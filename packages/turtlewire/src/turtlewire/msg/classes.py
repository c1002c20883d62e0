"""Makes the Python classes of messages, services and actions.

A message class has plain slots named as its fields, a keyword constructor and the methods of
`Message`. Only fields whose assignment converts the value are properties over their slot: those
that hold numbers in bulk, and in Lyrical all that hold lists.
"""

from __future__ import annotations

import warnings
from threading import RLock
from typing import TYPE_CHECKING, Any, Generic, cast

from turtlewire.distro import LYRICAL, since
from turtlewire.errors import InterfaceError
from turtlewire.msg.constructor import make_constructor
from turtlewire.msg.definition import split_name
from turtlewire.msg.message import Message
from turtlewire.msg.registry import load_action, load_message, load_service
from turtlewire.msg.types import AbstractNestedType, Array
from turtlewire.msg.values import (
    array_of_bytes,
    converter,
    numpy_name,
    raw_name,
)

if TYPE_CHECKING:
    from turtlewire.msg.definition import MessageDefinition
    from turtlewire.msg.values import Cdr

if TYPE_CHECKING:
    from typing_extensions import TypeVar

    _RequestT = TypeVar("_RequestT", default=Any)
    _ResponseT = TypeVar("_ResponseT", default=Any)
    _GoalT = TypeVar("_GoalT", default=Any)
    _ResultT = TypeVar("_ResultT", default=Any)
    _FeedbackT = TypeVar("_FeedbackT", default=Any)
else:  # the defaults came with Python 3.13
    from typing import TypeVar

    _RequestT, _ResponseT = TypeVar("_RequestT"), TypeVar("_ResponseT")
    _GoalT, _ResultT, _FeedbackT = TypeVar("_GoalT"), TypeVar("_ResultT"), TypeVar("_FeedbackT")

_messages: dict[str, type[Message]] = {}
_services: dict[str, type[Service]] = {}
_actions: dict[str, type[Action]] = {}
_lock = RLock()


class _PartsOnDemand(type):
    """Gives a service or action class its message classes when they are asked for."""

    _PARTS: dict[str, str] = {}  # noqa: RUF012 - classes made for interfaces have their own

    def __getattr__(cls, name: str) -> type:
        full_name = cls._PARTS.get(name)
        if full_name is None:
            raise AttributeError(f"type object '{cls.__name__}' has no attribute '{name}'")
        part = get_interface_class(full_name)
        setattr(cls, name, part)
        return part


class Service(Generic[_RequestT, _ResponseT], metaclass=_PartsOnDemand):
    """Base of all service classes.

    Their ``Request``, ``Response`` and ``Event`` are message classes.
    """

    _TYPE_NAME: str

    def __init__(self) -> None:
        raise NotImplementedError("Service classes can not be instantiated")


class ActionImpl(metaclass=_PartsOnDemand):
    """Base of the ``Impl`` of all action classes: the services and messages that carry an action.

    They are ``SendGoalService``, ``GetResultService``, ``CancelGoalService``, ``FeedbackMessage``
    and ``GoalStatusMessage``.
    """


class Action(Generic[_GoalT, _ResultT, _FeedbackT], metaclass=_PartsOnDemand):
    """Base of all action classes.

    Their ``Goal``, ``Result`` and ``Feedback`` are message classes, ``Impl`` holds the rest.
    """

    _TYPE_NAME: str

    def __init__(self) -> None:
        raise NotImplementedError("Action classes can not be instantiated")


def get_message(name: str) -> type[Any]:
    """Class of a message, a subclass of `Message`; a type checker does not know its fields.

    Args:
        name: ``"geometry_msgs/msg/Twist"`` or ``"geometry_msgs/Twist"``; parts of services and
            actions by their full name.

    Returns:
        The class, the same one at every call.

    Raises:
        InterfaceError: The message does not exist.
        TypeError: ``name`` is not a str.
    """
    full_name = _full_name(name, "msg")
    found = _messages.get(full_name)
    if found is not None:
        return found
    with _lock:
        if full_name not in _messages:
            _messages[full_name] = _make_message(load_message(full_name))
        return _messages[full_name]


_EXAMPLES = {
    "msg": "get_message accepts the name of a message, for example 'geometry_msgs/msg/Twist'",
    "srv": "get_service accepts the name of a service, for example 'turtlesim/srv/Spawn'",
    "action": "get_action accepts the name of an action, for example "
    "'turtlesim/action/RotateAbsolute'",
}


def _full_name(name: str, kind: str) -> str:
    """Return the name with the kind of its interface between package and type."""
    if not isinstance(name, str):
        given = f"the class {name.__name__}" if isinstance(name, type) else type(name).__name__
        raise TypeError(f"{_EXAMPLES[kind]}, not {given}")
    return name if name.count("/") != 1 else name.replace("/", f"/{kind}/")


def get_service(name: str) -> type[Service]:
    """Class of a service, by ``"turtlesim/srv/Spawn"`` or ``"turtlesim/Spawn"``.

    Raises as `get_message` does.
    """
    full_name = _full_name(name, "srv")
    with _lock:
        if full_name not in _services:
            load_service(full_name)
            _services[full_name] = _make_service(full_name)
        return _services[full_name]


def get_action(name: str) -> type[Action]:
    """Class of an action, by ``"turtlesim/action/RotateAbsolute"`` or without the middle.

    Raises as `get_message` does.
    """
    full_name = _full_name(name, "action")
    with _lock:
        if full_name not in _actions:
            load_action(full_name)
            _actions[full_name] = _make_action(full_name)
        return _actions[full_name]


def get_interface_class(full_name: str) -> type:
    """Class of any interface or part of one.

    ``"pkg/msg/X"``, ``"pkg/srv/X_Request"``, ``"pkg/action/X_SendGoal"`` and so on.
    """
    kind, _, name = full_name.partition("/")[2].partition("/")
    if kind == "action" and "_" not in name:
        return get_action(full_name)
    if name.endswith(("_SendGoal", "_GetResult")) or (kind == "srv" and "_" not in name):
        return get_service(full_name)
    return get_message(full_name)


def type_name(cls: type) -> str:
    """Return the full name of an interface class: ``"geometry_msgs/msg/Twist"``.

    Raises:
        InterfaceError: ``cls`` is not an interface class.
    """
    try:
        return cls._TYPE_NAME  # type: ignore[attr-defined, no-any-return]
    except AttributeError:
        raise InterfaceError(f"{cls!r} is not a ROS 2 interface class") from None


def module_name(full_name: str) -> str:
    """Module that ROS 2's generator would put the class in.

    ``"geometry_msgs.msg._pose_stamped"``.
    """
    package, kind, name = split_name(full_name)
    name = name.partition("_")[0]
    snake = ""
    for index, letter in enumerate(name):
        if (
            index
            and letter.isupper()
            and (name[index + 1 : index + 2].islower() or not name[index - 1].isupper())
        ):
            snake += "_"
        snake += letter.lower()
    return f"{package}.{kind}._{snake}"


def _make_message(definition: MessageDefinition) -> type[Message]:
    name = definition.full_name.rpartition("/")[2]
    namespace: dict[str, Any] = {
        "__slots__": tuple(field.name for field in definition.fields),
        "__module__": module_name(definition.full_name),
        "__doc__": f"Message class '{name}'.",
        "SLOT_TYPES": tuple(field.type for field in definition.fields),
        "_TYPE_NAME": definition.full_name,
        "_DEFINITION": definition,
        "__init__": make_constructor(definition, get_message),
        "__reduce__": _reduce,
        "_to_cdr": _first_to_cdr,
        "_from_cdr": classmethod(_first_from_cdr),
        "_from_cdr_big_endian": classmethod(_first_from_cdr_big_endian),
    }
    namespace.update((constant.name, constant.value) for constant in definition.constants)
    namespace.update(
        (f"{field.name.upper()}__DEFAULT", field.default)
        for field in definition.fields
        if field.default is not None
    )
    cls = type(name, (Message,), namespace)
    for field in definition.fields:
        if not isinstance(field.type, AbstractNestedType):
            continue
        slot = getattr(cls, field.name)
        setattr(cls, raw_name(field.name), slot)
        convert = converter(field.type)
        if convert is None:
            if since(LYRICAL):
                setattr(cls, field.name, _list_property(slot))
        elif isinstance(field.type, Array):
            setattr(cls, field.name, _array_property(slot, field.type, convert))
        else:
            setattr(cls, field.name, _converting_property(slot, convert))
    _show_private_slots(cls)
    return cls


def _show_private_slots(cls: type[Message]) -> None:
    """Let the class look as if its fields were properties over private slots, as in ROS 2.

    Programs read ``__slots__`` and remove the underscores, or read the attributes that it names.
    Real properties would make each access slower; these are further names of the same slots.
    """
    names = [field.name for field in cls._DEFINITION.fields]
    for name in names:
        setattr(cls, f"_{name}", getattr(cls, name))
    cls.__slots__ = tuple(f"_{name}" for name in names)


def _converting_property(slot: Any, convert: Any) -> property:
    store = slot.__set__

    def assign(message: Message, value: Any) -> None:
        if isinstance(value, set):
            _warn_of_set()
        try:
            store(message, convert(value))
        except (TypeError, OverflowError) as error:
            place = f"{type(message)._TYPE_NAME}: field '{slot.__name__}'"
            raise type(error)(f"{place} holds a sequence of numbers: {error}") from None

    return property(slot.__get__, assign, slot.__delete__)


def _list_property(slot: Any) -> property:
    """Return a property that makes a list of other iterables, as in Lyrical."""
    store = slot.__set__

    def assign(message: Message, value: Any) -> None:
        if isinstance(value, list):
            store(message, value)
            return
        if isinstance(value, set):
            _warn_of_set()
        try:
            store(message, list(value))
        except TypeError as error:
            place = f"{type(message)._TYPE_NAME}: field '{slot.__name__}'"
            raise TypeError(f"{place} holds a list: {error}") from None

    return property(slot.__get__, assign, slot.__delete__)


def _warn_of_set() -> None:
    """Warn of a set as the value of a field, in Lyrical."""
    if since(LYRICAL):
        warnings.warn(
            "Using set or subclass of set is deprecated, please use a subclass of "
            "collections.abc.Sequence like list",
            DeprecationWarning,
            stacklevel=3,
        )


def _array_property(slot: Any, type_: Array, convert: Any) -> property:
    load, store = slot.__get__, slot.__set__
    dtype = numpy_name(str(type_.value_type))
    size = type_.size if dtype == "uint8" else None  # the size of bytes that need no conversion

    def read(message: Message) -> Any:
        value = load(message)
        if type(value) is bytes:
            value = array_of_bytes(dtype, value)
            store(message, value)
        return value

    def assign(message: Message, value: Any) -> None:
        if isinstance(value, set):
            _warn_of_set()
        store(message, value if type(value) is bytes and len(value) == size else convert(value))

    return property(read, assign, slot.__delete__)


def _make_service(full_name: str) -> type[Service]:
    namespace = {
        "__module__": module_name(full_name),
        "_TYPE_NAME": full_name,
        "_PARTS": {part: f"{full_name}_{part}" for part in ("Request", "Response", "Event")},
    }
    return cast(
        "type[Service]", _PartsOnDemand(full_name.rpartition("/")[2], (Service,), namespace)
    )


def _make_action(full_name: str) -> type[Action]:
    implementation = {
        "SendGoalService": f"{full_name}_SendGoal",
        "GetResultService": f"{full_name}_GetResult",
        "FeedbackMessage": f"{full_name}_FeedbackMessage",
        "CancelGoalService": "action_msgs/srv/CancelGoal",
        "GoalStatusMessage": "action_msgs/msg/GoalStatusArray",
    }
    name = full_name.rpartition("/")[2]
    module = module_name(full_name)
    namespace = {
        "__module__": module,
        "_TYPE_NAME": full_name,
        "_PARTS": {part: f"{full_name}_{part}" for part in ("Goal", "Result", "Feedback")},
        "Impl": _PartsOnDemand(
            "Impl",
            (ActionImpl,),
            {"__module__": module, "__qualname__": f"{name}.Impl", "_PARTS": implementation},
        ),
    }
    return cast("type[Action]", _PartsOnDemand(name, (Action,), namespace))


def _first_to_cdr(message: Message) -> Cdr:
    """Encode. The first call for a class generates the code, which replaces this method."""
    from turtlewire.msg.encoder import make_encoder

    encode = make_encoder(type(message))
    _messages[message._TYPE_NAME]._to_cdr = encode  # type: ignore[method-assign, assignment]
    return encode(message)


def _first_from_cdr(cls: type[Message], data: bytes) -> Message:
    """Decode little endian; generated at the first call, as `_first_to_cdr` does."""
    from turtlewire.msg.decoder import make_decoder

    decode = make_decoder(cls, "<", get_message)
    cls._from_cdr = staticmethod(decode)  # type: ignore[method-assign, assignment]
    return decode(data)


def _first_from_cdr_big_endian(cls: type[Message], data: bytes) -> Message:
    """Decode big endian; generated at the first call, as `_first_to_cdr` does."""
    from turtlewire.msg.decoder import make_decoder

    decode = make_decoder(cls, ">", get_message)
    cls._from_cdr_big_endian = staticmethod(decode)  # type: ignore[method-assign, assignment]
    return decode(data)


def _reduce(message: Message) -> tuple[Any, ...]:
    values = {field.name: getattr(message, field.name) for field in message._DEFINITION.fields}
    return _restore, (message._TYPE_NAME, values)


def _restore(full_name: str, values: dict[str, Any]) -> Any:
    """Unpickle or copy.

    Finds the class by its name, so that no ROS-named package needs to be importable.
    """
    return get_message(full_name)(**values)
