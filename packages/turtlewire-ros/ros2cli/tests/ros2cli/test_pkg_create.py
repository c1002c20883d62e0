"""`ros2 pkg create`, and its steps as functions: packages that can be built and installed."""

import ast
import shutil
import subprocess
import zipfile
from types import SimpleNamespace

import pytest
from defusedxml import ElementTree
from tests.needs import only_first_is_fast

from ros2cli.main import main
from ros2pkg.api.create import (
    create_package_environment,
    populate_ament_cargo,
    populate_ament_cmake,
    populate_ament_python,
    populate_cmake,
    populate_cpp_library,
    populate_cpp_node,
    populate_python_libary,
    populate_python_node,
    populate_rust_node,
)
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


HAS_CMAKE = shutil.which("cmake") is not None and shutil.which("c++") is not None
needs_cmake = pytest.mark.skipif(not HAS_CMAKE, reason="builds with CMake and a compiler")
needs_cargo = pytest.mark.skipif(shutil.which("cargo") is None, reason="builds with Cargo")

#: What the packages of a real ROS 2 define for `find_package(ament_cmake)`.
AMENT_CMAKE = """
macro(ament_export_targets)
endmacro()
macro(ament_export_dependencies)
endmacro()
macro(ament_package)
endmacro()
"""

#: A dependency, as `find_package` finds it: without its target, `USES_IT` is not defined.
DEPENDENCY = """
add_library(rclcpp::rclcpp INTERFACE IMPORTED)
target_compile_definitions(rclcpp::rclcpp INTERFACE USES_IT)
set(rclcpp_TARGETS rclcpp::rclcpp)
"""


def package(build_type, **changes):
    """The attributes of catkin_pkg's class."""
    attributes = {
        "name": "p",
        "version": "0.0.0",
        "package_format": 3,
        "description": 'All "of" <it>',
        "maintainers": [SimpleNamespace(name="Ada", email="ada@example.org")],
        "licenses": ["Apache-2.0"],
        "buildtool_depends": [],
        "build_depends": [],
        "test_depends": [],
        "get_build_type": lambda: build_type,
    }
    return SimpleNamespace(**attributes | changes)


