"""The class of ``ros2 doctor hello``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2cli.values import positive_float, positive_int
from ros2doctor.verb import VerbExtension
from ros2multicast.api import DEFAULT_GROUP, DEFAULT_PORT

__all__ = ["DEFAULT_GROUP", "DEFAULT_PORT", "HelloVerb", "positive_float", "positive_int"]


class HelloVerb(BuiltinVerb, VerbExtension):
    """Find out which hosts can hear each other."""

    _module = "doctor.hello"
