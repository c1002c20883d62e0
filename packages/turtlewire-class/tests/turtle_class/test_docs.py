"""The commands of docs/how-to/classroom.md, run."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys

from tests.how_to import blocks_of
from tests.places import EXAMPLES, HOW_TO, ROS2

from turtle_class.catalogue import exercises
from turtle_class.roster import read_roster

from .conftest import solve

PAGE = (HOW_TO / "classroom.md").read_text(encoding="utf-8")
PROGRAM = "import sys; from turtlewire.cli.main import main; sys.exit(main())"


def test_the_page_does_what_it_says(run, tmp_path, monkeypatch):
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(sys.path))
    shutil.copytree(EXAMPLES, tmp_path / "examples")
    (tmp_path / "roster.csv").write_text(blocks_of(PAGE, "text")[0], encoding="utf-8")
    assert [seat.name for seat in read_roster(tmp_path / "roster.csv")] == ["Ana", "Björn"]
    solved = exercises()[0]
    solve(solved, tmp_path / "submissions/ana" / solved.name)
    lines = [line for block in blocks_of(PAGE, "sh") for line in block.splitlines()]
    assert len(lines) == 9
    for line in lines:
        do(run, line, tmp_path)
    assert "ana.html" in (tmp_path / "reports/index.html").read_text(encoding="utf-8")
    assert (tmp_path / "reports/junit/ana.xml").exists()
    assert (tmp_path / "template/static/README.md").exists()


def do(run, line, folder):
    words = line.split()
    if words[0] == "cp":
        subprocess.run(words, cwd=folder, check=True)
        return
    if "--domains" in words or "--roster" in words:
        program = run(sys.executable, "-c", PROGRAM, *words[1:], "--port", "0", cwd=folder)
        program.wait_for(r"^The class of \d+ is at http://127\.0\.0\.1:\d+/ ")
        program.kill()
        return
    if words[0] == "ros2":
        ros2 = ROS2
        program = run(ros2, *words[1:], cwd=folder, environment={"TURTLEWIRE_BROWSER": "0"})
        program.wait_for("static_frame_broadcaster|python-\\d.: process started")
        program.kill()
        return
    # The first files are not solved yet; one exercise shows that grading runs.
    some = ["-e", "static"] if "grade" in words else []
    program = run(sys.executable, "-c", PROGRAM, *words[1:], *some, cwd=folder)
    assert program.wait() == (1 if "check" in words else 0), program.text


NUMBERS = {10: "Ten", 11: "Eleven", 12: "Twelve"}


def test_its_figures():
    assert PAGE.startswith(f"# Teach a class\n\n{NUMBERS[len(exercises())]} exercises")
