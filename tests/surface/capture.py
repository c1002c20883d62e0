"""The public surface of installed packages as plain data, as `tests/golden/surface.json` holds it.

A package is a mapping of its modules to what they hold: names, parameters, bases and members.
"""

import contextlib
import enum
import importlib
import inspect
import io
import pkgutil
import re

ADDRESS = re.compile(r" at 0x[0-9a-f]+")
PLAIN = (int, float, str, bool, type(None))
OPERATORS = {"enter", "exit", "call", "iter", "len", "eq", "hash", "getitem", "add", "or"}
#: Classes from here give members to every class, which says nothing about it.
NOBODY = ("builtins", "abc", "typing", "collections.abc")


def surface(package):
    """All public modules of a package with what they hold; modules that fail are absent."""
    found = {}
    for name in modules(package):
        # A module may be a program that runs when it is imported.
        with contextlib.suppress(Exception, SystemExit), contextlib.redirect_stdout(io.StringIO()):
            found[name] = contents(importlib.import_module(name))
    return found


def modules(package):
    """The package and its modules, but private ones and tests."""
    yield package
    try:
        path = getattr(importlib.import_module(package), "__path__", ())
    except ImportError:
        return
    for module in pkgutil.walk_packages(path, f"{package}.", onerror=lambda _: None):
        if ".test" not in module.name and not module.name.rpartition(".")[2].startswith("_"):
            yield module.name


def contents(module):
    """Return a module's own members, and names that a package re-exports."""
    package = module.__name__.partition(".")[0]
    listed = getattr(module, "__all__", None) or ()
    exports = hasattr(module, "__path__")
    found = {}
    for name in sorted(set(listed or [each for each in vars(module) if each[0] != "_"])):
        value = getattr(module, name, None)
        home = getattr(value, "__module__", None) or module.__name__
        if inspect.ismodule(value) or is_annotation(name, value):
            continue
        if home == module.__name__:
            found[name] = describe(value)
        elif home.partition(".")[0] != package:
            if name in listed:
                found[name] = describe(value)
        elif exports or name in listed:
            found[name] = {"same as": f"{home}.{getattr(value, '__name__', name)}"}
    return found


def is_annotation(name, value):
    kind = type(value)
    return (
        kind.__module__ == "typing"
        or name == "TYPE_CHECKING"
        or kind.__name__ in ("GenericAlias", "UnionType")
    )


def describe(value):
    if inspect.isclass(value):
        return describe_class(value)
    if inspect.isfunction(value) or inspect.isbuiltin(value):
        return {"kind": "function", "signature": describe_function(value)}
    if isinstance(value, PLAIN):
        path = isinstance(value, str) and value.startswith("/") and "." in value
        return {"kind": "value", "value": "a path" if path else repr(value)[:120]}
    return {"kind": type(value).__name__}


def describe_class(cls):
    bases = [
        f"{base.__module__.partition('.')[0]}:{base.__name__}"
        for base in cls.__bases__
        if base is not object
    ]
    if issubclass(cls, enum.Enum):
        values = {member.name: repr(member.value) for member in cls}
        return {"kind": "class", "bases": bases, "members": values}
    attributes = {
        name: value
        for base in reversed(cls.__mro__)
        if base.__module__ not in NOBODY
        for name, value in vars(base).items()
        if not name.startswith("_") or name.strip("_") in OPERATORS
    }
    members = {name: describe_member(attributes[name]) for name in sorted(attributes)}
    return {"kind": "class", "bases": bases, "members": members, "signature": signature(cls)}


def describe_member(value):
    if isinstance(value, property):
        return "property set" if value.fset else "property"
    if isinstance(value, (staticmethod, classmethod)):
        return f"{type(value).__name__} {signature(value.__func__)}"
    if inspect.isfunction(value):
        return describe_function(value)
    if inspect.isclass(value):
        return "class"
    return f"value {value!r}"[:86] if isinstance(value, PLAIN) else "other"


def describe_function(function):
    return f"{'async ' * inspect.iscoroutinefunction(function)}{signature(function)}"


def signature(function):
    """Parameters with their defaults and without annotations; None where Python cannot know."""
    try:
        found = inspect.signature(function)
    except (ValueError, TypeError):
        return None
    plain = [each.replace(annotation=each.empty) for each in found.parameters.values()]
    text = str(found.replace(parameters=plain, return_annotation=found.empty))
    return ADDRESS.sub("", text).replace("typing.", "")
