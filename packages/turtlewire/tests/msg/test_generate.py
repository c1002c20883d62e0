"""A user's own interface package becomes Python modules: no compiler, no import hook.

The examples of docs/interfaces.md are run.
"""

import doctest
import importlib
import os
import re
import subprocess
import sys

import pytest
from tests.places import IMPORT_PATH, ROOT
from tests.programs import run_python

from turtlewire.errors import InterfaceError
from turtlewire.msg import registry
from turtlewire.msg.generate import generate_package

PAGE = ROOT / "docs" / "interfaces.md"
OF_PAGE = {
    "package.xml": "<package format='3'><name>my_interfaces</name></package>",
    "msg/Sphere.msg": "geometry_msgs/Point center\nfloat64 radius 1.0\n",
    "srv/Grow.srv": "Sphere sphere\nfloat64 by\n---\nSphere sphere\n",
}
FILES = {
    "package.xml": "<package format='3'><name>my_interfaces</name></package>",
    "msg/Sphere.msg": "geometry_msgs/Point center\nfloat64 radius 1.5\n",
    "msg/Everything.msg": """
        # every primitive type, and what can be made of them
        int32 LIMIT=12
        string NAME="every # thing"
        bool yes true
        byte raw 7
        char letter
        int8 a
        uint8 b
        int16 c
        uint16 d
        int32 e
        uint32 f
        int64 g
        uint64 h
        float32 i
        float64 j
        string text "hello"
        wstring wide
        string<=5 short
        wstring<=5 wide_short
        Sphere[2] pair
        Sphere[] many
        Sphere[<=3] few
        float64[] numbers [1.0, 2.0]
        uint8[<=4] few_numbers
        int16[3] three [1, 2, 3]
        string<=4[<=2] names
        bool[2] flags
        byte[] blob
        string[2] words ["a", "b"]
        """,
    "srv/AddSphere.srv": "Sphere sphere\n---\nbool success\n",
    "action/Roll.action": "float32 distance\n---\nSphere where\n---\nfloat32 left\n",
}


@pytest.fixture(autouse=True)
def own_registry(monkeypatch):
    """Restore the registry after each test, because generated packages register themselves."""
    monkeypatch.setattr(registry, "_registered", {})


@pytest.fixture
def source(tmp_path):
    folder = tmp_path / "src" / "some_folder"
    for name, text in FILES.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return folder


