"""What the modules of interface packages (``geometry_msgs.msg``, ``turtlesim.srv``) consist of.

Classes made at first access.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from turtlewire.msg.classes import get_interface_class

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["lazy_classes"]


def lazy_classes(module_name: str) -> Callable[[str], type]:
    """The ``__getattr__`` of a module of interfaces.

    Args:
        module_name: The module's ``__name__``: ``"geometry_msgs.msg"``. Its ``__all__`` lists the
            interfaces.

    Returns:
        A function that makes a class, and puts it into the module, so that it is called once for
        each.
    """
    module = sys.modules[module_name]

    def find(name: str) -> type:
        if name not in module.__all__:
            raise AttributeError(f"module '{module_name}' has no attribute '{name}'")
        found = get_interface_class(f"{module_name.replace('.', '/')}/{name}")
        setattr(module, name, found)
        return found

    return find
