"""Finding packages and their executables."""

import json
import os
import stat
import subprocess
import sys
from pathlib import Path

import pytest

from turtlewire_ros import prefix
from turtlewire_ros.executables import argv_for, executable_paths, is_python_script


@pytest.fixture
def workspace(tmp_path, monkeypatch):
    """An install folder with two packages, as colcon makes it."""
    for package in ("a", "b"):
        root = tmp_path / package
        index = root / prefix.MARKERS
        index.mkdir(parents=True)
        (index / package).touch()
        (root / "lib" / package).mkdir(parents=True)
        (root / "share" / package).mkdir()
    monkeypatch.setenv(
        "AMENT_PREFIX_PATH",
        os.pathsep.join([str(tmp_path / "a"), str(tmp_path / "nowhere"), str(tmp_path / "b")]),
    )
    return tmp_path


def test_prefixes_that_exist_in_their_order_and_the_own_one_last(workspace):
    found = prefix.prefixes()
    assert found[:2] == [str(workspace / "a"), str(workspace / "b")]
    assert found[2:] == [path for path in [prefix.own_prefix()] if path is not None]


def test_packages_of_prefixes(workspace):
    assert prefix.package_prefix("b") == str(workspace / "b")
    assert prefix.share_directory("a") == str(workspace / "a" / "share" / "a")
    assert prefix.package_prefix("nope_pkg_x") is None
    assert prefix.share_directory("nope_pkg_x") is None
    assert (
        prefix.package_names().items()
        >= {"a": str(workspace / "a"), "b": str(workspace / "b")}.items()
    )


def test_the_first_of_equal_packages_counts(workspace):
    (workspace / "b" / prefix.MARKERS / "a").touch()
    assert prefix.package_prefix("a") == str(workspace / "a")
    assert prefix.package_names()["a"] == str(workspace / "a")


def test_executables_are_files_that_can_be_run(workspace):
    library = workspace / "a" / "lib" / "a"
    for name, text, mode in (
        ("node", "#!/bin/sh\n", 0o755),
        ("script", "#!/usr/bin/python3\n", 0o644),
        ("data.txt", "x", 0o644),
    ):
        (library / name).write_text(text)
        (library / name).chmod(mode)
    (library / "nested").mkdir()
    (library / "nested" / "deep").write_text("#!/bin/sh\n")
    (library / "nested" / "deep").chmod(0o755)
    assert executable_paths("a") == [
        str(library / "nested/deep"),
        str(library / "node"),
        str(library / "script"),
    ]
    assert executable_paths("b") == []
    assert executable_paths("nope_pkg_x") is None


def test_python_scripts_are_run_by_this_interpreter(tmp_path):
    script, binary = tmp_path / "script", tmp_path / "binary"
    script.write_text("#!/opt/other/bin/python3.12\n")
    binary.write_bytes(b"\x7fELF python")
    assert argv_for(str(script)) == [sys.executable, str(script)]
    assert argv_for(str(binary)) == [str(binary)]
    assert not is_python_script(str(tmp_path / "missing"))


def make_distribution(folder, *, direct_url=None, files=()):
    """Create the files that pip installs for a package named ``pip_pkg``."""
    info = folder / "pip_pkg-1.0.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: pip_pkg\nVersion: 1.0\n")
    (info / "RECORD").write_text("".join(f"{name},,\n" for name in files))
    if direct_url is not None:
        (info / "direct_url.json").write_text(json.dumps(direct_url))


def test_an_editable_package_has_its_data_in_its_source(tmp_path, monkeypatch):
    source = tmp_path / "my src"
    source.mkdir()
    (source / "package.xml").touch()
    make_distribution(
        tmp_path / "site", direct_url={"url": source.as_uri(), "dir_info": {"editable": True}}
    )
    monkeypatch.syspath_prepend(str(tmp_path / "site"))
    assert prefix.package_prefix("pip_pkg") == str(source)
    assert prefix.share_directory("pip_pkg") == str(source)


@pytest.mark.parametrize(
    "direct_url",
    [
        None,
        {"url": "https://example.com/x"},
        {"url": "file:///nowhere", "dir_info": {"editable": True}},
        {"url": "file:///", "dir_info": {}},
    ],
)
def test_other_distributions_are_no_packages(tmp_path, monkeypatch, direct_url):
    make_distribution(tmp_path, direct_url=direct_url)
    monkeypatch.syspath_prepend(str(tmp_path))
    assert prefix.package_prefix("pip_pkg") is None


def test_console_scripts_of_a_package_that_pip_installed(tmp_path, monkeypatch):
    site = tmp_path / "lib" / "site-packages"
    make_distribution(site, files=["../../bin/node", "pip_pkg/__init__.py"])
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin" / "node").touch()
    (tmp_path / prefix.MARKERS).mkdir(parents=True)
    (tmp_path / prefix.MARKERS / "pip_pkg").touch()
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    monkeypatch.syspath_prepend(str(site))
    assert executable_paths("pip_pkg") == [str(tmp_path / "bin" / "node")]


def test_catkin_pkg_reads_our_manifests():
    """The library of Debian's python3-catkin-pkg, with which colcon and rosdep also read them."""
    catkin_pkg = pytest.importorskip(
        "catkin_pkg.package", reason="needs colcon (scripts/setup workspace)"
    )
    own = prefix.own_prefix()
    if own is None:
        pytest.skip("needs the installed distribution")
    for name in ("rclpy", "tf2_ros", "geometry_msgs", "turtlesim"):
        package = catkin_pkg.parse_package(os.path.join(own, "share", name))
        assert (package.name, package.get_build_type()) == (name, "ament_python")


def test_the_own_prefix_has_this_package():
    own = prefix.own_prefix()
    if own is None:
        pytest.skip("the distribution is not installed here; scripts/setup does it")
    assert (Path(own) / prefix.MARKERS / "turtlewire_ros").is_file()
    node = Path(own) / "lib" / "turtlesim" / "turtlesim_node"
    assert node.stat().st_mode & stat.S_IXUSR


# Generating the Python modules of interfaces in a build: silently, or with the faulty line.


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("std_msgs/Header[<=2] a\nuint8 K=1 # nope_msgs/X\n", (0, "")),
        ("nope_msgs/X x\n", (1, "some_msgs/msg/A, line 1: there is no nope_msgs/msg/X in ")),
        ("std_msgs/Nope[2] x\n", (1, "some_msgs/msg/A, line 1: there is no std_msgs/msg/Nope in ")),
    ],
)
def test_all_types_of_an_interface_must_be_there(tmp_path, text, expected):
    (tmp_path / "defined/msg").mkdir(parents=True)
    (tmp_path / "defined/msg/A.msg").write_text(text)
    command = [sys.executable, "-m", "turtlewire_ros.generate_interfaces", "defined"]
    done = subprocess.run(
        [*command, "--output", "made", "--package", "some_msgs"],
        cwd=tmp_path, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert (done.returncode, done.stdout) == (expected[0], "")
    assert done.stderr.startswith(expected[1])
    assert bool(done.stderr) == bool(expected[0])