def run_command(source, output):
    command = [sys.executable, "-m", "turtlewire.msg", str(source), "--output", str(output)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


@pytest.fixture
def generated(source, tmp_path):
    """The folder to put on PYTHONPATH, made by the command line."""
    output = tmp_path / "out"
    done = run_command(source, output)
    assert done.stdout.startswith(f"{output / 'my_interfaces'} is ready")
    return output


def test_the_modules_are_imported_like_any(generated, source):
    for path in sorted(
        source.rglob("*"), reverse=True
    ):  # the package does not need its sources any more
        path.rmdir() if path.is_dir() else path.unlink()
    program = """
import sys
from my_interfaces.msg import Sphere, Everything
from my_interfaces.srv import AddSphere
from my_interfaces.action import Roll, Roll_SendGoal_Request
from my_interfaces.msg._sphere import Sphere as PrivateSphere
from rosidl_runtime_py.utilities import get_message
from turtlewire import msg

assert PrivateSphere is Sphere and Roll_SendGoal_Request is Roll.Impl.SendGoalService.Request
assert get_message("my_interfaces/msg/Sphere") is Sphere is type(Roll.Result().where)
print(Sphere(), AddSphere.Request(), Roll.Goal(distance=2.0), Everything.LIMIT, Everything.NAME)
message = Everything(wide="äö", few=[Sphere()], blob=b"ab", short="abcde")
again = msg.deserialize(Everything, msg.serialize(message))
assert msg.serialize(again) == msg.serialize(message)
print(again.three.tolist(), again.numbers.tolist(), again.words, again.raw,
      again.pair[1].radius, again.blob)
print(msg.interfaces()["my_interfaces"])
"""
    environment = {**os.environ, "PYTHONPATH": str(generated)}
    done = run_python(program, check=False, env=environment)
    assert done.stderr == ""
    assert done.stdout.splitlines() == [
        (
            "my_interfaces.msg.Sphere(center=geometry_msgs.msg.Point(x=0.0, y=0.0, z=0.0), "
            "radius=1.5) "
            "my_interfaces.srv.AddSphere_Request(sphere=my_interfaces.msg.Sphere("
            "center=geometry_msgs.msg.Point(x=0.0, y=0.0, z=0.0), radius=1.5)) "
            "my_interfaces.action.Roll_Goal(distance=2.0) 12 every # thing"
        ),
        r"[1, 2, 3] [1.0, 2.0] ['a', 'b'] b'\x07' 1.5 [b'a', b'b']",
        "{'msg': ['Everything', 'Sphere'], 'srv': ['AddSphere'], 'action': ['Roll']}",
    ]


def test_a_type_is_found_by_name_before_its_package_was_imported(generated):
    program = (
        "from turtlewire import msg; print(msg.get_message('my_interfaces/msg/Sphere')().radius)"
    )
    environment = {**os.environ, "PYTHONPATH": str(generated)}
    done = run_python(program, env=environment)
    assert done.stdout == "1.5\n"


@pytest.mark.slow
def test_stubs_satisfy_a_type_checker(generated, tmp_path):
    pytest.importorskip("mypy", reason="needs mypy (scripts/setup lint)")
    program = tmp_path / "user.py"
    program.write_text(
        "from my_interfaces.msg import Everything, Sphere\n"
        "from my_interfaces.srv import AddSphere\n"
        "from my_interfaces.action import Roll\n"
        "everything = Everything(numbers=[1, 2.5], pair=[Sphere(), Sphere(radius=2.0)])\n"
        "everything.numbers = [3.0]\n"
        "first: float = everything.numbers[0]\n"
        "where: Sphere = Roll.Result().where\n"
        "request = AddSphere.Request(sphere=Sphere())\n"
        "request.sphere.center.x = 1.0\n"
        "limit: int = Everything.LIMIT\n"
        "def add(request: AddSphere.Request, response: AddSphere.Response) -> Roll.Goal: return "
        "Roll.Goal()\n"
        "Sphere(radius='big')\n"
        "Sphere().rdius\n"
    )
    environment = {**os.environ, "MYPYPATH": ":".join(map(str, (generated, *IMPORT_PATH)))}
    command = [
        sys.executable,
        "-m",
        "mypy",
        "--cache-dir",
        str(tmp_path / "cache"),
        "--follow-imports=silent",
        str(program),
    ]
    done = subprocess.run(
        command, env=environment, capture_output=True, text=True, check=False, cwd=tmp_path
    )
    errors = [
        line.partition("user.py:")[2]
        for line in done.stdout.splitlines()
        if "error" in line and "user.py" in line
    ]
    assert errors == [
        (
            '12: error: Argument "radius" to "Sphere" has incompatible type "str"; '
            'expected "float"  [arg-type]'
        ),
        '13: error: "Sphere" has no attribute "rdius"; maybe "radius"?  [attr-defined]',
    ]


def test_the_folder_names_a_package_without_package_xml(source, tmp_path, monkeypatch):
    (source / "package.xml").unlink()
    folder = generate_package(source, tmp_path / "here")
    assert folder.name == "some_folder"
    monkeypatch.syspath_prepend(str(tmp_path / "here"))
    assert importlib.import_module("some_folder.msg").Sphere().radius == 1.5
    assert generate_package(source, tmp_path / "here", "other_name").name == "other_name"


def test_mistakes_end_the_command_with_a_line(source, tmp_path):
    (source / "msg" / "Sphere.msg").write_text("floot64 radius\n")
    done = run_command(source, tmp_path / "out")
    assert done.returncode == 1
    assert (
        done.stderr
        == "my_interfaces/msg/Sphere, line 1: 'floot64' is not a type in 'floot64 radius'\n"
    )


def test_the_package_is_not_written_into_its_own_sources(source):
    before = sorted(source.rglob("*"))
    with pytest.raises(InterfaceError, match="holds the interfaces themselves") as caught:
        generate_package(source, source.parent, source.name)
    assert "--output" in caught.value.hint
    assert sorted(source.rglob("*")) == before


def test_an_output_that_cannot_be_written_ends_the_command_with_a_line(source, tmp_path):
    (tmp_path / "file").touch()
    done = run_command(source, tmp_path / "file")
    assert done.returncode == 1
    assert "Not a directory" in done.stderr
    assert "Traceback" not in done.stderr


def test_a_folder_without_interfaces_is_an_error(tmp_path):
    with pytest.raises(InterfaceError, match=r"no \.msg, \.srv or \.action files"):
        generate_package(tmp_path, tmp_path / "out")


def test_a_broken_manifest_is_refused_with_its_line(tmp_path):
    manifest = tmp_path / "package.xml"
    manifest.write_text("<package>\n<name>p</name><br>\n</package>\n")
    with pytest.raises(InterfaceError) as refused:
        generate_package(tmp_path, tmp_path / "out")
    assert str(refused.value) == f"{manifest}: mismatched tag: line 3, column 2"


def test_an_idl_file_is_generated_unless_it_was_made_of_another(tmp_path):
    source = tmp_path / "shapes"
    (source / "msg").mkdir(parents=True)
    (source / "msg" / "Disc.idl").write_text(
        "module shapes { module msg { struct Disc { @default (value=2.0) double radius; }; }; };"
    )
    (source / "msg" / "Ring.msg").write_text("float64 radius 1.0\n")
    (source / "msg" / "Ring.idl").write_text("what ROS 2 made of Ring.msg")
    folder = generate_package(source, tmp_path / "out", "shapes")
    assert (folder / "msg" / "Disc.msg").read_text() == "float64 radius 2.0\n"
    assert sorted(path.name for path in (folder / "msg").iterdir()) == [
        "Disc.msg", "Ring.msg", "__init__.py", "__init__.pyi",
    ]  # fmt: skip
    (source / "msg" / "Disc.idl").unlink()
    generate_package(source, tmp_path / "out", "shapes")
    assert not (folder / "msg" / "Disc.msg").exists()


def test_the_examples_of_the_page_do_what_it_says(tmp_path, monkeypatch):
    for name, text in OF_PAGE.items():
        path = tmp_path / "my_interfaces" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        for line in text.splitlines() if name != "package.xml" else ():
            assert line in PAGE.read_text()
    (command,) = re.findall(r"```sh\n(.*)\n```", PAGE.read_text())
    assert command.startswith("python ")
    subprocess.run(
        [sys.executable, *command.split()[1:]], cwd=tmp_path, check=True, capture_output=True
    )
    monkeypatch.syspath_prepend(str(tmp_path / "generated"))
    failed, tried = doctest.testfile(str(PAGE), module_relative=False, optionflags=doctest.ELLIPSIS)
    assert failed == 0
    assert tried == 22


def test_the_page_names_every_package():
    page = PAGE.read_text()
    for package in registry.interfaces():
        assert f"`{package}`" in page or package == "my_interfaces"
