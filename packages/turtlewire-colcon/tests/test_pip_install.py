"""``python -m turtlewire_colcon.pip_install``: wheels of packages that need each other."""

import subprocess
import sys

import pytest

from turtlewire_colcon.wheel import WheelError, build_package_wheels

MANIFEST = """<package format="3">
  <name>{name}</name>
  <version>1.0.0</version>
  <description>{name}</description>
  <buildtool_depend>ament_cmake</buildtool_depend>
  {depends}
  <export><build_type>ament_cmake</build_type></export>
</package>
"""
INTERFACES = """project({name})
find_package(ament_cmake REQUIRED)
find_package(rosidl_default_generators REQUIRED)
{find}
rosidl_generate_interfaces(${{PROJECT_NAME}} msg/{message}.msg)
ament_package()
"""


def make_package(folder, name, depends=(), message="Leaf", text="float64 size\n"):
    package = folder / name
    (package / "msg").mkdir(parents=True)
    (package / f"msg/{message}.msg").write_text(text)
    lines = "".join(f"<depend>{other}</depend>" for other in depends)
    (package / "package.xml").write_text(MANIFEST.format(name=name, depends=lines))
    find = "\n".join(f"find_package({other} REQUIRED)" for other in depends)
    cmake = INTERFACES.format(name=name, find=find, message=message)
    (package / "CMakeLists.txt").write_text(cmake)
    return package


def pip_install(*words):
    return subprocess.run(
        [sys.executable, "-m", "turtlewire_colcon.pip_install", *map(str, words)],
        capture_output=True,
        text=True,
        check=False,
        timeout=300,
    )


@pytest.fixture
def tree(tmp_path):
    """Two packages, the second of which uses a message of the first."""
    make_package(tmp_path, "leaf_msgs")
    make_package(tmp_path, "branch_msgs", ["leaf_msgs"], "Branch", "leaf_msgs/Leaf[] leaves\n")
    return tmp_path


def test_packages_are_built_after_those_that_they_need(tree):
    done = pip_install("--output", tree / "wheels", tree / "branch_msgs", tree / "leaf_msgs")
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines() == [
        f"{tree}/wheels/leaf_msgs-1.0.0-py3-none-any.whl",
        f"{tree}/wheels/branch_msgs-1.0.0-py3-none-any.whl",
    ]


def test_nothing_is_installed_when_one_cannot_be_built(tree):
    (tree / "branch_msgs/msg/Branch.msg").write_text("leaf_msgs/Twig[] twigs\n")
    done = pip_install(tree / "branch_msgs", tree / "leaf_msgs")
    assert done.returncode == 1
    assert done.stdout == "", "pip has been asked to install something"
    (line,) = done.stderr.splitlines()
    assert "line 1: there is no leaf_msgs/msg/Twig" in line


def test_packages_of_pip_itself_are_handed_to_it(tree):
    package = tree / "plain"
    package.mkdir()
    (package / "pyproject.toml").write_text("[build-system]\n")
    done = pip_install("--output", tree / "wheels", package, tree / "leaf_msgs")
    assert done.stdout.startswith(f"{tree}/wheels/leaf_msgs-1.0.0-py3-none-any.whl")
    assert done.returncode != 0
    assert package.as_uri() in done.stderr, "pip has not read it"


def test_packages_that_cannot_be_ordered(tmp_path):
    one = make_package(tmp_path, "one_msgs", ["two_msgs"])
    two = make_package(tmp_path, "two_msgs", ["one_msgs"])
    for sources, text in (
        (
            [one, two],
            "packages depend on each other in a cycle: one_msgs needs two_msgs needs one_msgs",
        ),
        ([one, one], f"{one} and {one} are both called one_msgs"),
        ([tmp_path / "none"], f"there is no folder {tmp_path}/none"),
        ([tmp_path], f"there is no {tmp_path}/package.xml"),
    ):
        with pytest.raises(WheelError) as caught:
            build_package_wheels(sources, tmp_path / "wheels", lambda _: None)
        assert str(caught.value) == text
