"""Errors of calls with wrong arguments: in Python's words, with the names that exist.

The compiled core calls `call_error` when it reads arguments; `explain_calls` does the same for
classes in Python, so that both cores raise the same texts. `hint_at` adds advice to the
AttributeErrors of names that people know from other libraries.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Collection, Mapping, Sequence
from types import FunctionType
from typing import Any, NoReturn, TypeVar, cast

#: Such a number cannot be seconds, from 1970 until far in the future.
_SURELY_NANOSECONDS = 10**12

_Class = TypeVar("_Class", bound=type)
_Function = TypeVar("_Function", bound="Callable[..., Any]")


def near_name(name: str, known: Collection[str]) -> str:
    """Return the known name that is nearest to a wrong one; empty if none is near."""
    import difflib

    near = difflib.get_close_matches(name, known, 1)
    return near[0] if near else ""


def call_error(
    function: str,
    names: Sequence[str],
    required: int,
    positional: int,
    given: int,
    keywords: Collection[str],
) -> TypeError:
    """Return the error of a call whose arguments do not fit.

    Args:
        function: The name of the function.
        names: Its parameters, without ``self``.
        required: How many of the first parameters have no default.
        positional: How many of the first parameters may be given without their names.
        given: How many arguments were given without names.
        keywords: The names that were given.
    """
    free = [name for name in names[given:] if name not in keywords]
    for keyword in keywords:
        if keyword not in names:
            near = near_name(keyword, free)
            advice = f"; did you mean {near!r}?" if near else _takes(names)
            return TypeError(f"{function}() got an unexpected keyword argument {keyword!r}{advice}")
        if keyword in names[:given]:
            return TypeError(f"{function}() got multiple values for argument {keyword!r}")
    if given > positional:
        return TypeError(f"{function}() {_too_many(names, required, positional, given)}")
    missing = [name for name in names[given:required] if name not in keywords]
    plural = "s" if len(missing) > 1 else ""
    return TypeError(
        f"{function}() missing {len(missing)} required positional argument{plural}: "
        f"{_listed(missing)}{_takes(names) if len(missing) < len(names) else ''}"
    )


def frame_error(argument: str, value: object) -> TypeError:
    """Return the error for a value that cannot be the name of a frame."""
    advice = ""
    if isinstance(value, bytes):
        advice = "; write name.decode()"
    elif hasattr(value, "__array__") or isinstance(value, (list, tuple)):
        advice = "; the names of frames come before the other arguments"
    elif value is None and argument.startswith(("target", "source")):
        advice = "; Buffer.frames() lists the names"
    return TypeError(f"{argument} must be str, not {type(value).__name__}{advice}")


def _too_many(names: Sequence[str], required: int, positional: int, given: int) -> str:
    most = "at most " if required < positional else ""
    count = f"{most}{positional}" if positional else "no"
    text = f"takes {count} positional argument{'' if positional == 1 else 's'}"
    if positional:
        text += f" ({', '.join(names[:positional])})"
    text += f" but {given} {'was' if given == 1 else 'were'} given"
    by_name = names[positional:]
    return f"{text}; pass {', '.join(by_name)} by keyword" if by_name else text


def _takes(names: Sequence[str]) -> str:
    return f"; it takes {', '.join(names)}" if names else "; it takes no arguments"


def _listed(names: Sequence[str]) -> str:
    """Return names as Python lists them: 'a', 'b', and 'c'."""
    shown = [repr(name) for name in names]
    if len(shown) < 3:
        return " and ".join(shown)
    return f"{', '.join(shown[:-1])}, and {shown[-1]}"


def explain_calls(cls: _Class) -> _Class:
    """Decorate a class: calls of its public methods that do not fit raise `call_error`.

    Class methods and the constructor are included.
    """
    for name, member in list(vars(cls).items()):
        if isinstance(member, FunctionType) and (name == "__init__" or not name.startswith("_")):
            shown = cls.__name__ if name == "__init__" else name
            setattr(cls, name, _explained(member, shown, first=1))
        elif isinstance(member, classmethod):
            setattr(cls, name, classmethod(_explained(member.__func__, name, first=1)))
    return cls


def explain_call(function: _Function) -> _Function:
    """Decorate a function: calls that do not fit raise `call_error`."""
    return cast("_Function", _explained(function, function.__name__))


def _explained(method: Callable[..., Any], name: str, first: int = 0) -> Callable[..., Any]:
    """Return a function or method that explains calls; ``first`` is 1 for ``self``."""

    @functools.wraps(method)
    def call(*arguments: Any, **keywords: Any) -> Any:
        try:
            return method(*arguments, **keywords)
        except TypeError as error:
            trace = error.__traceback__
            if trace is None or trace.tb_next is not None:  # raised by the method itself
                raise
        import inspect  # a program without mistakes starts faster without it

        parameters = list(inspect.signature(method).parameters.values())[first:]
        names = [each.name for each in parameters]
        by_name = sum(each.kind is each.KEYWORD_ONLY for each in parameters)
        required = sum(each.default is each.empty for each in parameters)
        given = len(arguments) - first
        raise call_error(name, names, required, len(names) - by_name, given, keywords)

    return call


def ros_time_error(what: str, value: object) -> TypeError:
    """Return the error, in ROS 2's words, for a value that is neither a time nor a duration.

    Args:
        what: ``time`` or ``duration``.
        value: What the caller passed.
    """
    error = TypeError(f"{what} must have sec and nanosec, or nanoseconds.")
    hint = f"It is of type {type(value).__name__}{_ros_time_for(what, value)}."
    if hasattr(error, "add_note"):  # Python 3.10 has no notes
        error.add_note(hint)
    return error


def _ros_time_for(what: str, value: object) -> str:
    """Return what to write instead, as the end of a sentence."""
    number = ""
    if isinstance(value, int) and abs(value) >= _SURELY_NANOSECONDS:
        number = f"(nanoseconds={value})"
    elif isinstance(value, (int, float)):
        number = f"(seconds={float(value)!r})"
    if what == "duration":
        return f": write rclpy.duration.Duration{number or '(seconds=…)'}"
    if hasattr(value, "header"):
        return ": pass its header.stamp"
    if hasattr(value, "stamp"):
        return ": pass its stamp"
    latest = ": write rclpy.time.Time() for the latest transform"
    return f"{latest}, or rclpy.time.Time{number}" if number and value else latest


class _Absent:
    """An attribute that does not exist: getting it raises an AttributeError with advice."""

    def __init__(self, name: str, instead: str) -> None:
        self._name = name
        self._instead = instead

    def __get__(self, instance: object, owner: type) -> NoReturn:
        name = repr(owner.__name__)
        whose = f"type object {name}" if instance is None else f"{name} object"
        raise AttributeError(f"{whose} has no attribute {self._name!r}; use {self._instead}")

    def __repr__(self) -> str:
        return f"<no attribute; use {self._instead}>"


def hint_at(advice: Mapping[str, str]) -> Callable[[_Class], _Class]:
    """Return a class decorator that adds advice to the AttributeErrors of some names.

    ``__getattr__`` would do the same, but it slows all method calls of a compiled class.

    Args:
        advice: What to use instead of an attribute that does not exist. A key is a name, or
            several names with spaces between them.
    """

    def decorate(cls: _Class) -> _Class:
        for names, instead in advice.items():
            for name in names.split():
                setattr(cls, name, _Absent(name, instead))
        setattr(cls, "__dir__", _existing_names)  # noqa: B010 (mypy refuses the assignment)
        return cls

    return decorate


def _existing_names(instance: object) -> list[str]:
    """Return what ``dir()`` lists, so that shells do not complete names that do not exist."""
    from inspect import getattr_static

    names = object.__dir__(instance)
    return [name for name in names if type(getattr_static(instance, name, None)) is not _Absent]
