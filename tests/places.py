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
ENGINE = ROOT
#: ROS 2's packages.
ROS = ROOT / "ros"
#: Folders from which the product's Python packages are imported.
IMPORT_PATH = (ENGINE / "src", ROS)
#: The tutorial's package.
LEARNING = ROOT / "ros2_ws" / "src" / "learning_tf2_py"
LESSONS = ROOT / "site" / "lesson" / "lessons"
LESSON_CODE = ROOT / "site" / "lesson" / "python"
#: Sphinx's settings.
SITE = ROOT / "site" / "docs"
