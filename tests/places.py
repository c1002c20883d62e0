"""Folders of the checkout that tests read."""

from __future__ import annotations

from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
#: Bytes, texts, traces and bags that were captured from a real ROS 2.
GOLDEN = ROOT / "tests" / "golden"
EXAMPLES = ROOT / "examples"
HOW_TO = ROOT / "docs" / "how-to"
SCRIPTS = ROOT / "scripts"
#: The engine: it has `native` and `src`.
ENGINE = ROOT / "packages" / "turtlewire"
#: ROS 2's packages.
ROS = ROOT / "packages" / "turtlewire-ros"
#: The product's Python packages, and the folders from which they are imported.
PACKAGES = sorted(init.parent for init in ROOT.glob("packages/*/*/*/__init__.py"))
IMPORT_PATH = sorted({package.parent for package in PACKAGES})
#: The tutorial's package.
LEARNING = ROOT / "examples" / "learning_tf2_py"
LESSON_CODE = ROOT / "packages" / "turtlewire-class" / "src"
LESSONS = LESSON_CODE / "turtle_lesson" / "lessons"
#: Sphinx's settings.
SITE = ROOT / "docs" / "sphinx"
