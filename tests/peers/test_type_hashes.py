"""Type hashes of random interfaces are those that a real ROS 2 calculates."""

import json
import os
import random
from pathlib import Path

import pytest

from turtlewire import msg

pytestmark = pytest.mark.slow
HASHES = Path(__file__).with_name("type_hashes.py")
TYPES = [
    "bool",
    "byte",
    "char",
    "int8",
    "uint8",
    "int16",
    "uint16",
    "int32",
    "uint32",
    "int64",
    "uint64",
    "float32",
    "float64",
    "string",
    "wstring",
    "string<=7",
    "wstring<=3",
    "builtin_interfaces/Time",
    "std_msgs/Header",
    "geometry_msgs/Pose",
]


def make_package(package, draw):
    """Write 53 interfaces; messages have fields of the messages before them."""
    made = []

    def part(most):
        lines = [
            f"{draw.choice(TYPES + 2 * made)}{draw.choice(['', '', '[]', '[2]', '[<=256]'])} f{i}"
            for i in range(draw.randint(0, most))
        ]
        return "\n".join([*lines, "int32 A=1  # is not a part of the hash", ""])

    def write(kind, name, *parts):
        path = package / kind / f"{name}.{kind}"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("---\n".join(parts))

    for number in range(40):
        write("msg", f"Message{number}", part(8))
        made.append(f"Message{number}")
    for number in range(8):
        write("srv", f"Service{number}", part(4), part(4))
    for number in range(5):
        write("action", f"Action{number}", part(3), part(3), part(3))


@pytest.mark.parametrize("seed", range(2))
def test_type_hashes_are_those_of_a_real_ros(seed, venv, real, tmp_path, monkeypatch):
    name = f"random_{seed}"
    share = tmp_path / "share"
    make_package(share / name, random.Random(seed))
    index = share / "ament_index" / "resource_index" / "packages"
    index.mkdir(parents=True)
    (index / name).touch()
    program = real(share / name, program=HASHES, AMENT_PREFIX_PATH=str(venv))
    assert program.wait() == 0, program.text
    theirs = json.loads(program.text.splitlines()[-1])
    monkeypatch.setenv("AMENT_PREFIX_PATH", os.pathsep.join([str(tmp_path), str(venv)]))
    ours = {interface: msg.type_hash(interface) for interface in theirs}
    assert ours == theirs
    assert len(theirs) > 100
