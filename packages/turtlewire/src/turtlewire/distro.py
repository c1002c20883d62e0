"""The distribution of ROS 2 that a process follows.

``ROS_DISTRO`` chooses it, as the set-up script of a real installation does. Additions of later
distributions exist under every name, so that programs written for them run. Changes and removals
follow the name; code calls `since` there.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from enum import IntEnum


class Distro(IntEnum):
    """The distributions whose names, texts and behaviour turtlewire has, in order of release."""

    JAZZY = 2024
    KILTED = 2025
    LYRICAL = 2026

    def __str__(self) -> str:
        return self.name.lower()


JAZZY, KILTED, LYRICAL = Distro

#: The distribution of most robots and tutorials that students meet; see docs/compatibility.md.
DEFAULT_DISTRO = JAZZY

_BY_NAME = {str(distro): distro for distro in Distro}


def current_distro(environment: Mapping[str, str] = os.environ) -> Distro:
    """Return the distribution that ``ROS_DISTRO`` names; the default if it names no other.

    Humble and Iron count as the default, Rolling as the newest.
    """
    name = environment.get("ROS_DISTRO", "")
    return LYRICAL if name == "rolling" else _BY_NAME.get(name, DEFAULT_DISTRO)


def since(distro: Distro) -> bool:
    """Return whether the process follows ``distro`` or a later distribution."""
    return current_distro() >= distro
