"""Parameter rules ``[node:]name:=value`` and values in YAML, by the strict typing rules of ROS 2.

No aliases, no mixed sequences, no nulls.

A plain scalar is a bool, else an integer, else a float, else a string; a quoted one is always a
string. In Lyrical, tags such as ``!!float`` choose the type; before, only ``!!str`` did.
"""

from __future__ import annotations

import re
from base64 import b64decode
from collections.abc import Iterator
from contextlib import contextmanager, suppress

import yaml

from turtlewire.distro import LYRICAL, since

from .rcl_lexer import Lexeme, Lexer, RuleError
from .rcl_remap import parse_node_prefix

ParameterValue = (
    bool | int | float | str | list[bytes] | list[bool] | list[int] | list[float] | list[str]
)
_Scalar = bool | int | float | str | list[bytes]

_PARAMETERS_KEY = "ros__parameters"
_TAGS = "tag:yaml.org,2002:"
_BINARY_TAG, _STRING_TAG = f"{_TAGS}binary", f"{_TAGS}str"
_TRUE = frozenset({"Y", "y", "yes", "Yes", "YES", "true", "True", "TRUE", "on", "On", "ON"})
_FALSE = frozenset({"N", "n", "no", "No", "NO", "false", "False", "FALSE", "off", "Off", "OFF"})
# As C's strtol with base 0 reads them: a leading zero means octal.
_INT = re.compile(r"[+-]?(?:0[xX][0-9a-fA-F]+|0[0-7]*|[1-9][0-9]*)")
_FLOAT = re.compile(
    r"[+-]?(?:(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?|inf(?:inity)?|nan)", re.IGNORECASE
)
_HEX_FLOAT = re.compile(
    r"[+-]?0x(?:[0-9a-f]+\.?[0-9a-f]*|\.[0-9a-f]+)(?:p[+-]?[0-9]+)?", re.IGNORECASE
)
_DOTTED = re.compile(r"[+-]?\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN)")
#: More digits than 64 bits have in any base; Python refuses to convert thousands of them.
_LONGEST_INT = 100
#: Names within names; far beyond any real file, and before Python's own limit.
_DEEPEST = 100
_TAGGED = {"bool": bool, "int": int, "float": float}
_TYPE_NAMES = {bool: "bool", int: "integer", float: "double", str: "string"}


def parse_parameter_rule(text: str) -> tuple[str, str, ParameterValue]:
    """Read a rule.

    Returns:
        Pattern of node names (``/**`` when the rule names no node), name and value of the
        parameter.

    Raises:
        RuleError: The rule is malformed.
    """
    lexer = Lexer(text)
    node_name = parse_node_prefix(lexer) or "/**"
    start = lexer.index
    _name_token(lexer)
    while lexer.peek() != Lexeme.SEPARATOR:
        lexer.expect(Lexeme.DOT)
        _name_token(lexer)
    name = lexer.text[start : lexer.index]
    lexer.expect(Lexeme.SEPARATOR)
    return node_name, name, parse_value(lexer.rest)


def _name_token(lexer: Lexer) -> None:
    """Read the name between two dots.

    Slashes are part of it (``qos_overrides./chatter.publisher.depth``).
    """
    found = lexer.peek()
    if found in (Lexeme.WILD_ONE, Lexeme.WILD_MULTI):
        raise RuleError(f"Wildcard '{lexer.accept()}' is not implemented")
    if found not in (Lexeme.TOKEN, Lexeme.FORWARD_SLASH):
        raise RuleError("Expecting token or wildcard")
    while lexer.peek() in (Lexeme.TOKEN, Lexeme.FORWARD_SLASH):
        lexer.accept()


def parse_value(text: str) -> ParameterValue:
    """Return the value that a rule ``name:=text`` gives.

    Raises:
        RuleError: ``text`` is neither a scalar nor a sequence of scalars of one type.
    """
    return _Parser(text, "Error parsing an event").value_document()


def parse_file(path: str) -> dict[str, dict[str, ParameterValue]]:
    """Read a parameter file.

    Returns:
        Node name pattern, as written and joined by slashes, to the parameters, joined by dots.

    Raises:
        RuleError: The file cannot be read, or is not a parameter file.
    """
    try:
        with open(path, encoding="utf-8") as file:
            text = file.read()
    except (OSError, ValueError) as error:
        raise RuleError("Error opening YAML file") from error
    return _Parser(text, "Error parsing a event near line {line}").file_document()


