"""`ros2 pkg create`: packages that can be built and installed."""

import ast
import zipfile

import pytest
from defusedxml import ElementTree

from ros2cli.main import main
from turtlewire_colcon.wheel import build_package_wheels


def create(*words):
    return main(["pkg", "create", *words])


def test_a_package_with_a_node(tmp_path, capsys):
    assert (
        create(
            "--build-type",
            "ament_python",
            "--node-name",
            "talk",
            "p",
            "--destination-directory",
            str(tmp_path),
        )
        == 0
    )
    assert capsys.readouterr().out.startswith("going to create a new package\npackage name: p\n")
    made = sorted(
        path.relative_to(tmp_path / "p").as_posix()
        for path in (tmp_path / "p").rglob("*")
        if path.is_file()
    )
    assert made == [
        "p/__init__.py",
        "p/talk.py",
        "package.xml",
        "resource/p",
        "setup.cfg",
        "setup.py",
        "test/test_import.py",
    ]
    assert "'talk = p.talk:main'" in (tmp_path / "p/setup.py").read_text()
    namespace = {}
    exec((tmp_path / "p/p/talk.py").read_text(), namespace)
    namespace["main"]()
    assert capsys.readouterr().out == "Hi from p.\n"


def test_texts_are_escaped(tmp_path):
    words = [
        "--description",
        "a <b> & 'c' \"d\"",
        "--license",
        "Apache-2.0",
        "--maintainer-name",
        'O"Neill',
        "--maintainer-email",
        'x"@y',
    ]
    assert (
        create(
            "p",
            *words,
            "--dependencies",
            "rclpy",
            "tf2_ros",
            "--destination-directory",
            str(tmp_path),
        )
        == 0
    )
    root = ElementTree.parse(tmp_path / "p/package.xml").getroot()
    assert root.findtext("description") == "a <b> & 'c' \"d\""
    assert root.find("maintainer").attrib == {"email": 'x"@y'}
    assert [element.text for element in root.findall("depend")] == ["rclpy", "tf2_ros"]
    ast.parse((tmp_path / "p/setup.py").read_text())


@pytest.mark.parametrize("name", ["Big", "1a", "a__b", "a-b", "", "../x"])
def test_names_that_packages_cannot_have(tmp_path, capsys, name):
    assert create(name, "--destination-directory", str(tmp_path)) == 1
    assert "Invalid package name" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_nothing_is_overwritten(tmp_path, capsys):
    (tmp_path / "p").mkdir()
    assert create("p", "--destination-directory", str(tmp_path)) == 1
    assert "The directory already exists" in capsys.readouterr().err


def test_node_names_that_cannot_be(tmp_path, capsys):
    for node in ("p", "1x", "a-b"):
        assert create("p", "--node-name", node, "--destination-directory", str(tmp_path)) == 1
        assert "node name" in capsys.readouterr().err.lower()
    assert list(tmp_path.iterdir()) == []


def test_a_package_of_interfaces_is_built_when_its_lines_are_uncommented(tmp_path, capsys):
    words = ["--build-type", "ament_cmake", "tutorial_interfaces"]
    words += ["--destination-directory", str(tmp_path), "--dependencies", "geometry_msgs"]
    assert create(*words) == 0
    assert "build type: ament_cmake\ndependencies: ['geometry_msgs']\n" in capsys.readouterr().out
    folder = tmp_path / "tutorial_interfaces"
    (folder / "msg").mkdir()
    (folder / "msg/Name.msg").write_text("geometry_msgs/Point center\n")
    cmake = folder / "CMakeLists.txt"
    lines = cmake.read_text().splitlines(keepends=True)
    first = next(index for index, line in enumerate(lines) if "default_generators REQ" in line)
    lines[first:] = [line.removeprefix("# ") for line in lines[first:]]
    cmake.write_text("".join(lines).replace("install(DIRECTORY", "# install(DIRECTORY"))
    (wheel,) = build_package_wheels([folder], tmp_path / "wheels", lambda _: None)
    assert "tutorial_interfaces/msg/Name.msg" in {
        name.partition("share/")[2] for name in zipfile.ZipFile(wheel).namelist()
    }


def test_an_empty_package_of_cmake_is_built(tmp_path):
    words = ["--build-type", "ament_cmake", "p", "--destination-directory", str(tmp_path)]
    assert create(*words, "--dependencies", "rclpy", "std_msgs") == 0
    assert build_package_wheels([tmp_path / "p"], tmp_path / "wheels", lambda _: None)


def test_a_node_of_cpp_is_refused(tmp_path, capsys):
    words = ["--build-type", "ament_cmake", "p", "--destination-directory", str(tmp_path)]
    assert create(*words, "--node-name", "talk") == 1
    assert capsys.readouterr().err.endswith("use --build-type ament_python\n")
    assert [*tmp_path.iterdir()] == []
