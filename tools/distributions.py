"""Names the distributions of this checkout, the folders of their packages, and the user's cache."""

from __future__ import annotations

import os
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PACKAGES = ROOT / "packages"
ENGINE = PACKAGES / "turtlewire"
ROS = PACKAGES / "turtlewire-ros"
COLCON = PACKAGES / "turtlewire-colcon"
CLASS = PACKAGES / "turtlewire-class"
#: The tutorial's package, which colcon builds, too.
LEARNING = ROOT / "examples" / "learning_tf2_py"


def distributions() -> list[Path]:
    """Return the folder of each distribution that is here."""
    return [*sorted(path.parent for path in PACKAGES.glob("*/pyproject.toml")), LEARNING]


def import_path() -> list[Path]:
    """Return the folders from which Python imports the packages: sources, and ROS 2's shelves."""
    shelves = {package.parents[1] for package in PACKAGES.glob("*/*/*/__init__.py")}
    return sorted(shelves)


def packages() -> list[Path]:
    """Return the folder of each Python package."""
    return sorted(
        package.parent for shelf in import_path() for package in shelf.glob("*/__init__.py")
    )


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


if __name__ == "__main__":
    print(*import_path(), sep=":")
