"""The examples of the how-to pages about bags and trajectories, run."""

from __future__ import annotations

import doctest
import re
import shlex

import numpy as np
import pytest
from tests.bags import SECOND, START, write_bag
from tests.places import HOW_TO

from turtlewire.cli.main import main
from turtlewire.trajectory import Trajectory


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """The files that the pages use: a bag, a circle and two estimates of it."""
    monkeypatch.chdir(tmp_path)
    write_bag(tmp_path / "my_bag")
    angle = np.linspace(0, 2 * np.pi, 500)
    half = angle / 2
    poses = np.zeros((500, 7))
    poses[:, 0], poses[:, 1] = 5 * np.cos(angle), 5 * np.sin(angle)
    poses[:, 5], poses[:, 6] = np.sin(half), np.cos(half)
    stamps = START + np.arange(500) * SECOND // 10
    Trajectory(stamps, poses).save(tmp_path / "truth.tum")
    dice = np.random.default_rng(1)
    for name, size in (("slam_a", 0.02), ("slam_b", 0.06)):
        moved = poses.copy()
        moved[:, :3] += dice.normal(size=(500, 3)) * size + (1, 2, 0)
        Trajectory(stamps, moved).save(tmp_path / f"{name}.tum")
    return tmp_path


@pytest.mark.parametrize(
    ("page", "examples"), [("bags.md", 18), ("notebook.md", 4), ("trajectories.md", 9)]
)
def test_the_examples(folder, page, examples):
    found = doctest.testfile(str(HOW_TO / page), module_relative=False)
    assert found.attempted >= examples
    assert found.failed == 0


@pytest.mark.parametrize(("page", "commands"), [("bags.md", 2), ("trajectories.md", 2)])
def test_the_commands(folder, page, commands, capsys):
    text = (HOW_TO / page).read_text()
    found = []
    for block in re.findall(r"```console\n(.*?)```", text, re.DOTALL):
        for part in re.split(r"^\$ ", block, flags=re.MULTILINE)[1:]:
            command, _, expected = part.partition("\n")
            assert main(shlex.split(command)[1:]) == 0
            assert capsys.readouterr().out == expected
            found.append(command)
    assert len(found) == commands
    assert all((folder / name).exists() for name in re.findall(r"\S+\.svg", " ".join(found)))
