"""Extensions of `Node`, which other packages add by entry points."""

import logging

import pytest

from launch_ros._node import extensions
from launch_ros.actions import Node
from launch_ros.actions.node import NodeActionExtension, get_extensions, instantiate_extension
from launch_ros.utilities.plugin_support import (
    PluginException,
    get_upper_bound_caret_version,
    satisfies_version,
)

MODULE = """
from launch.substitutions import EnvironmentVariable
from launch_ros.actions.node import NodeActionExtension

class Secure(NodeActionExtension):
    def prepare_for_execute(self, context, ros_specific_arguments, node_action):
        words = ["--enclave", [EnvironmentVariable("ENCLAVE")]]
        return words, {**ros_specific_arguments, "ns": "__ns:=/moved"}

class Old(NodeActionExtension):
    EXTENSION_POINT_VERSION = "0.0"

class Broken(NodeActionExtension):
    def __init__(self):
        raise ValueError("no key")
"""


@pytest.fixture
def install(tmp_path, monkeypatch):
    """Makes a package with extensions; each argument is a name and an object of `MODULE`."""
    (tmp_path / "node_extensions_of_others.py").write_text(MODULE)
    monkeypatch.syspath_prepend(tmp_path)
    info = tmp_path / "others-1.0.dist-info"
    info.mkdir()

    def write(**found):
        lines = [f"{name} = node_extensions_of_others:{cls}" for name, cls in found.items()]
        text = "\n".join(["[launch_ros.node_action]", *lines, ""])
        (info / "entry_points.txt").write_text(text)
        extensions._entries.cache_clear()

    yield write
    extensions._entries.cache_clear()


def test_an_extension_adds_words_and_changes_names(install, launch, monkeypatch, tmp_path):
    monkeypatch.setenv("ENCLAVE", "/talker")
    install(secure="Secure")
    script = tmp_path / "show.py"
    script.write_text("#!/usr/bin/env python3\nimport sys; print(*sys.argv[1:])")
    script.chmod(0o755)
    node = Node(executable=str(script), name="talker", namespace="robot", output="screen")
    outcome = launch(node)
    words = "--ros-args -r __node:=talker -r __ns:=/moved --enclave /talker"
    assert words in outcome.text


def test_extensions_that_fail_are_left_out(install, caplog):
    install(secure="Secure", old="Old", broken="Broken", absent="Absent")
    found = get_extensions(logging.getLogger("test"))
    assert {name: each.NAME for name, each in found.items()} == {"secure": "secure"}
    told = {(line.levelname, line.getMessage().partition(": ")[0]) for line in caplog.records}
    group = "Failed to instantiate 'launch_ros.node_action' extension"
    assert told == {
        ("WARNING", f"{group} 'old'"),
        ("ERROR", f"{group} 'broken'"),
        ("WARNING", "Failed to load entry point 'absent'"),
    }


def test_instances_are_kept_unless_a_new_one_is_wanted():
    logger, kept = logging.getLogger("test"), {}
    first = instantiate_extension("group", "plain", NodeActionExtension, kept, logger)
    again = instantiate_extension("group", "plain", NodeActionExtension, kept, logger)
    other = instantiate_extension(
        "group", "plain", NodeActionExtension, kept, logger, unique_instance=True
    )
    assert kept == {"plain": first}
    assert again is first
    assert other is not first
    names = {"name": "__node:=talker"}
    assert first.prepare_for_execute(None, names, None) == ([], names)


def test_versions():
    satisfies_version("0.1.5", "^0.1")
    for version in ("0.0", "0.2"):
        with pytest.raises(PluginException):
            satisfies_version(version, "^0.1")
    assert get_upper_bound_caret_version("1.2.3") == "2.0.0"
