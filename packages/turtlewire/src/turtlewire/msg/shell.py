"""Lazy classes: the content of modules such as ``geometry_msgs.msg``."""

from __future__ import annotations

import sys
from collections.abc import Callable
from types import ModuleType

from turtlewire.errors import InterfaceError
from turtlewire.msg.classes import get_interface_class, module_name
from turtlewire.package_sources import explain_missing_modules


def lazy_classes(home: str) -> Callable[[str], type]:
    """Return the ``__getattr__`` of a module of interfaces.

    ROS 2's generator has a private module for each interface, ``geometry_msgs.msg._twist``, and
    some programs import from there; they are put into ``sys.modules`` and the module.

    Args:
        home: The module's ``__name__``: ``"geometry_msgs.msg"``. Its ``__all__`` lists the
            interfaces; their parts (``Spawn_Request``) are also found.

    Returns:
        A function that makes a class and puts it into the module, so that it is called once for
        each.
    """
    explain_missing_modules()  # the next import may be of a package that is not installed
    module = sys.modules[home]
    folder = home.replace(".", "/")

    def find(name: str) -> type:
        if name.partition("_")[0] in module.__all__:
            try:
                found = get_interface_class(f"{folder}/{name}")
            except InterfaceError:
                if name in module.__all__:
                    raise
            else:
                setattr(module, name, found)
                return found
        raise AttributeError(f"module '{home}' has no attribute '{name}'")

    for interface in module.__all__:
        private = _PrivateModule(module_name(f"{folder}/{interface}"), interface, find)
        sys.modules[private.__name__] = private
        setattr(module, private.__name__.rpartition(".")[2], private)
    return find


class _PrivateModule(ModuleType):
    """Holds one interface and its parts."""

    def __init__(self, name: str, interface: str, find: Callable[[str], type]) -> None:
        super().__init__(name)
        self._interface = interface
        self._find = find

    def __getattr__(self, name: str) -> type:
        if name.partition("_")[0] == self._interface:
            return self._find(name)
        raise AttributeError(f"module '{self.__name__}' has no attribute '{name}'")
