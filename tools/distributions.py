"""Names the distributions of this checkout, and the folders that their packages lie in."""

from __future__ import annotations

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


if __name__ == "__main__":
    print(*import_path(), sep=":")
