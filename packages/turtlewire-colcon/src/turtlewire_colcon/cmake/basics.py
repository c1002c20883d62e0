"""CMake's own commands about values: ``set``, ``list``, ``string``, ``math`` and the like."""

from __future__ import annotations

import ast
import operator
import re
import shlex
from collections.abc import Callable
from typing import TYPE_CHECKING

from turtlewire_colcon.cmake.conditions import CMakeCondition, note_match
from turtlewire_colcon.cmake.syntax import CMakeArgument, CMakeError, parse_keywords

if TYPE_CHECKING:
    from turtlewire_colcon.cmake.interpreter import ExpandedCommand, Handler, Interpreter

__all__ = ["BASICS", "configured"]

_WARNINGS = ("WARNING", "AUTHOR_WARNING", "DEPRECATION", "SEND_ERROR")
#: ``007`` is 7 in CMake, and a mistake in Python.
_LEADING_ZEROS = re.compile(r"\b0+(?=\d)")
_REFERENCE = re.compile(r"@(\w+)@|\$\{(\w+)\}")


def configured(run: Interpreter, text: str, *, at_only: bool = False) -> str:
    """Return a text with its ``@VARIABLES@`` and ``${VARIABLES}`` replaced."""

    def value(match: re.Match[str]) -> str:
        if at_only and match[2]:
            return match[0]
        return run.variables.get(match[1] or match[2], "")

    return _REFERENCE.sub(value, text)


def _set(run: Interpreter, call: ExpandedCommand) -> None:
    if not call.words:
        raise CMakeError(call.place, "set() needs a variable")
    name, *words = call.words
    if name.startswith("ENV{"):
        return
    if "CACHE" in words:
        words = words[: words.index("CACHE")]
        if name in run.variables:
            return
    if words[-1:] == ["PARENT_SCOPE"]:
        run.set_outside(name, ";".join(words[:-1]) if len(words) > 1 else None)
    elif words:
        run.variables[name] = ";".join(words)
    else:
        run.variables.pop(name, None)


def _unset(run: Interpreter, call: ExpandedCommand) -> None:
    if "PARENT_SCOPE" in call.words:
        run.set_outside(call.words[0], None)
    else:
        run.variables.pop(call.words[0] if call.words else "", None)


def _option(run: Interpreter, call: ExpandedCommand) -> None:
    if not call.words:
        raise CMakeError(call.place, "option() needs a variable")
    value = call.words[2] if len(call.words) > 2 else "OFF"
    run.variables.setdefault(call.words[0], value)


def _dependent_option(run: Interpreter, call: ExpandedCommand) -> None:
    """An option that another value replaces unless all conditions hold."""
    name, _, value, depends, forced = call.words
    conditions = [[CMakeArgument(word) for word in each.split()] for each in depends.split(";")]
    if all(CMakeCondition(words, run, call.place).holds() for words in conditions if words):
        run.variables.setdefault(name, value)
    else:
        run.variables[name] = forced


def _message(run: Interpreter, call: ExpandedCommand) -> None:
    mode = call.words[0] if call.words else ""
    text = "".join(call.words[1:])
    if mode == "FATAL_ERROR":
        raise CMakeError(call.place, text)
    if mode in _WARNINGS and not run.testing:
        run.plan.warnings.append(f"{call.place}: {text}")


def _list(run: Interpreter, call: ExpandedCommand) -> None:
    if len(call.words) < 2:
        raise CMakeError(call.place, "list() needs what to do, and a list")
    action, name, *words = call.words
    value = run.variables.get(name, "")
    items = value.split(";") if value else []
    if action in _CHANGES:
        run.variables[name] = ";".join(_CHANGES[action](items, words))
    elif action in _QUESTIONS and words:
        run.variables[words[-1]] = _QUESTIONS[action](items, words[:-1])
    elif action == "FILTER" and len(words) == 3 and words[1] == "REGEX":
        wanted = words[0] == "INCLUDE"
        run.variables[name] = ";".join(
            item for item in items if bool(re.search(words[2], item)) == wanted
        )
    elif action == "TRANSFORM":
        run.variables[_output(words, name)] = ";".join(_transformed(items, words, call))
    else:
        raise CMakeError(call.place, f"list({action}) is not known here")


def _output(words: list[str], name: str) -> str:
    return words[words.index("OUTPUT_VARIABLE") + 1] if "OUTPUT_VARIABLE" in words else name


