"""The environment variables of discovery, read as in ROS 2, and of SROS 2; the end of a process.

A process that must be secure does not start, instead of ignoring the variables of SROS 2:
turtlewire has no DDS Security, and Zenoh's TLS has its own settings.

At the end of a process, Cyclone waits for acknowledgements of its last messages for up to a second,
and for a tenth to three tenths as a rule. A program that has received the answer to its request
need not wait.
"""

from __future__ import annotations

import contextlib
import os
import re
import sys
from collections.abc import Iterator, Mapping
from enum import Enum
from importlib.util import find_spec
from typing import NamedTuple

from turtlewire.errors import WireError
from turtlewire.platforms import in_browser

from .libddsc import find_libddsc
from .report import warn_once

#: What ``RMW_IMPLEMENTATION`` may name: Cyclone DDS (the default), Zenoh, and ``local``, which
#: stays inside the process.
MIDDLEWARES = ("rmw_cyclonedds_cpp", "rmw_zenoh_cpp", "local")
_CYCLONE = "turtlewire.wire.cyclone.library"
_ZENOH_INSTEAD = "Zenoh is used, which reaches robots that run rmw_zenoh_cpp"
#: Why the default is Zenoh on some platforms.
NO_CYCLONE = f"Cyclone DDS is not installed (it has no wheel for every platform): {_ZENOH_INSTEAD}"

#: Above it, the ports of a domain would not fit.
MAX_DOMAIN_ID = 232


class Range(Enum):
    """The range of discovery (``ROS_AUTOMATIC_DISCOVERY_RANGE``)."""

    LOCALHOST = "LOCALHOST"
    SUBNET = "SUBNET"
    OFF = "OFF"
    SYSTEM_DEFAULT = "SYSTEM_DEFAULT"


class Discovery(NamedTuple):
    """Whom to look for.

    Attributes:
        range: How far.
        static_peers: Addresses that are asked in addition (``ROS_STATIC_PEERS``).
    """

    range: Range
    static_peers: tuple[str, ...]

    @property
    def asked_peers(self) -> tuple[str, ...]:
        """The static peers that count: as in ROS 2, none with ``OFF`` and ``SYSTEM_DEFAULT``."""
        return () if self.range in {Range.OFF, Range.SYSTEM_DEFAULT} else self.static_peers


_PEER = r"(?P<host>[A-Za-z0-9._-]+)(:(?P<port>[0-9]{1,5}))?"
_LAST_PORT = 65535


def split_peer(peer: str) -> tuple[str, str]:
    """Split a static peer into its host and its port, which is empty if it has none.

    Raises:
        WireError: ``peer`` does not have the form of an address.
    """
    written = re.fullmatch(_PEER, peer)
    if not written or not 0 < int(written["port"] or 1) <= _LAST_PORT:
        error = WireError(f"ROS_STATIC_PEERS: {peer!r} is not an address")
        raise error.with_hint("Write host names or IPv4 addresses, separated by ';'.")
    return written["host"], written["port"] or ""


def domain_id() -> int:
    """``ROS_DOMAIN_ID``, or 0.

    Raises:
        WireError: The variable is not a number from 0 to 232.
    """
    text = os.environ.get("ROS_DOMAIN_ID", "").strip()
    if not text:
        return 0
    number = re.fullmatch("0*([0-9]{1,3})", text)
    if number is None or int(number[1]) > MAX_DOMAIN_ID:
        error = WireError(
            f"ROS_DOMAIN_ID is not an integral number from 0 to {MAX_DOMAIN_ID}: {text!r}"
        )
        raise error.with_hint(
            "Set it to a number that your robots share, for example: export ROS_DOMAIN_ID=7"
        )
    return int(number[1])


def middleware_name() -> str:
    """``RMW_IMPLEMENTATION``; Cyclone DDS if it is not set or, after a warning, names another one.

    A shell that sourced a real ROS 2 often has a middleware set that only exists there. If Zenoh
    is available but Cyclone DDS is not, Zenoh is used: without a word on a platform for which
    Cyclone has no wheel, where the set-up and ``turtlewire doctor`` say so, and after a warning if
    there is a library that cannot be used. In a browser tab there is only ``local``.
    """
    name = os.environ.get("RMW_IMPLEMENTATION", "").strip()
    if name in MIDDLEWARES and is_installed(name):
        return name
    if in_browser():
        return "local"
    default = next(filter(is_installed, MIDDLEWARES[:2]), MIDDLEWARES[0])
    if name:
        remedy = " (pip install 'turtlewire[zenoh]')" if name == "rmw_zenoh_cpp" else ""
        warn_once(
            "RMW_IMPLEMENTATION",
            f"RMW_IMPLEMENTATION is {name}, which is not available here{remedy}: "
            f"{default} is used (valid: {', '.join(MIDDLEWARES)})",
        )
    elif default != MIDDLEWARES[0] and (refused := find_libddsc().refused):
        warn_once("no Cyclone DDS", f"{'; '.join(refused)}: {_ZENOH_INSTEAD}")
    return default


