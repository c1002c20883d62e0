"""The class of ``ros2 bag reindex``."""

from __future__ import annotations

from ros2bag.verb import VerbExtension
from ros2cli.builtin import BuiltinVerb

__all__ = ["ReindexVerb"]


class ReindexVerb(BuiltinVerb, VerbExtension):
    """Write the metadata of a bag anew, for example of a recording that was killed."""

    _module = "bag.reindex"
