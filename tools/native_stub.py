"""Fails when ``_native.pyi`` differs from the compiled module.

Names, kinds, parameters and defaults must be the same, and what is public must have a docstring.
Types are written by hand, because the module's own (``object``, ``list``) are too wide for mypy.
Run by scripts/lint with the Python of .venv; takes the path of a stub.
"""

from __future__ import annotations

import ast
import importlib
import inspect
import re
import sys
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parent))  # also where it is loaded by its path

from distributions import ENGINE

STUB = ENGINE / "src" / "turtlewire" / "_native.pyi"

#: What stands for an attribute or a property, in place of parameters.
ATTRIBUTE = "an attribute"
#: A special method in C, whose parameters have no names.
SLOT = "a slot"


def main(stub: Path) -> int:
    """Compare, and print each difference on a line."""
    try:
        module = importlib.import_module("turtlewire._native")
    except ModuleNotFoundError:
        print("_native.pyi: not compared, for the core is not compiled here")
        return 0
    wanted = declared(ast.parse(stub.read_text(encoding="utf-8")).body)
    found = {name: built(name, value) for name, value in members(module).items()}
    faults = [
        f"{name}: declared {shown(wanted, name)}, built {shown(found, name)}"
        for name in sorted(wanted.keys() | {*filter(is_public, found)})
        if not same(wanted.get(name), found.get(name))
    ]
    faults += [
        f"{name}: has no docstring"
        for name, value in members(module).items()
        if is_public(name) and not documentation(value)
    ]
    for fault in faults:
        print(f"{stub.name}: {fault}")
    return 1 if faults else 0


def is_public(name: str) -> bool:
    """Return True if no part of a dotted name begins with an underscore."""
    return not re.search(r"(^|\.)_", name)


def same(wanted: str | None, found: str | None) -> bool:
    """Return True if the parameters agree; a default of ``...`` agrees with any."""
    if wanted is None or found is None:
        return False
    if found == SLOT:
        return True
    pattern = re.escape(wanted).replace(re.escape("=..."), r"=(\(.*?\)|[^,)]+)")
    return re.fullmatch(pattern, found) is not None


def shown(signatures: dict[str, str], name: str) -> str:
    """Return one side of a difference."""
    return signatures.get(name, "not at all")


# ---------------------------------------------------------------- the stub


def declared(body: list[ast.stmt], prefix: str = "") -> dict[str, str]:
    """Return the parameters of all functions of a stub by dotted name; attributes likewise."""
    found = {}
    for node in body:
        if isinstance(node, ast.ClassDef):
            found[node.name] = "a class"
            found |= declared(node.body, f"{node.name}.")
        elif isinstance(node, ast.FunctionDef):
            is_property = any(ast.unparse(mark) == "property" for mark in node.decorator_list)
            is_method = bool(prefix)
            found[prefix + node.name] = (
                ATTRIBUTE if is_property else parameters(node.args, is_method=is_method)
            )
        elif isinstance(node, ast.AnnAssign):
            found[prefix + ast.unparse(node.target)] = ATTRIBUTE
    return found


def parameters(arguments: ast.arguments, *, is_method: bool) -> str:
    """Names and defaults, without ``self``."""
    for group in (arguments.posonlyargs, arguments.args, arguments.kwonlyargs):
        for argument in group:
            argument.annotation = None
    if is_method:
        (arguments.posonlyargs or arguments.args).pop(0)
    return f"({ast.unparse(arguments)})"


# ---------------------------------------------------------------- the module


def members(module: Any) -> dict[str, Any]:
    """Classes, functions and members of classes by dotted name."""
    found = {name: value for name, value in vars(module).items() if not name.startswith("__")}
    for name, value in list(found.items()):
        if isinstance(value, type):
            found |= {f"{name}.{member}": inner for member, inner in vars(value).items()}
    return {name: value for name, value in found.items() if is_described(value)}


def is_described(value: Any) -> bool:
    """Return True if a member is a class, a function, an attribute of instances or a constant."""
    if callable(value) or inspect.isdatadescriptor(value):
        return True
    return isinstance(value, classmethod | int)


def built(name: str, value: Any) -> str:
    """Return the parameters of a member of the module, as :func:`declared` writes them."""
    if isinstance(value, type):
        return "a class"
    if isinstance(value, int) or inspect.isdatadescriptor(value):
        return ATTRIBUTE
    if type(value) is type(object.__eq__):
        return SLOT
    if isinstance(value, classmethod):
        value = value.__func__
    overloads = getattr(value, "__nb_signature__", None)
    text = with_defaults(*overloads[0]) if overloads else f"def f{signature(name, value)}: ..."
    node = ast.parse(text).body[0]
    assert isinstance(node, ast.FunctionDef)
    return parameters(node.args, is_method="." in name)


def with_defaults(text: str, _: str | None, defaults: tuple[Any, ...] | None) -> str:
    """Return a function as nanobind describes it, its numbered defaults put in."""
    plain = re.sub(r"\[dtype=[^\]]*\]", "", text)  # no expression
    return re.sub(r"\\(\d+)", lambda place: repr((defaults or ())[int(place[1])]), plain) + ": ..."


def signature(name: str, value: Any) -> str:
    """Return a function's signature as Python knows it."""
    try:
        if name.endswith(".__new__"):
            owner = getattr(
                importlib.import_module("turtlewire._native"), name.split(".", maxsplit=1)[0]
            )
            return f"(cls, {str(inspect.signature(owner))[1:]}"
        plain = inspect.signature(value)
    except (TypeError, ValueError):
        return "(self)"
    bare = [each.replace(annotation=inspect.Parameter.empty) for each in plain.parameters.values()]
    return str(plain.replace(parameters=bare, return_annotation=inspect.Signature.empty))


def documentation(value: Any) -> str | None:
    """Return the docstring of a member."""
    inner = value.fget if isinstance(value, property) else value
    overloads = getattr(inner, "__nb_signature__", None)
    text: str | None = overloads[0][1] if overloads else inspect.getdoc(inner)
    return text


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]) if len(sys.argv) > 1 else STUB))
