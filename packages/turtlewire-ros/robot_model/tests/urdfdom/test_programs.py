"""`check_urdf` and `urdf_to_graphviz`."""

import io
import subprocess
import sys

import pytest
from tests.disks import full_disk
from tests.places import BIN

from tests import archive, places
from urdfdom import check_urdf, urdf_to_graphviz

GOLDEN = places.GOLDEN / "robots"
RAFT = archive.read(GOLDEN / "urdf.txt")["raft.urdf"].content

TREE = """robot name is: raft
---------- Successfully Parsed XML ---------------
root Link: raft_root has 2 child(ren)
    child(1):  deck
        child(1):  sail
            child(1):  lamp
                child(1):  lamp_lens
                child(2):  puck
    child(2):  slab
        child(1):  pin
"""
REFUSED = """Error:   Unable to parse component [zero] to a double (while parsing a vector value)
         at line 6 in <origin> in <joint name="j">
Error:   Malformed parent origin element for joint [j]
Error:   joint xml is not initialized correctly
ERROR: Model Parsing the xml failed
"""


@pytest.fixture
def raft(tmp_path):
    """The path of a valid file."""
    path = tmp_path / "raft.urdf"
    path.write_bytes(RAFT)
    return str(path)


def test_the_tree(capsys, raft):
    assert check_urdf.main(["check_urdf", raft]) == 0
    assert capsys.readouterr().out == TREE


def test_from_stdin(capsys, monkeypatch):
    class Stdin:
        buffer = io.BytesIO(RAFT)

    monkeypatch.setattr(sys, "stdin", Stdin)
    assert check_urdf.main(["check_urdf", "-"]) == 0
    assert capsys.readouterr().out == TREE


@pytest.mark.parametrize("program", [check_urdf, urdf_to_graphviz])
def test_invalid_urdf(program, capsys, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    urdf = archive.read(GOLDEN / "invalid.txt")["bad_number.urdf"].content
    (tmp_path / "bad.urdf").write_bytes(urdf)
    assert program.main(["program", "bad.urdf"]) == 1
    assert capsys.readouterr().err == REFUSED
    assert [path.name for path in tmp_path.iterdir()] == ["bad.urdf"]


@pytest.mark.parametrize("program", [check_urdf, urdf_to_graphviz])
def test_a_file_that_is_not_there(program, capsys):
    assert program.main(["program", "no_such.urdf"]) == 1
    assert "no_such.urdf: No such file or directory" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("program", "text"),
    [
        (check_urdf, "Expect URDF xml file to parse. Use - for stdin"),
        (urdf_to_graphviz, "Usage: urdf_to_graphviz input.xml [OUTPUT]"),
    ],
)
def test_usage(program, text, capsys):
    assert program.main(["program"]) == 255
    assert text in capsys.readouterr().err
    assert program.main(["program", "--help"]) == 0
    assert text in capsys.readouterr().out


def test_drawings(capsys, monkeypatch, tmp_path, raft):
    monkeypatch.chdir(tmp_path)
    assert urdf_to_graphviz.main(["urdf_to_graphviz", raft]) == 0
    assert capsys.readouterr().out == "Created file raft.gv\nCreated file raft.pdf\n"
    dot = (tmp_path / "raft.gv").read_text()
    assert '"lamp_fix" -> "lamp"\n' in dot
    assert '"sail" -> "lamp_fix" [label="xyz: 0.1 0.1 0.1 \\nrpy: 0.01 0.02 0.03"]' in dot
    assert (tmp_path / "raft.pdf").read_bytes().startswith(b"%PDF-1.4")


@pytest.mark.parametrize(
    ("rpy", "drawn"),
    [("0 0 0", "0 -0 0"), ("4 0 0", "-2.28319 -0 0"), ("0 1.5707963 0", "0 1.5708 -0")],
)
def test_angles_are_drawn_as_by_debians_urdf_to_graphviz(monkeypatch, tmp_path, rpy, drawn):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "two.urdf").write_text(
        '<robot name="two"><link name="a"/><link name="b"/><joint name="j" type="fixed">'
        f'<parent link="a"/><child link="b"/><origin rpy="{rpy}"/></joint></robot>'
    )
    assert urdf_to_graphviz.main(["urdf_to_graphviz", "two.urdf"]) == 0
    assert f'\\nrpy: {drawn}"]' in (tmp_path / "two.gv").read_text()


def test_a_full_disk_is_reported_and_leaves_the_older_file(capsys, tmp_path, raft):
    path = tmp_path / "raft.gv"
    path.write_text("older")
    with full_disk():
        assert urdf_to_graphviz.main(["urdf_to_graphviz", str(raft), str(tmp_path / "raft")]) == 1
    assert capsys.readouterr().err == f"urdf_to_graphviz: {path}: File too large\n"
    assert path.read_text() == "older"


def test_a_robot_cannot_choose_the_folder(monkeypatch, tmp_path):
    folder = tmp_path / "here"
    folder.mkdir()
    monkeypatch.chdir(folder)
    (tmp_path / "evil.urdf").write_text('<robot name="../evil"><link name="&quot;"/></robot>')
    assert urdf_to_graphviz.main(["urdf_to_graphviz", "../evil.urdf"]) == 0
    assert sorted(path.name for path in folder.iterdir()) == [".._evil.gv", ".._evil.pdf"]


def test_a_closed_pipe_is_quiet(raft):
    chain = subprocess.run(
        f"{sys.executable} -m urdfdom.check_urdf {raft} | true",
        shell=True,
        capture_output=True,
        timeout=300,
        check=True,
    )
    assert chain.stderr == b""


@pytest.mark.parametrize("name", ["check_urdf", "urdf_to_graphviz"])
def test_as_a_command_and_with_ros2_run(name):
    folder = BIN
    for command in ([folder / name], [folder / "ros2", "run", "urdfdom", name]):
        done = subprocess.run(
            [*command, "--help"], capture_output=True, text=True, timeout=300, check=True
        )
        assert name in done.stdout