def _transformed(items: list[str], words: list[str], call: ExpandedCommand) -> list[str]:
    action, *rest = words
    simple: dict[str, Callable[[str], str]] = {
        "TOUPPER": str.upper,
        "TOLOWER": str.lower,
        "STRIP": str.strip,
    }
    if action in simple:
        return [simple[action](item) for item in items]
    if action in ("APPEND", "PREPEND") and rest:
        return [item + rest[0] if action == "APPEND" else rest[0] + item for item in items]
    if action == "REPLACE" and len(rest) >= 2:
        return [re.sub(rest[0], rest[1], item) for item in items]
    raise CMakeError(call.place, f"list(TRANSFORM {action}) is not known here")


_CHANGES: dict[str, Callable[[list[str], list[str]], list[str]]] = {
    "APPEND": lambda items, words: items + words,
    "PREPEND": lambda items, words: words + items,
    "REMOVE_ITEM": lambda items, words: [item for item in items if item not in words],
    "REMOVE_AT": lambda items, words: [
        item
        for number, item in enumerate(items)
        if not {str(number), str(number - len(items))} & {*words}
    ],
    "REMOVE_DUPLICATES": lambda items, _: list(dict.fromkeys(items)),
    "REVERSE": lambda items, _: items[::-1],
    "SORT": lambda items, _: sorted(items),
    "INSERT": lambda items, words: items[: int(words[0])] + words[1:] + items[int(words[0]) :],
}
_QUESTIONS: dict[str, Callable[[list[str], list[str]], str]] = {
    "LENGTH": lambda items, _: str(len(items)),
    "GET": lambda items, words: ";".join(items[int(word)] for word in words),
    "FIND": lambda items, words: str(items.index(words[0]) if words[0] in items else -1),
    "JOIN": lambda items, words: words[0].join(items),
    "SUBLIST": lambda items, words: ";".join(
        items[int(words[0]) :][: int(words[1]) if int(words[1]) >= 0 else None]
    ),
}


def _string(run: Interpreter, call: ExpandedCommand) -> None:
    action, *words = call.words or [""]
    action = f"{action} {words.pop(0)}" if action == "REGEX" and words else action
    if action in ("APPEND", "PREPEND") and words:
        before, text = run.variables.get(words[0], ""), "".join(words[1:])
        run.variables[words[0]] = before + text if action == "APPEND" else text + before
    elif action == "CONFIGURE" and len(words) >= 2:
        run.variables[words[1]] = configured(run, words[0], at_only="@ONLY" in words)
    elif action == "REGEX MATCH" and len(words) >= 3:
        match = re.search(words[0], "".join(words[2:]))
        note_match(run.variables, match)
        run.variables[words[1]] = match[0] if match else ""
    elif action in _STRINGS and len(words) >= _STRINGS[action][0]:
        _, output, function = _STRINGS[action]
        name = words.pop(output)
        run.variables[name] = function(words)
    else:
        raise CMakeError(call.place, f"string({action}) is not known here")


def _all_matches(regex: str, text: str) -> str:
    return ";".join(match[0] for match in re.finditer(regex, text))


def _found(text: str, part: str, *, last: bool) -> str:
    return str(text.rfind(part) if last else text.find(part))


def _substring(text: str, begin: int, length: int) -> str:
    return text[begin:] if length < 0 else text[begin : begin + length]


#: Number of words that each form takes at least, which of them names the variable, what it does.
_STRINGS: dict[str, tuple[int, int, Callable[[list[str]], str]]] = {
    "TOUPPER": (2, 1, lambda words: words[0].upper()),
    "TOLOWER": (2, 1, lambda words: words[0].lower()),
    "STRIP": (2, 1, lambda words: words[0].strip()),
    "LENGTH": (2, 1, lambda words: str(len(words[0].encode()))),
    "CONCAT": (1, 0, "".join),
    "JOIN": (2, 1, lambda words: words[0].join(words[1:])),
    "REPLACE": (4, 2, lambda words: "".join(words[2:]).replace(words[0], words[1])),
    "FIND": (3, 2, lambda words: _found(words[0], words[1], last="REVERSE" in words[2:])),
    "REGEX REPLACE": (4, 2, lambda words: re.sub(words[0], words[1], "".join(words[2:]))),
    "REGEX MATCHALL": (3, 1, lambda words: _all_matches(words[0], "".join(words[1:]))),
    "SUBSTRING": (4, 3, lambda words: _substring(words[0], int(words[1]), int(words[2]))),
    "MAKE_C_IDENTIFIER": (2, 1, lambda words: re.sub(r"\W", "_", words[0])),
}  # fmt: skip


