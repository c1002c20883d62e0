"""Our tutorial package must run on a real ROS 2.

It imports only names that a real ROS 2 Jazzy has.
"""

from __future__ import annotations

import ast
import importlib.util
import json
import sys
from xml.etree import ElementTree as ET

import pytest
from tests.places import GOLDEN, LEARNING

from turtlewire.msg.registry import interfaces

PACKAGE = LEARNING
FILES = sorted([*PACKAGE.glob("learning_tf2_py/*.py"), *PACKAGE.glob("launch/*.py")])
#: Module to names, captured from a real ROS 2 Jazzy.
SURFACE = {
    module: names.split()
    for module, names in json.loads((GOLDEN / "tutorial" / "surface.json").read_text()).items()
}
# The capture leaves out the names that a module hands on from another package, here tf2_py.
SURFACE["tf2_ros"].append("TransformException")


def imports(code: str) -> list[tuple[str, str]]:
    """Pairs of module and name that ``code`` needs; those that it can do without are left out."""
    tree = ast.parse(code)
    optional = {
        id(statement)
        for node in ast.walk(tree)
        if isinstance(node, ast.Try)
        and any(ast.unparse(handler.type) == "ImportError" for handler in node.handlers)
        for statement in node.body
    }
    found = []
    for node in ast.walk(tree):
        if id(node) in optional:
            continue
        if isinstance(node, ast.Import):
            found += [(alias.name, "") for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            found += [(node.module, alias.name) for alias in node.names]
    return found


def is_on_real_ros(module: str, name: str) -> bool:
    package, _, kind = module.partition(".")
    if package == "learning_tf2_py" or package in sys.stdlib_module_names:
        return True
    if kind in {"msg", "srv"}:
        return name in interfaces().get(package, {}).get(kind, [])
    return module in SURFACE and (not name or name in SURFACE[module])


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.name)
def test_a_real_ros_has_all_that_is_imported(file):
    missing = [pair for pair in imports(file.read_text()) if not is_on_real_ros(*pair)]
    assert missing == []


def test_the_check_finds_what_a_real_ros_lacks():
    code = """
from turtlesim.turtlesim_node import TurtlesimNode
from turtlesim.msg import Posture
from rclpy.impl.hints import with_hint
import turtlewire
try:
    import fast
except ImportError:
    fast = None
"""
    assert [module for module, name in imports(code) if not is_on_real_ros(module, name)] == [
        "turtlesim.turtlesim_node",
        "turtlesim.msg",
        "rclpy.impl.hints",
        "turtlewire",
    ]


def test_every_imported_package_is_a_dependency():
    depends = {node.text for node in ET.parse(PACKAGE / "package.xml").iter("depend")}
    used = {
        module.partition(".")[0] for file in FILES for module, _name in imports(file.read_text())
    }
    assert used - {"learning_tf2_py"} - sys.stdlib_module_names == depends


def launched(monkeypatch, *, simulator_is_a_module: bool) -> list[str]:
    find_spec = importlib.util.find_spec

    def find(name, package=None):
        if name != "turtlesim.turtlesim_node" or simulator_is_a_module:
            return find_spec(name, package)
        return None

    monkeypatch.setattr(importlib.util, "find_spec", find)
    spec = importlib.util.spec_from_file_location("swarm", PACKAGE / "launch" / "swarm.launch.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    entities = module.generate_launch_description().entities
    return [entity.node_executable for entity in entities if hasattr(entity, "node_executable")]


def test_the_swarm_runs_beside_a_simulator_that_is_a_program(monkeypatch):
    assert launched(monkeypatch, simulator_is_a_module=True) == ["swarm_with_simulator"]
    assert launched(monkeypatch, simulator_is_a_module=False) == ["turtlesim_node", "swarm"]


def test_a_simulator_that_is_a_program_cannot_share_the_process(monkeypatch):
    monkeypatch.syspath_prepend(str(PACKAGE))
    monkeypatch.setitem(sys.modules, "turtlesim.turtlesim_node", None)
    monkeypatch.delitem(sys.modules, "learning_tf2_py.swarm_with_simulator", raising=False)
    from learning_tf2_py import swarm_with_simulator

    with pytest.raises(SystemExit, match="run turtlesim_node and swarm instead"):
        swarm_with_simulator.main([])
    monkeypatch.delitem(sys.modules, "learning_tf2_py.swarm_with_simulator")