def run(*words, **options):
    done = subprocess.run(
        words, capture_output=True, text=True, timeout=240, check=False, **options
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.mark.parametrize(
    ("build_type", "sources", "headers"),
    [
        ("ament_python", "p", None),
        ("ament_cmake", "src", "include/p"),
        ("cmake", "src", "include/p"),
        ("ament_cargo", "src", None),
        ("other", None, None),
    ],
)
def test_folders(tmp_path, capsys, build_type, sources, headers):
    made = package(
        build_type,
        buildtool_depends=["ament_cmake"],
        build_depends=[SimpleNamespace(name="rclcpp"), "std_msgs"],
        test_depends=["ament_lint"],
    )
    folder, *others = create_package_environment(made, str(tmp_path))
    assert folder == str(tmp_path / "p")
    expected = [None if each is None else str(tmp_path / "p" / each) for each in (sources, headers)]
    assert others == expected
    for each in filter(None, (sources, headers)):
        assert (tmp_path / "p" / each).is_dir()
    assert f"creating {tmp_path / 'p' / 'package.xml'}" in capsys.readouterr().out
    root = ElementTree.parse(tmp_path / "p" / "package.xml").getroot()
    found = [(tag.tag, tag.text) for tag in root if tag.tag.endswith("depend")]
    assert found == [
        ("buildtool_depend", "ament_cmake"),
        ("depend", "rclcpp"),
        ("depend", "std_msgs"),
        ("test_depend", "ament_lint"),
    ]
    assert root.findtext("description") == 'All "of" <it>'
    assert root.findtext("export/build_type") == build_type


def test_a_package_of_python(tmp_path, capsys):
    made = package("ament_python")
    folder, sources, _ = create_package_environment(made, str(tmp_path))
    populate_ament_python(made, folder, sources, "talk")
    populate_python_node(made, sources, "talk")
    populate_python_libary(made, sources, "tools")
    files = {path.relative_to(folder).as_posix() for path in (tmp_path / "p").rglob("*.py")}
    assert files == {
        "p/__init__.py",
        "p/talk.py",
        "p/tools/__init__.py",
        "setup.py",
        "test/test_import.py",
    }
    assert "'talk = p.talk:main'" in (tmp_path / "p/setup.py").read_text()
    capsys.readouterr()
    namespace = {}
    exec((tmp_path / "p/p/talk.py").read_text(), namespace)
    namespace["main"]()
    assert capsys.readouterr().out == "Hi from p.\n"


def cpp_package(tmp_path, build_type, populate, node, library):
    made = package(build_type)
    folder, sources, headers = create_package_environment(made, str(tmp_path))
    populate(made, folder, node, library)
    if node:
        populate_cpp_node(made, sources, node)
    if library:
        populate_cpp_library(made, sources, headers, library)
    return folder


@needs_cmake
@pytest.mark.parametrize(
    ("build_type", "populate"), [("cmake", populate_cmake), ("ament_cmake", populate_ament_cmake)]
)
@pytest.mark.parametrize("library", only_first_is_fast("my_tools", None))
def test_a_package_of_cpp_is_built_and_installed(tmp_path, build_type, populate, library):
    folder = cpp_package(tmp_path, build_type, populate, "talk", library)
    stub = tmp_path / "prefix" / "ament_cmakeConfig.cmake"
    stub.parent.mkdir()
    stub.write_text(AMENT_CMAKE)
    build, target = str(tmp_path / "build"), tmp_path / "installed"
    known = (f"-DCMAKE_INSTALL_PREFIX={target}", f"-DCMAKE_PREFIX_PATH={stub.parent}")
    run("cmake", "-S", folder, "-B", build, *known)
    run("cmake", "--build", build, "--target", "install")
    assert run(str(target / "lib/p/talk")) == "Hi from p.\n"
    if library:
        assert (target / "include/p/p/my_tools.hpp").is_file()
        header = (target / "include/p/p/my_tools.hpp").read_text()
        assert "class MyTools" in header
        # A config for other packages comes from ament, or from CMake itself.
        config = target / "share/p/cmake/pConfig.cmake"
        assert config.is_file() == (build_type == "cmake")


@needs_cmake
def test_dependency_of_cpp_is_linked(tmp_path):
    made = package("ament_cmake", build_depends=["rclcpp", "std_msgs"])
    folder, sources, headers = create_package_environment(made, str(tmp_path))
    populate_ament_cmake(made, folder, "talk", "tools")
    populate_cpp_node(made, sources, "talk")
    populate_cpp_library(made, sources, headers, "tools")
    for name in ("talk", "tools"):
        with open(f"{sources}/{name}.cpp", "a", encoding="utf-8") as source:
            source.write('#ifndef USES_IT\n#error "is not linked"\n#endif\n')
    prefix = tmp_path / "prefix"
    prefix.mkdir()
    configs = {"ament_cmake": AMENT_CMAKE, "rclcpp": DEPENDENCY, "std_msgs": ""}
    for name, text in configs.items():
        (prefix / f"{name}Config.cmake").write_text(text)
    build = str(tmp_path / "build")
    run("cmake", "-S", folder, "-B", build, f"-DCMAKE_PREFIX_PATH={prefix}")
    run("cmake", "--build", build)
    lists = (tmp_path / "p/CMakeLists.txt").read_text()
    assert "ament_export_dependencies(rclcpp std_msgs)" in lists


def test_description_in_cargo_toml_is_kept(tmp_path):
    tomllib = pytest.importorskip("tomllib", reason="comes with Python 3.11")
    description = 'Says "hé" to \U0001f422 \x7f in C:\\new'
    made = package("ament_cargo", description=description)
    folder, _, _ = create_package_environment(made, str(tmp_path))
    populate_ament_cargo(made, folder, None)
    text = (tmp_path / "p/Cargo.toml").read_text(encoding="utf-8")
    assert tomllib.loads(text)["package"]["description"] == description


@needs_cargo
@pytest.mark.parametrize("library", [None, "tools"])
def test_a_package_of_rust_is_built(tmp_path, library):
    made = package("ament_cargo")
    folder, sources, _ = create_package_environment(made, str(tmp_path))
    populate_ament_cargo(made, folder, library)
    populate_rust_node(made, sources, "talk")
    said = run("cargo", "run", "--offline", "--quiet", "--bin", "talk", cwd=folder)
    assert said == "Hi from p.\n"
    assert (tmp_path / "p/src/lib.rs").exists() == (library is not None)


def test_dependencies_of_cmake_are_found(tmp_path):
    made = package("ament_cmake", build_depends=["ament_cmake", "rclcpp"])
    folder, _, _ = create_package_environment(made, str(tmp_path))
    populate_ament_cmake(made, folder, None, None)
    lines = (tmp_path / "p/CMakeLists.txt").read_text().splitlines()
    found = [line for line in lines if line.startswith("find_package")]
    assert found == ["find_package(ament_cmake REQUIRED)", "find_package(rclcpp REQUIRED)"]
    assert lines[-1] == "ament_package()"
