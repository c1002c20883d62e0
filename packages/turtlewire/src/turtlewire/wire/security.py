"""The variables of SROS 2: a process that must be secure does not start, instead of ignoring them.

turtlewire has no DDS Security, and Zenoh's TLS has its own settings.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from turtlewire.errors import WireError

from .report import warn_once

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = [
    "IN_THE_CLEAR",
    "REMEDY",
    "asks_for_security",
    "check_security",
    "enforces_security",
    "misspelt_enable",
]

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
