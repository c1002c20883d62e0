"""The files of the wheel for ament, colcon, rosdep and shells."""

import hashlib
import subprocess
import sys
import zipfile

import pytest
import yaml
from defusedxml import ElementTree
from tests.places import ENGINE, ROS

from turtlewire.msg.idl import idl_to_text
from turtlewire.msg.parser import parse_action, parse_message, parse_service

INTERFACES = ENGINE / "src" / "turtlewire" / "msg" / "interfaces"
PARSERS = {"msg": parse_message, "srv": parse_service, "action": parse_action}
KINDS = [*PARSERS]
DATA = "turtlewire_ros-0.1.0.data/data/"


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    folder = tmp_path_factory.mktemp("wheel")
    build = "import sys, hatchling.build as b; b.build_wheel(sys.argv[1])"
    subprocess.run(
        [sys.executable, "-c", build, str(folder)], cwd=ROS, check=True, capture_output=True
    )
    (path,) = folder.glob("*.whl")
    with zipfile.ZipFile(path) as archive:
        yield archive


@pytest.fixture(scope="module")
def packages():
    inits = ROS.glob("*/*/__init__.py")
    return sorted(
        {init.parent.name for init in inits} | {path.stem for path in INTERFACES.glob("*.txt")}
    )


def test_every_package_has_its_marks(wheel, packages):
    names = set(wheel.namelist())
    assert {"rclpy", "launch", "tf2_ros", "turtlesim", "geometry_msgs", "ros2cli"} <= set(packages)
    for package in packages:
        assert f"{DATA}share/ament_index/resource_index/packages/{package}" in names
        assert f"{DATA}share/{package}/COLCON_IGNORE" in names
        root = ElementTree.fromstring(wheel.read(f"{DATA}share/{package}/package.xml"))
        assert (root.findtext("name"), root.findtext("version")) == (package, "0.1.0")
        assert root.findtext("description")
        assert root.findtext("export/build_type") == "ament_python"


def test_type_checkers_read_every_package(wheel, packages):
    names = set(wheel.namelist())
    assert [package for package in packages if f"{package}/py.typed" not in names] == []


def test_nothing_but_packages_lies_beside_them(wheel):
    tops = {name.split("/")[0] for name in wheel.namelist()}
    assert {
        top for top in tops if "." in top and not top.startswith("turtlewire_ros-0.1.0.")
    } == set()


def said_by(definition):
    """Fields and constants of a definition, in order."""
    messages = [definition] if not hasattr(definition, "messages") else definition.messages()
    return [
        (
            message.full_name,
            [(field.name, str(field.type), field.default) for field in message.fields],
            [(each.name, str(each.type), each.value) for each in message.constants],
        )
        for message in messages
    ]


def test_interfaces_are_in_share_as_text_and_as_idl(wheel):
    """The text is the engine's, IDL says the same, and the index names both."""
    definitions = [
        part.partition("\n")
        for path in INTERFACES.glob("*.txt")
        for part in path.read_text(encoding="utf-8").split("=== ")[1:]
    ]
    assert len(definitions) == 411
    index = {}
    for full_name, _, text in definitions:
        package, kind, name = full_name.split("/")
        place = f"{DATA}share/{full_name}"
        assert wheel.read(f"{place}.{kind}").decode() == text
        translated = idl_to_text(full_name, wheel.read(f"{place}.idl").decode())
        meant = [PARSERS[kind](full_name, each) for each in (translated, text)]
        assert said_by(meant[0]) == said_by(meant[1]), place
        index.setdefault(package, []).extend([f"{kind}/{name}.{kind}", f"{kind}/{name}.idl"])
    for package, names in index.items():
        listed = wheel.read(f"{DATA}share/ament_index/resource_index/rosidl_interfaces/{package}")
        assert listed.decode().splitlines() == sorted(names)


