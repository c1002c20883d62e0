"""Rejects file names with the suffix of another format than the one that is written."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["BAGS", "PICTURES", "TRAJECTORIES", "refuse_other_formats"]

PICTURES = (".svg", ".pdf", ".png", ".jpg", ".jpeg")
BAGS = (".mcap", ".db3", ".bag")
TRAJECTORIES = (".tum", ".kitti", ".euroc", ".csv")
_OTHERS = (".json", ".yaml", ".yml", ".xml", ".urdf", ".npy", ".npz", ".pkl", ".pickle", ".h5")


def refuse_other_formats(
    path: str | os.PathLike[str],
    own: tuple[str, ...],
    written: str,
    instead: Mapping[tuple[str, ...], str],
) -> None:
    """Raise ValueError for the suffix of a well-known format that is not written.

    Names without a suffix, or with one that is not well known, are the user's choice.

    Args:
        path: The name of the file.
        own: The suffixes of the formats that are written.
        written: The start of the text: what is written, and how.
        instead: By suffixes, what writes these.
    """
    suffix = os.path.splitext(os.fspath(path))[1].lower()
    others = {*PICTURES, *BAGS, *TRAJECTORIES, *_OTHERS, *(s for key in instead for s in key)}
    if suffix in own or suffix not in others:
        return
    advice = next((text for key, text in instead.items() if suffix in key), "")
    raise ValueError(f"{os.fspath(path)}: {written}, not {suffix}{advice and f'; {advice}'}")
