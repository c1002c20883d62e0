"""The exercises: the lessons of the browser tab, and more, in one format."""

from __future__ import annotations

import html
import json
import re
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import turtle_lesson
from turtle_class import ClassError
from turtlewire.terminal.suggestion import did_you_mean

__all__ = ["LAUNCH_FILE", "ExerciseFolder", "chosen", "exercises"]

_FOLDERS = (
    Path(turtle_lesson.__file__).resolve().parent / "lessons",
    Path(__file__).resolve().parent / "exercises",
)
#: The name of the launch file in the folder of each exercise.
LAUNCH_FILE = "exercise.launch.py"
#: Texts that apply only to the browser tab.
_BROWSER = re.compile(r'<(\w+) class="browser">.*?</\1>', re.DOTALL)


class ExerciseFolder(NamedTuple):
    """An exercise.

    Attributes:
        name: Its folder's name; students hand in a folder of the same name.
        title: What it is about.
        files: Names of the files that a student hands in.
        folder: Where its text, first files, solution and checks are.
        target: The frame in which its transform is expressed.
        source: The frame whose pose it is about.
    """

    name: str
    title: str
    files: tuple[str, ...]
    folder: Path
    target: str
    source: str

    def text(self) -> str:
        """Return the text and the task, as HTML."""
        return (self.folder / "text.html").read_text(encoding="utf-8")

    def plain_text(self) -> str:
        """Return the text, the task and the commands, as Markdown without links.

        What holds in the browser tab only (`class="browser"`) is left out.
        """
        text = _BROWSER.sub("", self.text())
        text = re.sub(r"</?(?:code)>", "`", text)
        text = re.sub(r"<h2>(.*?)</h2>", lambda found: f"# {found[1]}\n", text)
        text = re.sub(r"</?(?:em)>", "*", re.sub(r"</?strong>", "**", text))
        text = re.sub(r"\s*<li>", "\n- ", text)
        text = re.sub(r"<pre[^>]*>(.*?)</pre>", r"\n```\n\1\n```", text, flags=re.DOTALL)
        text = re.sub(r"</p>|</ul>", "\n", text)
        text = html.unescape(re.sub(r"<[^>]*>", "", text)).strip()
        text = re.sub(r"\n{3,}", "\n\n", text)
        return f"{text}\n\n{self._commands()}"

    def _commands(self) -> str:
        """Return the commands to run and check the exercise in a terminal, as Markdown."""
        files = " and ".join(f"`{file}`" for file in self.files)
        echo = f"ros2 run tf2_ros tf2_echo {self.target} {self.source}"
        return f"""\
## In a terminal

Edit {files}, and type in this folder:

```
ros2 launch {LAUNCH_FILE}
```

Ctrl-C ends it. In a second terminal, also in this folder:

```
# drive turtle1 with the arrow keys
ros2 run turtlesim turtle_teleop_key
# the tree of frames
turtlewire frames
# the transform of this exercise, in numbers
{echo}
# the checks, which report what they saw and give hints
turtlewire class check .. -e {self.name}
```
"""


def exercises() -> list[ExerciseFolder]:
    """Return all exercises, in the order of teaching."""
    return [exercise for folder in _FOLDERS for exercise in _of(folder)]


def chosen(names: Sequence[str]) -> list[ExerciseFolder]:
    """Return the exercises with these names, or all exercises without names.

    Raises:
        ClassError: No exercise has one of the names.
    """
    known = {exercise.name: exercise for exercise in exercises()}
    for name in names:
        if name not in known:
            raise ClassError(
                f"there is no exercise {name!r}; choose from {', '.join(known)}. "
                f"{did_you_mean(name, list(known))}".strip()
            )
    return [known[name] for name in names] if names else list(known.values())


def _of(folder: Path) -> list[ExerciseFolder]:
    order = json.loads((folder / "order.json").read_text(encoding="utf-8"))
    return [_read(folder / name) for name in order]


def _read(folder: Path) -> ExerciseFolder:
    facts = json.loads((folder / "lesson.json").read_text(encoding="utf-8"))
    return ExerciseFolder(
        folder.name, facts["title"], tuple(facts["files"]), folder, facts["target"], facts["source"]
    )