@pytest.mark.slow
def test_an_sdist_has_all_that_its_wheel_needs(wheel, tmp_path):
    """Where it is built, the engine's sources are not next to it."""
    build = "import sys, hatchling.build as b; b.build_sdist(sys.argv[1])"
    subprocess.run([sys.executable, "-c", build, str(tmp_path)], cwd=ROS, check=True)
    (archive,) = tmp_path.glob("*.tar.gz")
    # Not with tarfile: its filters are younger than the Python of Debian 12.
    subprocess.run(["tar", "-xf", archive, "-C", tmp_path], check=True)
    build = "import sys, hatchling.build as b; b.build_wheel(sys.argv[1])"
    folder = tmp_path / archive.name.removesuffix(".tar.gz")
    subprocess.run([sys.executable, "-c", build, str(tmp_path)], cwd=folder, check=True)
    (path,) = tmp_path.glob("*.whl")
    with zipfile.ZipFile(path) as built:
        assert {*built.namelist()} == {*wheel.namelist()}


def test_executables_are_scripts_that_can_be_run(wheel):
    info = wheel.getinfo(f"{DATA}lib/turtlesim/turtlesim_node")
    assert info.external_attr >> 16 & 0o111
    script = wheel.read(info).decode()
    assert script.startswith("#!/usr/bin/env python3\n")
    compile(script, "turtlesim_node", "exec")


def test_rosdep_finds_its_cache(wheel):
    cache = f"{DATA}share/turtlewire/ros_home/rosdep/sources.cache/"
    kind, url = wheel.read(f"{cache}index").decode().split()
    assert kind == "yaml"
    rules = yaml.safe_load(wheel.read(cache + hashlib.sha1(url.encode()).hexdigest()))
    packages = {key: rule["*"]["pip"]["packages"] for key, rule in rules.items()}
    for key in ("python3-numpy", "ament_copyright", "ament_cmake_ros", "rclcpp", "eigen"):
        assert packages[key] == [], key
    assert packages["python3-opencv"] == ["opencv-python-headless"]


@pytest.mark.parametrize("name", ["setup.bash", "local_setup.bash", "local_setup.sh"])
def test_shell_files_set_the_environment_once(wheel, tmp_path, name):
    for file in ("setup.bash", "local_setup.bash", "local_setup.sh"):
        (tmp_path / file).write_bytes(wheel.read(DATA + file))
    show = (
        'echo "$AMENT_PREFIX_PATH|$ROS_DISTRO|$ROS_VERSION|$ROS_PYTHON_VERSION|$ROS_HOME|'
        '$ROS_LOG_DIR"'
    )
    shell = "bash" if name.endswith("bash") else "sh"
    script = f"set -eu; . {tmp_path}/{name}; . {tmp_path}/{name}; {show}"
    environment = {
        "HOME": str(tmp_path / "home"),
        "PATH": "/usr/bin:/bin",
        "TURTLEWIRE_PREFIX": str(tmp_path),
    }
    result = subprocess.run(
        [shell, "-c", script], capture_output=True, text=True, check=True, env=environment
    )
    ros_home, logs = f"{tmp_path}/share/turtlewire/ros_home", f"{tmp_path}/home/.ros/log"
    assert result.stdout.strip() == f"{tmp_path}|jazzy|2|3|{ros_home}|{logs}"
    assert result.stderr == ""


def test_a_users_own_rosdep_cache_is_left_alone(wheel, tmp_path):
    (tmp_path / "local_setup.sh").write_bytes(wheel.read(f"{DATA}local_setup.sh"))
    cache = tmp_path / ".ros/rosdep/sources.cache"
    cache.mkdir(parents=True)
    (cache / "index").touch()
    environment = {
        "HOME": str(tmp_path),
        "PATH": "/usr/bin:/bin",
        "TURTLEWIRE_PREFIX": str(tmp_path),
    }
    script = f'. {tmp_path}/local_setup.sh; echo "[${{ROS_HOME:-}}]"'
    result = subprocess.run(
        ["sh", "-c", script], capture_output=True, text=True, check=True, env=environment
    )
    assert result.stdout == "[]\n"
