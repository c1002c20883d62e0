"""Packages laid out as colcon lays them out, and the turtles as seen on the wire."""

import os
import re
import shutil
import sys
import threading

import pytest
from tests.places import LEARNING, ROS2


@pytest.fixture
def workspace(tmp_path):
    """Lays an ament_python package out as `colcon build --symlink-install` does.

    The environment that sourcing it would set.
    """

    def build(source):
        name, prefix = source.name, tmp_path / "install" / source.name
        for folder in (f"lib/{name}", "share/ament_index/resource_index/packages"):
            (prefix / folder).mkdir(parents=True)
        (prefix / "share/ament_index/resource_index/packages" / name).touch()
        shutil.copytree(
            source,
            prefix / "share" / name,
            ignore=shutil.ignore_patterns("*.egg-info", "__pycache__"),
        )
        for executable, module in re.findall(
            r"'?\"?(\w+) = ([\w.]+):main", (source / "setup.py").read_text()
        ):
            script = prefix / "lib" / name / executable
            script.write_text(
                f"#!{sys.executable}\nimport sys\nfrom {module} import main\nsys.exit(main())\n"
            )
            script.chmod(0o755)
        path = os.pathsep.join(part for part in (str(source), os.environ.get("PYTHONPATH")) if part)
        return {
            "AMENT_PREFIX_PATH": str(prefix),
            "PYTHONPATH": path,
            "PYTHONDONTWRITEBYTECODE": "1",
            "TURTLEWIRE_PORT": "0",
            "TURTLEWIRE_BROWSER": "0",
        }

    return build


@pytest.fixture
def ros2(run, workspace):
    """Runs `ros2` with our tutorial package sourced, and with further variables."""
    sourced = workspace(LEARNING)
    return lambda *words, **variables: run(ROS2, *words, environment=sourced | variables)


@pytest.fixture
def turtles():
    """Sees where the turtles are, on the wire."""
    from turtlewire import msg, wire
    from turtlewire.wire.base import TypeId
    from turtlewire.wire.qos import QoS

    class Turtles:
        def __init__(self):
            self.context = wire.open_context()
            self.node = self.context.create_node("turtles")
            self.poses = {}
            self.more = threading.Condition()
            for name in ("turtle1", "turtle2"):
                self.watch(name)

        def watch(self, name):
            pose = msg.get_message("turtlesim/msg/Pose")
            type_id = TypeId("turtlesim/msg/Pose", msg.type_hash("turtlesim/msg/Pose"))
            self.node.create_subscription(
                f"/{name}/pose",
                type_id,
                QoS(),
                lambda cdr, _: self._take(name, msg.deserialize(pose, cdr)),
            )

        def _take(self, name, pose):
            with self.more:
                self.poses[name] = pose
                self.more.notify_all()

        def distance(self, one="turtle1", other="turtle2"):
            first, second = self.poses[one], self.poses[other]
            return ((first.x - second.x) ** 2 + (first.y - second.y) ** 2) ** 0.5

        def wait_for(self, condition, timeout=60):
            with self.more:
                assert self.more.wait_for(condition, timeout), self.poses

    turtles = Turtles()
    yield turtles
    turtles.context.close()
