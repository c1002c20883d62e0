"""The buffer in plain Python, for machines without a compiler, and for reading.

It gives the same answers as the compiled core, whose files have the same names: ``pose`` is the
arithmetic, ``link`` one link's history, ``tree`` the search between two frames, ``failure`` and
``report`` tf2's words, ``refusals`` what was not taken, ``tf_message`` the bytes of a TFMessage,
``buffer`` the public class with its lock and its waiting, ``record_walk`` a bag's chunks.
"""

from __future__ import annotations

from turtlewire.tf.plain.buffer import Buffer
from turtlewire.tf.plain.record_walk import RecordWalk
from turtlewire.tf.plain.transform import Transform

__all__ = ["Buffer", "RecordWalk", "Transform"]
