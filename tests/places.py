"""Folders of the checkout that tests read."""

from __future__ import annotations

import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
#: Bytes, texts, traces and bags that were captured from a real ROS 2.
GOLDEN = ROOT / "tests" / "golden"
EXAMPLES = ROOT / "examples"
HOW_TO = ROOT / "docs" / "how-to"
SCRIPTS = ROOT / "scripts"
TOOLS = ROOT / "tools"
#: The engine: it has `native` and `src`.
ENGINE = ROOT / "packages" / "turtlewire"
#: ROS 2's packages.
ROS = ROOT / "packages" / "turtlewire-ros"
#: The product's Python packages, and the folders from which they are imported.
PACKAGES = sorted(init.parent for init in ROOT.glob("packages/*/*/*/__init__.py"))
IMPORT_PATH = sorted({package.parent for package in PACKAGES})
COLCON = ROOT / "packages" / "turtlewire-colcon"
#: The tutorial's package.
LEARNING = ROOT / "examples" / "learning_tf2_py"
LESSON_CODE = ROOT / "packages" / "turtlewire-class" / "src"
LESSONS = LESSON_CODE / "turtle_lesson" / "lessons"
#: Sphinx's settings.
SITE = ROOT / "docs" / "sphinx"
#: The commands of this environment.
BIN = Path(sys.executable).parent
ROS2 = BIN / "ros2"
TURTLEWIRE = BIN / "turtlewire"
#: The variable that has them first.
PATH = f"{BIN}{os.pathsep}{os.environ['PATH']}"


def modules_of_tests() -> list[Path]:
    """Return the test modules of all distributions."""
    beside = ROOT.glob("packages/**/tests/**/test_*.py")
    return sorted([*beside, *(ROOT / "tests").glob("**/test_*.py")])


def module_of_tests(name: str) -> Path:
    """Return the test module with a name such as ``tf/test_buffer.py``.

    Raises:
        ValueError: There is none, or several have this name.
    """
    (found,) = (path for path in modules_of_tests() if path.as_posix().endswith(f"tests/{name}"))
    return found
