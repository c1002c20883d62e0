"""The class of ``ros2 service echo``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2service.verb import VerbExtension

__all__ = ["DEFAULT_TRUNCATE_LENGTH", "EchoVerb"]

DEFAULT_TRUNCATE_LENGTH = 128


class EchoVerb(BuiltinVerb, VerbExtension):
    """Print the requests and responses of a service that has introspection on."""

    _module = "service.echo"
