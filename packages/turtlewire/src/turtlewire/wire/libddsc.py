"""Finds ``libddsc`` of Cyclone DDS, and determines its binary interface.

The ``cyclonedds`` wheel brings one for most platforms. Elsewhere, the library of a ROS 2
installation or of the system also works: Debian, Ubuntu and Raspberry Pi OS have it as
``libddsc0debian``, newer ones (from Debian 13 on) as ``libddsc0t64``. Nothing is loaded here.
"""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Iterator
from importlib.util import find_spec
from typing import NamedTuple


class Abi(NamedTuple):
    """The differences between the supported versions of Cyclone DDS.

    Everything else is the same in all versions: the topic descriptor, the sample info, the
    statuses, built-in topics, opcodes and the functions of serdata.

    Attributes:
        version: The first two numbers of the version.
        tells_type: Whether ``dds_get_entity_sertype`` returns the type of an entity. Without it,
            the type is read from the structure of the topic.
        prunes_peers: Whether ``<Peer>`` has the attribute ``PruneDelay``; without it, peers are
            never given up.
        ignores_types: Whether ``<IgnoreTypeInformation>`` names vendors whose types are not read.
        finds_fast_dds: Whether nodes on Fast DDS are found on the loopback interface. They announce
            the addresses of the other interfaces alone.
    """

    version: str
    tells_type: bool
    prunes_peers: bool
    ignores_types: bool
    finds_fast_dds: bool


ABIS = (
    Abi("11.0", tells_type=True, prunes_peers=True, ignores_types=True, finds_fast_dds=True),
    Abi("0.10", tells_type=False, prunes_peers=False, ignores_types=False, finds_fast_dds=False),
)


class Libddsc(NamedTuple):
    """A ``libddsc``.

    Attributes:
        path: The file.
        version: From its name or the wheel; empty if unknown.
        origin: Who brought it, for people.
    """

    path: str
    version: str
    origin: str

    @property
    def abi(self) -> Abi | None:
        """The binary interface of the library; None for an unsupported version."""
        numbers = ".".join(self.version.split(".")[:2])
        return next((abi for abi in ABIS if abi.version == numbers), None)

    def __str__(self) -> str:
        """Return a phrase for messages."""
        return f"Cyclone DDS {self.version or 'of unknown version'} of {self.origin} ({self.path})"

    @property
    def reason(self) -> str:
        """The reason for choosing this library."""
        return _REASONS[self.origin]


#: In the folder of the ``cyclonedds`` package.
_IN_WHEEL = {"linux": "../cyclonedds.libs", "darwin": ".dylibs", "win32": "../cyclonedds.libs"}
_NAMES = {
    "darwin": r"libddsc.*\.dylib",
    "win32": r"(cyclone)?ddsc.*\.dll",
}
_NAME = r"libddsc(-\w+)?\.so.*"
_VERSION = r"\.(\d+\.\d+\.\d+)(\.dylib)?$"
_HOME, _WHEEL = "CYCLONEDDS_HOME", "the cyclonedds wheel"
_ROS, _OF_SYSTEM = "the ROS 2 installation", "the system"
_REASONS = {
    _HOME: "that variable names it",
    _WHEEL: "it comes with turtlewire",
    _ROS: "there is no cyclonedds wheel, and this ROS 2 is sourced",
    _OF_SYSTEM: "there is no cyclonedds wheel",
}
_FOLDERS = ("lib", "lib64", "bin")
_SYSTEM = ("/usr/local", "/usr", "/opt/homebrew")


class Search(NamedTuple):
    """The result of a search for the library.

    Attributes:
        library: The one to take; None without one.
        refused: Sentences about those that come before it and are not taken.
    """

    library: Libddsc | None
    refused: list[str]


def find_libddsc() -> Search:
    """Search where ``CYCLONEDDS_HOME`` points, in the wheel, the sourced ROS 2 and the system.

    The first library whose version is spoken here is taken.
    """
    refused = []
    home = os.environ.get("CYCLONEDDS_HOME", "").strip()
    if home and next(_below(home, _HOME), None) is None:
        refused.append(f"CYCLONEDDS_HOME is {home}, where there is no libddsc")
    for library in _libraries(home):
        if library.abi is not None:
            return Search(library, refused)
        known = " and ".join(abi.version for abi in ABIS)
        refused.append(f"{library} is not used: only {known} are supported")
    return Search(None, refused)


def _libraries(home: str) -> Iterator[Libddsc]:
    if home:
        yield from _below(home, _HOME)
    yield from _of_wheel()
    for prefix in os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep):
        if prefix:
            yield from _below(prefix, _ROS)
    for prefix in _SYSTEM:
        yield from _below(prefix, _OF_SYSTEM)


def _of_wheel() -> Iterator[Libddsc]:
    spec = find_spec("cyclonedds")  # finds the package without running it, which would take 0.2 s
    if spec is None or spec.origin is None or sys.platform not in _IN_WHEEL:
        return
    package = os.path.dirname(spec.origin)
    folder = os.path.normpath(os.path.join(package, _IN_WHEEL[sys.platform]))
    for library in _inside(folder, _WHEEL):
        yield library if library.version else library._replace(version=_wheel_version(package))


def _wheel_version(package: str) -> str:
    for name in _listed(os.path.dirname(package)):
        told = re.fullmatch(r"cyclonedds-(.*)\.dist-info", name)
        if told:
            return told[1]
    return ""


def _below(prefix: str, origin: str) -> Iterator[Libddsc]:
    for folder in _FOLDERS:
        yield from _inside(os.path.join(prefix, folder), origin)
    multiarch = getattr(sys.implementation, "_multiarch", "")
    if multiarch:
        yield from _inside(os.path.join(prefix, "lib", multiarch), origin)


def _inside(folder: str, origin: str) -> Iterator[Libddsc]:
    """Yield the libraries in a folder, each once, whatever links to it."""
    pattern = re.compile(_NAMES.get(sys.platform, _NAME))
    names = filter(pattern.fullmatch, _listed(folder))
    for path in sorted({os.path.realpath(os.path.join(folder, name)) for name in names}):
        told = re.search(_VERSION, path)
        yield Libddsc(path, told[1] if told else "", origin)


def _listed(folder: str) -> list[str]:
    try:
        return os.listdir(folder)
    except OSError:  # it does not exist, or this user may not read it
        return []
