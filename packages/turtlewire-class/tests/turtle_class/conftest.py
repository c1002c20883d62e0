"""Submissions of students, some of which are wrong or hostile."""

import pytest

from turtle_class.catalogue import chosen
from turtle_lesson.lesson import load_lesson

FILE = "fixed_frame_tf2_broadcaster.py"
CALLBACK = "    def broadcast_timer_callback(self):\n"

#: Changes of the solution of ``fixed_carrot``: right and wrong text.
SILLY = {
    "solved": ("", ""),
    "endless": (CALLBACK, f"{CALLBACK}        while True:\n            pass\n"),
    "waits": (CALLBACK, f"{CALLBACK}        import time\n        time.sleep(1e6)\n"),
    "exits": (CALLBACK, f"{CALLBACK}        import os\n        os._exit(0)\n"),
    "forks": (CALLBACK, f"{CALLBACK}        import os\n        os.fork()\n"),
    "crashes": (CALLBACK, f"{CALLBACK}        import ctypes\n        ctypes.string_at(0)\n"),
    "floods": (CALLBACK, f"{CALLBACK}        print('<b>flood</b>\\x1b[2J' * 100_000)\n"),
    "misspelt": ("TransformStamped()", "TransformStampde()"),
    "eats_memory": (CALLBACK, f"{CALLBACK}        self.all = 'x' * (1 << 40)\n"),
}


def solution():
    (exercise,) = chosen(["fixed_carrot"])
    return load_lesson(exercise.folder).solution()[FILE]


def solve(exercise, folder):
    """Write the solution of an exercise into a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in load_lesson(exercise.folder).solution().items():
        (folder / name).write_text(text, encoding="utf-8")


@pytest.fixture
def submissions(tmp_path):
    """Makes a folder of submissions: ``{student: text of the file}``."""

    def make(texts):
        for student, text in texts.items():
            folder = tmp_path / "class" / student / "fixed_carrot"
            folder.mkdir(parents=True)
            (folder / FILE).write_text(text, encoding="utf-8")
        return tmp_path / "class"

    return make


def silly(name):
    right, wrong = SILLY[name]
    text = solution()
    assert right in text
    return text.replace(right, wrong, 1) if right else text