def _separate_arguments(run: Interpreter, call: ExpandedCommand) -> None:
    name, *words = call.words
    text = words[-1] if words else run.variables.get(name, "")
    run.variables[name] = ";".join(shlex.split(text))


def _math(run: Interpreter, call: ExpandedCommand) -> None:
    name, expression = call.words[1:3]
    try:
        tree = ast.parse(_LEADING_ZEROS.sub("", expression.strip()), mode="eval")
        run.variables[name] = str(_calculated(tree.body))
    except (ArithmeticError, SyntaxError, KeyError, ValueError) as error:
        raise CMakeError(call.place, f"cannot calculate {expression!r}: {error}") from None


def _calculated(node: ast.expr) -> int:
    if isinstance(node, ast.Constant) and isinstance(node.value, int):
        return node.value
    if isinstance(node, ast.UnaryOp):
        return _SIGNS[type(node.op)](_calculated(node.operand))
    if isinstance(node, ast.BinOp):
        return _OPERATORS[type(node.op)](_calculated(node.left), _calculated(node.right))
    raise KeyError(type(node).__name__)


def _quotient(dividend: int, divisor: int) -> int:
    """Divide as C does: towards 0."""
    quotient = abs(dividend) // abs(divisor)
    return quotient if (dividend < 0) == (divisor < 0) else -quotient


def _remainder(dividend: int, divisor: int) -> int:
    return dividend - divisor * _quotient(dividend, divisor)


_SIGNS: dict[type[ast.unaryop], Callable[[int], int]] = {
    ast.UAdd: operator.pos,
    ast.USub: operator.neg,
    ast.Invert: operator.invert,
}
_OPERATORS: dict[type[ast.operator], Callable[[int, int], int]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: _quotient,
    ast.Mod: _remainder,
    ast.BitAnd: operator.and_,
    ast.BitOr: operator.or_,
    ast.BitXor: operator.xor,
    ast.LShift: operator.lshift,
    ast.RShift: operator.rshift,
}


def _parse_arguments(run: Interpreter, call: ExpandedCommand) -> None:
    words = call.words
    if words[:1] == ["PARSE_ARGV"]:
        start = int(words[1])
        prefix, *keywords = words[2:]
        given = [
            run.variables[f"ARGV{number}"]
            for number in range(start, int(run.variables.get("ARGC", "0")))
        ]
    else:
        prefix, *keywords = words[:4] or [""]
        given = words[4:]
    options, values, lists = ([word for word in text.split(";") if word] for text in
                              [*keywords, "", "", ""][:3])  # fmt: skip
    parsed = parse_keywords(given, options, values, lists)
    for option in options:
        run.variables[f"{prefix}_{option}"] = "TRUE" if option in parsed.options else "FALSE"
    found = parsed.values | {name: ";".join(items) for name, items in parsed.lists.items()}
    for name in (*values, *lists):
        run.variables.pop(f"{prefix}_{name}", None)
        if name in found:
            run.variables[f"{prefix}_{name}"] = found[name]
    run.variables[f"{prefix}_UNPARSED_ARGUMENTS"] = ";".join(parsed.rest)


def _project(run: Interpreter, call: ExpandedCommand) -> None:
    if not call.words:
        raise CMakeError(call.place, "project() needs a name")
    name = call.words[0]
    version = parse_keywords(call.words, values=("VERSION",)).values.get("VERSION")
    run.plan.name = run.plan.name or name
    run.variables.setdefault("CMAKE_PROJECT_NAME", name)
    run.variables["PROJECT_NAME"] = name
    for prefix in ("PROJECT", name):
        run.variables[f"{prefix}_SOURCE_DIR"] = run.variables["CMAKE_CURRENT_SOURCE_DIR"]
        run.variables[f"{prefix}_BINARY_DIR"] = run.variables["CMAKE_CURRENT_BINARY_DIR"]
        run.variables[f"{prefix}_VERSION"] = version or run.plan.version


BASICS: dict[str, Handler] = {
    "set": _set,
    "unset": _unset,
    "option": _option,
    "cmake_dependent_option": _dependent_option,
    "message": _message,
    "list": _list,
    "string": _string,
    "math": _math,
    "separate_arguments": _separate_arguments,
    "cmake_parse_arguments": _parse_arguments,
    "project": _project,
}
