"""The buffer in plain Python: the same answers as the compiled core, for machines without a compiler, and for reading.

``poses`` is the arithmetic, ``links`` one link's history, ``tree`` the search between two frames,
``texts`` tf2's words, ``cdr`` the bytes of a TFMessage, ``buffer`` the public class with its lock
and its waiting.
"""

from __future__ import annotations

from turtlewire.tf.plain.buffer import Buffer
from turtlewire.tf.plain.transform import Transform

__all__ = ["Buffer", "Transform"]
