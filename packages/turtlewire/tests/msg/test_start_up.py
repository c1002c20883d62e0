"""The cost of imports in modules: heavy modules are imported only when they are needed."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest
from tests.programs import run_python

HEAVY = {
    "numpy",
    "dataclasses",
    "inspect",
    "asyncio",
    "json",
    "yaml",
    "concurrent",
    "subprocess",
    "uuid",
    "http",
    "logging",
    "argparse",
}


@pytest.mark.parametrize(
    "program",
    [
        "from turtlewire import msg",
        (
            "from turtlewire import msg; cls = msg.get_message('tf2_msgs/msg/TFMessage'); "
            "msg.deserialize(cls, msg.serialize(cls()))"
        ),
        "from geometry_msgs.msg import TransformStamped; TransformStamped()",
        (
            "from turtlewire import msg; cls = msg.get_message('sensor_msgs/msg/Imu'); "
            "msg.serialize(msg.deserialize(cls, msg.serialize(cls())))"
        ),
        "from turtlewire import msg; msg.type_hash('rcl_interfaces/srv/SetParameters_Request')",
        "import rosidl_runtime_py.utilities",
    ],
)
def test_nothing_heavy_is_imported(program):
    code = (
        program + "\nimport sys\nloaded = {name.partition('.')[0] for name in sys.modules}\nimport "
        "json\nprint(json.dumps(sorted(loaded)))"
    )
    done = subprocess.run(
        [sys.executable, "-I", "-c", code], capture_output=True, text=True, check=True
    )
    assert HEAVY & set(json.loads(done.stdout)) == set()


def test_a_codec_is_generated_at_first_use_only():
    program = """
from turtlewire import msg
cls = msg.get_message("geometry_msgs/msg/Twist")
made = lambda: [m.__code__.co_filename.startswith("<") for m in (cls._to_cdr, cls._from_cdr)]
steps = [made()]
data = msg.serialize(cls())
steps.append(made())
msg.deserialize(cls, data)
print([*steps, made()])
"""
    done = run_python(program)
    assert done.stdout == "[[False, False], [True, False], [True, True]]\n"