def compares_qos() -> bool:
    """Return True if endpoints of one topic and type can fail to match because of their QoS.

    They can with DDS; with Zenoh, every publisher reaches every subscription.
    """
    return middleware_name() != "rmw_zenoh_cpp"


def is_installed(middleware: str) -> bool:
    """Return True if the library of a middleware is installed."""
    if middleware == "rmw_cyclonedds_cpp":
        # What is loaded stays: it needs no file, of which a process may have no more left.
        return _CYCLONE in sys.modules or find_libddsc().library is not None
    if middleware != "rmw_zenoh_cpp":
        return True
    spec = find_spec("zenoh")
    # A folder of that name, such as a workspace in the current one, has no origin.
    return spec is not None and spec.origin is not None


def middleware_library(middleware: str) -> str:
    """Describe a middleware's library and why it was chosen."""
    if middleware == "local":
        return "none: it stays inside the process"
    if middleware == "rmw_cyclonedds_cpp":
        library = find_libddsc().library
        return f"{library}: {library.reason}" if library else "no libddsc was found"
    from importlib.metadata import PackageNotFoundError, version

    try:
        return f"eclipse-zenoh {version('eclipse-zenoh')}"
    except PackageNotFoundError:
        return "eclipse-zenoh is not installed"


def discovery() -> Discovery:
    """Read ``ROS_AUTOMATIC_DISCOVERY_RANGE``, ``ROS_LOCALHOST_ONLY``, ``ROS_STATIC_PEERS``.

    ``LOCALHOST`` when they say nothing.
    """
    peers = tuple(
        peer.strip() for peer in os.environ.get("ROS_STATIC_PEERS", "").split(";") if peer.strip()
    )
    localhost_only = os.environ.get("ROS_LOCALHOST_ONLY", "").strip()
    if localhost_only:
        warn_once(
            "ROS_LOCALHOST_ONLY",
            "ROS_LOCALHOST_ONLY is deprecated but still honored if it is enabled. "
            "Use ROS_AUTOMATIC_DISCOVERY_RANGE and ROS_STATIC_PEERS instead.",
        )
        if localhost_only == "1":
            warn_once(
                "ROS_LOCALHOST_ONLY=1",
                "'localhost_only' is enabled, 'automatic_discovery_range' and 'static_peers' "
                "will be ignored.",
            )
            return Discovery(Range.LOCALHOST, ())
    return Discovery(_range(os.environ.get("ROS_AUTOMATIC_DISCOVERY_RANGE", "").strip()), peers)


def _range(text: str) -> Range:
    if not text:
        return Range.LOCALHOST
    try:
        return Range[text]
    except KeyError:
        warn_once(
            "ROS_AUTOMATIC_DISCOVERY_RANGE",
            f"Invalid value '{text}' specified for 'ROS_AUTOMATIC_DISCOVERY_RANGE', assuming "
            "localhost only "
            "(valid: SUBNET, LOCALHOST, OFF, SYSTEM_DEFAULT)",
        )
        return Range.LOCALHOST


_leaving = 0


@contextlib.contextmanager
def leaving_at_once() -> Iterator[None]:
    """Make the process leave domains that it joins within this context without waiting."""
    global _leaving  # noqa: PLW0603  domains belong to the process
    _leaving += 1
    try:
        yield
    finally:
        _leaving -= 1


def lingers() -> bool:
    """Return True if a domain that is joined now is left only after waiting."""
    return not _leaving


_ENABLE, _STRATEGY = "ROS_SECURITY_ENABLE", "ROS_SECURITY_STRATEGY"
IN_THE_CLEAR = (
    f"{_ENABLE} is true, but turtlewire does not support SROS 2: messages are sent unencrypted and "
    "unauthenticated"
)
_REFUSED = (
    f"{_ENABLE} is true and {_STRATEGY} is Enforce, but turtlewire does not support SROS 2, so it "
    "does not start"
)
REMEDY = (
    "For encryption, use Zenoh with TLS (docs/how-to/secure_networks.md). With it, or to run "
    f"without security, unset {_ENABLE}."
)


def asks_for_security(environment: Mapping[str, str]) -> bool:
    """Return whether SROS 2 is switched on, by rcl's rule: the text is exactly ``true``."""
    return environment.get(_ENABLE) == "true"


def enforces_security(environment: Mapping[str, str]) -> bool:
    """Return whether a process must not start without SROS 2; rcl compares with ``Enforce``."""
    return asks_for_security(environment) and environment.get(_STRATEGY) == "Enforce"


def misspelt_enable(environment: Mapping[str, str]) -> str:
    """Return a value of ROS_SECURITY_ENABLE that reads as on but is off; empty if it is not so."""
    value = environment.get(_ENABLE, "")
    return value if value != "true" and value.strip().lower() in {"true", "1", "on", "yes"} else ""


def check_security() -> None:
    """Warn once if the environment asks for SROS 2.

    Raises:
        WireError: The environment demands it.
    """
    if enforces_security(os.environ):
        raise WireError(_REFUSED).with_hint(REMEDY)
    if asks_for_security(os.environ):
        warn_once(_ENABLE, f"{IN_THE_CLEAR}. {REMEDY}")
