"""The user's cache folder, in which scripts store files for other checkouts."""

from __future__ import annotations

import os
from pathlib import Path


def cache_folder() -> Path:
    """Return ``turtlewire`` below ``$XDG_CACHE_HOME``, which is ``~/.cache`` if it is not set."""
    home = os.environ.get("XDG_CACHE_HOME", "")
    # The specification of XDG: a path that is not absolute is ignored.
    return (Path(home) if os.path.isabs(home) else Path.home() / ".cache") / "turtlewire"


def keep(source: Path, target: Path) -> None:
    """Copy a file into or out of the cache; another process sees all of it or nothing."""
    target.parent.mkdir(parents=True, exist_ok=True)
    fresh = target.with_name(f".{target.name}.{os.getpid()}")
    try:
        fresh.write_bytes(source.read_bytes())
        fresh.replace(target)
    finally:
        fresh.unlink(missing_ok=True)
