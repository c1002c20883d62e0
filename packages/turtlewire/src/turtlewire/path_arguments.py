"""Checks paths that callers pass: missing files, and suffixes of other formats."""

from __future__ import annotations

import errno
import os
from collections.abc import Mapping
from typing import Any

from turtlewire.call_errors import near_name


def path_text(path: Any, argument: str = "path", what: str = "path") -> str:
    """Return a path as str.

    Args:
        path: A str, bytes, or an object with ``__fspath__`` such as a ``pathlib.Path``.
        argument: The name of the argument, for the text of the error.
        what: The kind of file at the path, for the text of the error.

    Raises:
        TypeError: The path is something else, such as a number (of an open file).
        ValueError: The path is empty.
    """
    if not isinstance(path, (str, bytes, os.PathLike)):
        advice = ""
        if isinstance(path, (list, tuple, set)):
            advice = "; pass one path at a time"
        elif isinstance(getattr(path, "path", None), str):
            advice = "; pass its attribute `path`"
        elif isinstance(getattr(path, "name", None), str) and hasattr(path, "read"):
            advice = "; pass its attribute `name`"
        raise TypeError(
            f"{argument} must be a str or pathlib.Path, not {type(path).__name__}{advice}"
        )
    text = os.fsdecode(path)
    if not text:
        raise ValueError(f"{argument} is empty; pass the {what}")
    return text


def missing_file(path: str) -> FileNotFoundError:
    """Return the error for the name of a file that does not exist."""
    text = f"No such file or directory{near_path(path)}"
    return FileNotFoundError(errno.ENOENT, text, path)


def near_path(path: str) -> str:
    """Return what to write instead of a path at which nothing is, as the end of an error's text."""
    if path.startswith("~"):
        return "; Python does not expand '~', os.path.expanduser(path) does"
    if "://" in path:
        return "; pass the path of a file on this computer, not a URL"
    folder, name = os.path.split(path.rstrip(os.sep))
    if folder and not os.path.isdir(folder):
        return f"; the folder {folder} does not exist"
    try:
        near = near_name(name, os.listdir(folder or "."))
    except OSError:  # a folder that may not be listed
        return ""
    return f"; did you mean {os.path.join(folder, near)!r}?" if near else ""


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
