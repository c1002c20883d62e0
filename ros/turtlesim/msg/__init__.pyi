"""Types of turtlesim.msg; generated."""

from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "Color",
    "Pose",
]

class Color(Message):
    r: int
    g: int
    b: int
    def __init__(
        self,
        *,
        r: int = ...,
        g: int = ...,
        b: int = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Pose(Message):
    x: float
    y: float
    theta: float
    linear_velocity: float
    angular_velocity: float
    def __init__(
        self,
        *,
        x: float = ...,
        y: float = ...,
        theta: float = ...,
        linear_velocity: float = ...,
        angular_velocity: float = ...,
        check_fields: bool = ...,
    ) -> None: ...
