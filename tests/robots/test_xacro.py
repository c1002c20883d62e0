"""xacro from PyPI prints what the one of ROS 2 printed (`tests/golden/robots/xacro`)."""

import json
import re
import subprocess
import xml.etree.ElementTree as ET

import pytest
from tests.places import BIN

from tests import archive, places

GOLDEN = places.GOLDEN / "robots"
XACRO = BIN / "xacro"
RUNS = {
    " ".join(run["args"]): run for run in json.loads((GOLDEN / "xacro/expected.json").read_text())
}
DEVIATIONS = re.findall(r"^\| (xacro .*?) \|", (GOLDEN / "DEVIATIONS.md").read_text(), re.MULTILINE)


def elements(text):
    return [
        (each.tag, sorted(each.items()), (each.text or "").strip())
        for each in ET.fromstring(text).iter()
    ]


def errors(text):
    """Return the errors without traceback lines, which contain installation paths."""
    return [
        line
        for line in text.splitlines()
        if line.strip() and not line.startswith((" ", "Traceback"))
    ]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The files that the runs read."""
    path = tmp_path_factory.mktemp("xacro")
    archive.unpack(GOLDEN / "xacro" / "files.txt", path)
    return path


@pytest.mark.parametrize("name", sorted(RUNS))
def test_golden(name, folder):
    expected = RUNS[name]
    got = subprocess.run(
        [XACRO, *expected["args"]],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    assert got.returncode == expected["exit"]
    if "--deps" in name:  # xacro prints a set
        assert sorted(got.stdout.split()) == sorted(expected["stdout"].split())
    elif expected["stdout"]:
        assert elements(got.stdout) == elements(expected["stdout"])
    is_equal = errors(got.stderr) == errors(expected["stderr"])
    assert is_equal != (f"xacro {name} stderr" in DEVIATIONS)


def test_all_runs_are_there():
    assert len(RUNS) == 8
    assert len(DEVIATIONS) == 1
