"""The platforms for which PyPI has wheels of the middlewares' libraries, as in pyproject.toml.

Advice must not lead to a build from source: building the wheel of Cyclone DDS needs an installed
Cyclone, and building Zenoh's needs Rust.
"""

from __future__ import annotations

import platform
import sys
import sysconfig
from typing import NamedTuple

_BOTH = {("linux", "x86_64"), ("darwin", "arm64"), ("darwin", "x86_64"), ("win32", "AMD64")}
_ZENOH_ONLY = {("linux", machine) for machine in ("aarch64", "armv7l", "i686")}
_TOO_NEW_FOR_CYCLONE = (3, 14)
_PACKAGES = "libddsc0debian, in newer ones libddsc0t64"


class Platform(NamedTuple):
    """The properties of a platform that decide if a wheel exists.

    Attributes:
        system: As ``sys.platform`` has it.
        machine: As ``platform.machine()`` has it.
        version: Of Python, two numbers.
        usual: Whether this is CPython with the GIL, on glibc if on Linux: others have no wheels.
    """

    system: str
    machine: str
    version: tuple[int, int]
    usual: bool

    @property
    def has_cyclone(self) -> bool:
        """True if there is a wheel of ``cyclonedds`` 11.0.1."""
        old_enough = self.version < _TOO_NEW_FOR_CYCLONE
        return self.usual and old_enough and (self.system, self.machine) in _BOTH

    @property
    def has_zenoh(self) -> bool:
        """True if there is a wheel of ``eclipse-zenoh``."""
        return self.usual and (self.system, self.machine) in _BOTH | _ZENOH_ONLY


def this_platform() -> Platform:
    """Return the platform of this process."""
    musl = "musl" in getattr(sys.implementation, "_multiarch", "")
    cpython = sys.implementation.name == "cpython"
    usual = cpython and not musl and not sysconfig.get_config_var("Py_GIL_DISABLED")
    return Platform(sys.platform, platform.machine(), sys.version_info[:2], usual)


def advice(here: Platform) -> str:
    """Return advice on installing a middleware, and what works without one."""
    ways = []
    if here.has_cyclone:
        ways.append("type: pip install cyclonedds==11.0.1")
    elif here.system == "linux":
        ways.append(f"install libddsc 0.10 (Debian, Ubuntu, Raspberry Pi OS: {_PACKAGES})")
    if here.has_zenoh:
        ways.append(
            "use Zenoh: pip install 'turtlewire[zenoh]' and RMW_IMPLEMENTATION=rmw_zenoh_cpp"
        )
    if not ways:
        ways.append("there is no wheel of Cyclone DDS or Zenoh for it")
    ways.append("RMW_IMPLEMENTATION=local works inside one process, and the buffer and bags always")
    text = "; ".join(ways)
    return f"{text[0].upper()}{text[1:]}."
