"""The student's files use only what a real ROS 2 has: names, members and keywords.

`tests/golden/surface.json` was captured from a real ROS 2 Jazzy.
"""

import ast
import json
import re

import pytest
from tests.places import LESSONS

from tests import places

GOLDEN = json.loads((places.GOLDEN / "surface.json").read_text(encoding="utf-8"))
FILES = sorted(LESSONS.glob("*/*/*.py"))
SURFACE = GOLDEN["rclpy"] | GOLDEN["tf2"]
#: Without a captured surface: the standard library and the messages, whose definitions are ROS 2's.
OTHERS = {"math", "sys", "geometry_msgs.msg", "turtlesim.msg"}
#: Compiled names, which the capture left out; the document's own listener imports it.
COMPILED = {"tf2_ros": {"TransformException"}}


def members_of_all_classes():
    """Names of members to their signatures, one from each class."""
    found = {}
    for names in SURFACE.values():
        for facts in names.values():
            for name, signature in facts.get("members", {}).items():
                found.setdefault(name, []).append(signature)
            if "signature" in facts:
                found.setdefault("__init__", []).append(facts["signature"])
    return found


def unknown_names(source):
    """What a file uses and a real ROS 2 does not have."""
    tree = ast.parse(source)
    imports = [node for node in ast.walk(tree) if isinstance(node, (ast.Import, ast.ImportFrom))]
    unknown = [name for node in imports for name in _unknown_imports(node)]
    own = {node.name for node in ast.walk(tree) if isinstance(node, (ast.FunctionDef))}
    members = members_of_all_classes()
    for call in (node for node in ast.walk(tree) if isinstance(node, ast.Call)):
        if not isinstance(call.func, ast.Attribute) or call.func.attr in own:
            continue
        whole = ast.unparse(call.func)
        module, _, name = whole.rpartition(".")
        if module in OTHERS or module == "super()":
            continue
        if module in SURFACE:
            signatures = [SURFACE[module][name].get("signature")] if name in SURFACE[module] else []
        else:
            signatures = members.get(name, [])
        wanted = [keyword.arg for keyword in call.keywords]
        if not any(_takes(signature, wanted) for signature in signatures):
            unknown.append(f"{whole}({', '.join(wanted)})")
    return unknown


def _unknown_imports(node):
    if isinstance(node, ast.Import):
        return [alias.name for alias in node.names if alias.name not in {*SURFACE, *OTHERS}]
    if node.module in OTHERS:
        return []
    known = {*SURFACE.get(node.module, {}), *COMPILED.get(node.module, ())}
    return [f"{node.module}.{alias.name}" for alias in node.names if alias.name not in known]


def _takes(signature, keywords):
    """Whether a signature, as it was captured, has these parameters; some were not captured."""
    if signature is None or not signature.startswith(("(", "async (")):
        return not keywords
    if "**" in signature:
        return True
    return all(re.search(rf"[(\s]{keyword}[=,)]", signature) for keyword in keywords)


@pytest.mark.parametrize("path", FILES, ids=lambda path: "-".join(path.parts[-3:]))
def test_a_file_uses_only_what_a_real_ros_2_has(path):
    assert unknown_names(path.read_text(encoding="utf-8")) == []


@pytest.mark.parametrize(
    ("source", "unknown"),
    [
        ("import turtlewire", "turtlewire"),
        ("from tf2_ros import Frames", "tf2_ros.Frames"),
        ("import rclpy\nrclpy.spin_for(node)", "rclpy.spin_for()"),
        ("node.create_thing(1)", "node.create_thing()"),
        ("node.create_timer(1.0, f, name='x')", "node.create_timer(name)"),
    ],
)
def test_other_names_are_found(source, unknown):
    assert unknown_names(source) == [unknown]
