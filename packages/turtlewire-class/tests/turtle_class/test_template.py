"""The template for GitHub Classroom: its workflow's steps, done here.

The commands of docs/how-to/classroom.md, run.
"""

import json
import os
import shutil
import subprocess

import pytest
import yaml
from tests.how_to import blocks_of
from tests.places import BIN, EXAMPLES, HOW_TO, TURTLEWIRE

from turtle_class.catalogue import exercises
from turtle_class.roster import read_roster
from turtlewire.cli.main import main

from .conftest import solve

TEMPLATE = EXAMPLES / "classroom_template"
WORKFLOW = yaml.safe_load((TEMPLATE / ".github/workflows/classroom.yml").read_text("utf-8"))
STEPS = WORKFLOW["jobs"]["grade"]["steps"]
GRADERS = [step for step in STEPS if "command-grader" in step.get("uses", "")]
NAMES = [exercise.name for exercise in exercises()]


@pytest.fixture
def repository(tmp_path):
    """A student's repository: the first files of all exercises, one of them solved."""
    folder = tmp_path / "student"
    shutil.copytree(TEMPLATE, folder)
    assert main(["class", "start", str(folder)]) == 0
    (static,) = [exercise for exercise in exercises() if exercise.name == "static"]
    solve(static, folder / "static")
    commands = folder / ".venv" / "bin"  # what `./install` makes, see test_bundle.py
    commands.mkdir(parents=True)
    (commands / "turtlewire").symlink_to(TURTLEWIRE)
    return folder


def sh(command, folder, **environment):
    """Run a step as the runner does."""
    return subprocess.run(
        ["bash", "-e", "-c", command],
        cwd=folder,
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.slow
def test_the_graders_and_the_report_run(repository):
    by_name = {step["id"]: step["with"]["command"] for step in GRADERS}
    solved = sh(by_name["static"], repository)
    assert (solved.returncode, solved.stdout) == (0, "static: solved\n"), solved.stderr
    failed = sh(by_name["fixed_carrot"], repository)
    assert failed.returncode == 1
    assert "fixed_carrot: " in failed.stdout
    assert failed.stdout.count("\n") >= 3
    for name in set(NAMES) - {"static", "fixed_carrot"}:
        shutil.rmtree(repository / name)
    (report,) = [step["run"] for step in STEPS if step.get("name") == "Report"]
    assert sh(report, repository).returncode == 1
    assert (repository / "results.xml").read_text().count("<testsuite ") == 2


def test_every_exercise_is_graded_once():
    assert [step["id"] for step in GRADERS] == NAMES
    for step in GRADERS:
        assert step["with"]["command"].endswith(f" -e {step['id']}")
    (points,) = [step for step in STEPS if "grading-reporter" in step.get("uses", "")]
    assert points["with"]["runners"].split(",") == NAMES
    assert set(points["env"]) == {f"{name.upper()}_RESULTS" for name in NAMES}
    older = json.loads((TEMPLATE / ".github/classroom/autograding.json").read_text("utf-8"))
    assert [test["run"] for test in older["tests"]] == [step["with"]["command"] for step in GRADERS]


def test_without_wheels_and_sources_the_install_says_what_to_do(repository):
    (install,) = [step["run"] for step in STEPS if step.get("name") == "Install"]
    done = sh(install, repository, TURTLEWIRE_SOURCE="")
    assert done.returncode == 1
    assert "There is no folder wheelhouse here." in done.stderr


def test_the_container_is_json_and_installs():
    container = json.loads((TEMPLATE / ".devcontainer/devcontainer.json").read_text("utf-8"))
    assert container["postCreateCommand"] == "./install"


PAGE = (HOW_TO / "classroom.md").read_text(encoding="utf-8")


@pytest.mark.slow
def test_the_page_does_what_it_says(run, tmp_path):
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
        program = run(BIN / words[0], *words[1:], "--port", "0", cwd=folder)
        program.wait_for(r"^The class of \d+ is at http://127\.0\.0\.1:\d+/ ")
        program.kill()
        return
    if words[0] == "ros2":
        program = run(
            BIN / words[0], *words[1:], cwd=folder, environment={"TURTLEWIRE_BROWSER": "0"}
        )
        program.wait_for("static_frame_broadcaster|python-\\d.: process started")
        program.kill()
        return
    # The first files are not solved yet; one exercise shows that grading runs.
    some = ["-e", "static"] if "grade" in words else []
    program = run(BIN / words[0], *words[1:], *some, cwd=folder)
    assert program.wait() == (1 if "check" in words else 0), program.text


NUMBERS = {10: "Ten", 11: "Eleven", 12: "Twelve"}


def test_its_figures():
    assert PAGE.startswith(f"# Teach a class\n\n{NUMBERS[len(exercises())]} exercises")