class _Parser:
    """Walks the events of one YAML document.

    Args:
        text: The document.
        fault: The error's text if it is not YAML.
    """

    def __init__(self, text: str, fault: str) -> None:
        self._fault = fault
        self._line = 1
        self._depth = 0
        self._events = self._read(text)
        self._nodes: dict[str, dict[str, ParameterValue]] = {}

    def _read(self, text: str) -> Iterator[yaml.Event]:
        try:
            for event in yaml.parse(text, Loader=yaml.SafeLoader):
                if event.start_mark is not None:
                    self._line = event.start_mark.line + 1
                if isinstance(event, yaml.AliasEvent):
                    raise RuleError(f"Will not support aliasing at line {self._line}\n")
                if not isinstance(event, (yaml.StreamStartEvent, yaml.DocumentStartEvent)):
                    yield event
        except (yaml.YAMLError, ValueError) as error:
            if isinstance(error, RuleError):
                raise
            raise RuleError(self._fault.format(line=self._line)) from error

    def value_document(self) -> ParameterValue:
        event = next(self._events)
        if isinstance(event, yaml.MappingStartEvent):
            raise RuleError("Unknown YAML event")
        if isinstance(event, yaml.StreamEndEvent):
            raise RuleError(f"No value at line {self._line}")
        value = self._value(event)
        for event in self._events:
            if not isinstance(event, (yaml.DocumentEndEvent, yaml.StreamEndEvent)):
                raise RuleError(f"More than one value, the second at line {self._line}")
        return value

    def file_document(self) -> dict[str, dict[str, ParameterValue]]:
        for event in self._events:
            if isinstance(event, yaml.MappingStartEvent):
                self._node_names("")
            elif isinstance(event, yaml.SequenceStartEvent):
                raise RuleError(f"Sequences cannot be key at line {self._line}")
            elif not isinstance(event, (yaml.DocumentEndEvent, yaml.StreamEndEvent)):
                raise RuleError(
                    f"Cannot have a value before {_PARAMETERS_KEY} at line {self._line}"
                )
        return self._nodes

    @contextmanager
    def _one_level_down(self) -> Iterator[None]:
        self._depth += 1
        if self._depth > _DEEPEST:
            raise RuleError(f"More than {_DEEPEST} names within each other at line {self._line}")
        yield
        self._depth -= 1

    def _keys(self) -> Iterator[str]:
        """Yield the keys of the mapping that has begun.

        The caller reads the value after each key.
        """
        for event in self._events:
            if isinstance(event, yaml.MappingEndEvent):
                return
            if isinstance(event, yaml.SequenceStartEvent):
                raise RuleError(f"Sequences cannot be key at line {self._line}")
            if not isinstance(event, yaml.ScalarEvent):
                raise RuleError(f"Mappings cannot be key at line {self._line}")
            yield event.value

    def _node_names(self, prefix: str) -> None:
        for key in self._keys():
            if key == _PARAMETERS_KEY and not prefix:
                raise RuleError(
                    f"There are no node names before {_PARAMETERS_KEY} at line {self._line}"
                )
            event = next(self._events)
            if key == _PARAMETERS_KEY:
                if not isinstance(event, yaml.MappingStartEvent):
                    raise RuleError(
                        f"Cannot have a value before {_PARAMETERS_KEY} at line {self._line}"
                    )
                self._parameters(self._nodes.setdefault(prefix, {}), "")
            elif isinstance(event, yaml.MappingStartEvent):
                with self._one_level_down():
                    self._node_names(f"{prefix.rstrip('/')}/{key.lstrip('/')}" if prefix else key)
            elif isinstance(event, yaml.ScalarEvent):
                raise RuleError(
                    f"Cannot have a value before {_PARAMETERS_KEY} at line {self._line}"
                )
            else:
                raise RuleError(
                    "Sequences can only be values and not keys in params. Error at line "
                    f"{self._line}\n"
                )

    def _check_tag(self, event: yaml.CollectionStartEvent, *known: str) -> None:
        """Reject another tag of a sequence or mapping than those that are known."""
        if since(LYRICAL) and event.tag not in {None, "!", *known}:
            raise RuleError(f'Unsupport tag "{event.tag}" at line {self._line}')

    def _parameters(self, parameters: dict[str, ParameterValue], prefix: str) -> None:
        for key in self._keys():
            name = f"{prefix}.{key}" if prefix else key
            event = next(self._events)
            if isinstance(event, yaml.MappingStartEvent):
                self._check_tag(event, f"{_TAGS}map")
                with self._one_level_down():
                    self._parameters(parameters, name)
            else:
                parameters[name] = self._value(event)

    def _value(self, event: yaml.Event) -> ParameterValue:
        if isinstance(event, yaml.ScalarEvent):
            return self._scalar(event)
        assert isinstance(event, yaml.SequenceStartEvent)
        self._check_tag(event, f"{_TAGS}seq", _BINARY_TAG)
        values: list[_Scalar] = []
        hint = ""
        for item in self._events:
            if isinstance(item, yaml.SequenceEndEvent):
                return values  # type: ignore[return-value]  # the types have been compared
            if not isinstance(item, yaml.ScalarEvent):
                raise RuleError(f"Sequences can only hold plain values. Error at line {self._line}")
            if since(LYRICAL) and _BINARY_TAG in {event.tag, item.tag}:
                raise RuleError(
                    "Byte array must be encoded as a base64 string, not a sequence, cannot parse "
                    f"value {item.value} at line {self._line}"
                )
            value = self._scalar(item)
            if type(value) is bool and item.value.lower() not in {"true", "false"}:
                hint = f"\nYAML reads {item.value} as a bool: for the text, write '{item.value}'"
            if values and type(value) is not type(values[0]):
                text = (
                    f"Value type '{_TYPE_NAMES[type(value)]}' do not belong at line_num "
                    f"{self._line}"
                )
                raise RuleError(f"Sequence should be of same type. {text}{hint}")
            values.append(value)
        raise AssertionError("a sequence ends with its end event")

    def _scalar(self, event: yaml.ScalarEvent) -> _Scalar:
        if event.tag == _STRING_TAG:
            return str(event.value)
        if since(LYRICAL) and event.tag not in {None, "!"}:
            return self._tagged_scalar(event)
        if event.style in {"'", '"'}:
            return str(event.value)
        if not event.value:
            raise RuleError(f"No value at line {self._line}")
        return _plain_scalar(event.value)

    def _tagged_scalar(self, event: yaml.ScalarEvent) -> _Scalar:
        """Return the value of the type that a tag names, however the value is written."""
        kind, text = (event.tag or "").removeprefix(_TAGS), event.value
        if event.tag == _BINARY_TAG:
            with suppress(ValueError):  # binascii's error is one
                return [bytes([byte]) for byte in b64decode("".join(text.split()), validate=True)]
        elif kind in _TAGGED:
            value = _plain_scalar(text)
            if kind == "float" and type(value) is int:
                return float(value)
            if type(value) is _TAGGED[kind]:
                return value
        elif kind not in {"seq", "map"}:
            raise RuleError(f'Unsupport tag "{event.tag}" at line {self._line}')
        raise RuleError(f"Error parsing value {text} at line {self._line}")


def _plain_scalar(text: str) -> bool | int | float | str:
    if text in _TRUE:
        return True
    if text in _FALSE:
        return False
    if len(text) <= _LONGEST_INT and _INT.fullmatch(text):
        value = int(
            text, 0 if "x" in text.lower() else 8 if text.lstrip("+-").startswith("0") else 10
        )
        # Beyond 64 bits it becomes a float, as in ROS 2.
        if -(2**63) <= value < 2**63:
            return value
    if _DOTTED.fullmatch(text):
        # strtod, which ROS 2 uses, and Python write `.inf` and `.nan` without the point.
        return float(text.replace(".", ""))
    if _FLOAT.fullmatch(text) or _HEX_FLOAT.fullmatch(text):
        return _float(text)
    return text


def _float(text: str) -> float | str:
    """Return a number, or the text when it is too large for a double, as C's strtod reports."""
    try:
        value = float.fromhex(text) if "x" in text.lower() else float(text)
    except OverflowError:
        return text
    return text if value in (float("inf"), float("-inf")) and "inf" not in text.lower() else value
