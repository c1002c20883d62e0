"""Our rclpy gives the answers of a real one, of Jazzy and of Kilted.

Questions without a useful answer are left out: crashes, and a TypeError that shows a C++ signature.
"""

import ast
import json
import sys
from pathlib import Path

import pytest
from tests.peers.answers import sections

pytestmark = pytest.mark.slow
ANSWERS = Path(__file__).with_name("answers.py")
QUESTIONS = Path(__file__).with_name("questions.txt")


def answers(program):
    assert program.wait() == 0, program.text
    return json.loads(program.text.splitlines()[-1])


@pytest.mark.parametrize("section", sections(QUESTIONS))
def test_ours_and_a_real_rclpy_give_the_same_answers(section, real, run, venv, tmp_path):
    theirs = answers(real(QUESTIONS, section, program=ANSWERS))
    environment = {"AMENT_PREFIX_PATH": str(venv), "ROS_DISTRO": venv.name}
    command = (sys.executable, ANSWERS, QUESTIONS, section)
    ours = answers(run(*command, environment=environment, cwd=tmp_path))
    asked = [ast.unparse(question) for question in sections(QUESTIONS)[section]]
    assert list(zip(asked, ours, strict=True)) == list(zip(asked, theirs, strict=True))
    assert not any(answer.startswith("NameError") for answer in ours)  # an earlier statement failed
