"""Which ``libddsc`` is taken, and that the one of the system does what the wheel's does."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from tests.places import ROOT

from tests import programs
from turtlewire.wire import libddsc
from turtlewire.wire.libddsc import find_libddsc

TESTS = Path(__file__).parents[1]
#: What must hold over every library.
SUITE = [
    "wire/test_contract.py",
    "wire/test_bad_input.py",
    "wire/test_cyclone_events.py",
    "wire/test_cyclone_log.py",
    "wire/test_golden_endpoints.py",
    "wire/test_graph.py",
    "wire/test_ports.py",
    "wire/test_processes.py",
    "wire/test_services.py",
    "wire/test_taking.py",
    "wire/test_two_hosts.py",
    "tf/test_intake.py",
    "tf/test_listener.py",
    "tf/test_listener_lifetime.py",
]

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the names are those of Linux")


@pytest.fixture(autouse=True)
def system(monkeypatch, tmp_path):
    """The prefix of a system that has nothing."""
    monkeypatch.delenv("CYCLONEDDS_HOME", raising=False)
    monkeypatch.delenv("AMENT_PREFIX_PATH", raising=False)
    monkeypatch.setattr(libddsc, "_SYSTEM", (str(tmp_path / "system"),))
    return tmp_path / "system"


def install(prefix: Path, version: str, folder: str = "lib") -> Path:
    """A library, with the links that packages have beside it."""
    path = prefix / folder / f"libddsc.so.{version}"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.touch()
    (path.parent / "libddsc.so.0debian").symlink_to(path.name)
    (path.parent / "libddsc.so").symlink_to("libddsc.so.0debian")
    return path


def without_wheel(monkeypatch):
    monkeypatch.setattr(libddsc, "find_spec", lambda name: None)


def test_the_wheel_comes_first(system, monkeypatch):
    install(system, "0.10.2")
    without = find_libddsc().library
    if without is None or without.origin != "the cyclonedds wheel":
        pytest.skip("no cyclonedds wheel is installed")
    assert without.version == "11.0.1"
    assert find_libddsc().refused == []
    without_wheel(monkeypatch)
    found = find_libddsc().library
    assert found is not None
    assert (found.origin, found.version) == ("the system", "0.10.2")
    assert found.reason == "there is no cyclonedds wheel"


def test_a_sourced_ros_comes_before_the_system(system, monkeypatch, tmp_path):
    without_wheel(monkeypatch)
    install(system, "0.10.2")
    multiarch = getattr(sys.implementation, "_multiarch", "x86_64-linux-gnu")
    path = install(tmp_path / "ros", "0.10.5", f"lib/{multiarch}")
    monkeypatch.setenv("AMENT_PREFIX_PATH", f"/nowhere:{tmp_path / 'ros'}")
    found = find_libddsc().library
    assert found is not None
    assert (found.path, found.version) == (str(path), "0.10.5")
    assert found.abi is not None
    assert not found.abi.tells_type


def test_cyclonedds_home_comes_before_the_wheel(monkeypatch, tmp_path):
    path = install(tmp_path / "home", "0.10.4")
    monkeypatch.setenv("CYCLONEDDS_HOME", str(tmp_path / "home"))
    found, refused = find_libddsc()
    assert found is not None
    assert found.path == str(path)
    assert refused == []


def test_cyclonedds_home_without_a_library_is_reported(monkeypatch, tmp_path):
    monkeypatch.setenv("CYCLONEDDS_HOME", str(tmp_path))
    [sentence] = find_libddsc().refused
    assert sentence == f"CYCLONEDDS_HOME is {tmp_path}, where there is no libddsc"


@pytest.mark.parametrize("version", ["0.8.1", "0.9.1", "11.2.0", "0debian"])
def test_an_unknown_version_is_told_and_not_taken(system, monkeypatch, version):
    without_wheel(monkeypatch)
    path = system / "lib" / f"libddsc.so.{version}"
    path.parent.mkdir(parents=True)
    path.touch()
    found, [sentence] = find_libddsc()
    assert found is None
    assert str(path) in sentence
    assert sentence.endswith("is not used: only 11.0 and 0.10 are supported")


def run_python(code: str, **environment: str) -> subprocess.CompletedProcess[str]:
    return programs.run_python(code, check=False, timeout=60, env=os.environ | environment)


def test_zenoh_is_taken_instead_of_an_unknown_version(tmp_path):
    pytest.importorskip("zenoh")
    install(tmp_path, "0.8.1")
    code = (
        "from turtlewire.wire import libddsc, open_context\n"
        f"libddsc._SYSTEM = ({str(tmp_path)!r},)\n"
        "libddsc.find_spec = lambda name: None\n"
        "context = open_context(5)\n"
        "print(type(context).__name__)\n"
        "context.close()\n"
    )
    done = run_python(code)
    assert (done.returncode, done.stdout) == (0, "ZenohContext\n")
    [line] = done.stderr.splitlines()
    assert "Cyclone DDS 0.8.1 of the system" in line
    assert line.endswith("Zenoh is used, which reaches robots that run rmw_zenoh_cpp")


def test_a_file_that_is_no_library_is_one_error_that_names_it(tmp_path):
    path = install(tmp_path, "0.10.2")
    code = "from turtlewire.wire import open_context\nopen_context(5)\n"
    done = run_python(code, CYCLONEDDS_HOME=str(tmp_path), RMW_IMPLEMENTATION="rmw_cyclonedds_cpp")
    assert done.returncode == 1
    assert f"({path}) cannot be loaded" in done.stderr


def of_system() -> str:
    """The prefix of a 0.10 of the system, to which ``CYCLONEDDS_HOME`` may point."""
    for prefix in ("/usr", "/usr/local"):
        found = list(libddsc._below(prefix, "the system"))
        if found and found[0].abi == libddsc.ABIS[1]:
            return prefix
    pytest.skip("no libddsc 0.10 (Debian 12: apt install libddsc0debian)")


def test_a_library_of_the_system_carries_messages():
    code = (
        "from turtlewire.wire import open_context\n"
        "from turtlewire.wire.base import TypeId\n"
        "from turtlewire.wire.cyclone.library import LIBRARY\n"
        "from turtlewire.wire.qos import QoS\n"
        "node = open_context().create_node('node')\n"
        "text = TypeId('std_msgs/msg/String', 'RIHS01_' + '0' * 64)\n"
        "subscription = node.create_subscription('/chatter', text, QoS())\n"
        "publisher = node.create_publisher('/chatter', text, QoS())\n"
        "assert node.context.graph.wait_for(lambda: publisher.subscription_count(), 60 * 10**9)\n"
        "publisher.publish(bytes([0, 1, 0, 0, 3, 0, 0, 0]) + b'abc' + bytes(1))\n"
        "print(LIBRARY.version, subscription.take()[0][0][8:11])\n"
    )
    done = run_python(code, CYCLONEDDS_HOME=of_system(), RMW_IMPLEMENTATION="rmw_cyclonedds_cpp")
    assert done.stdout.startswith("0.10."), done.stderr
    assert done.stdout.endswith("b'abc'\n")


@pytest.mark.slow
def test_the_suite_holds_over_the_library_of_the_system():
    done = subprocess.run(
        [
            *(sys.executable, "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider"),
            *(str(TESTS / name) for name in SUITE),
        ],
        capture_output=True,
        text=True,
        timeout=900,
        check=False,
        env=os.environ | {"CYCLONEDDS_HOME": of_system()},
        cwd=ROOT,
    )
    assert done.returncode == 0, done.stdout[-5000:]
