"""`ros2 doctor`: findings, the report, and versions of packages in an index of releases."""

import os
import re
from contextlib import nullcontext

import pytest

from ros2cli.main import main
from ros2doctor.api.package import (
    PackageCheck,
    PackageReport,
    compare_versions,
    get_distro_package_versions,
    get_local_package_versions,
)
from ros2doctor.api.reporting import Result
from turtlewire import msg
from turtlewire.wire import open_context
from turtlewire.wire.base import ServiceTypes, TypeId
from turtlewire.wire.qos import QoS


@pytest.mark.parametrize("name", ["doctor", "wtf"])
def test_an_empty_domain_of_this_host_is_no_problem(capsys, name):
    assert main([name, "--report-failed"]) == 0
    first, *others = capsys.readouterr().out.splitlines()
    assert first.startswith("All is well: middleware ")
    nobody = f"note: No nodes found in domain {os.environ['ROS_DOMAIN_ID']} on this host."
    assert nobody in others


def test_notes_fail_only_on_request(capsys):
    context = open_context()
    try:
        context.create_node("alone")
        assert main(["doctor"]) == 0
        assert "\nnote: No node publishes transforms." in capsys.readouterr().out
        assert main(["doctor", "--include-warnings"]) == 1
    finally:
        context.close()


def test_the_report_has_facts(capsys, monkeypatch):
    monkeypatch.setenv("RCUTILS_COLORIZED_OUTPUT", "1")
    context = open_context()
    try:
        kind = TypeId("std_msgs/msg/String", msg.type_hash("std_msgs/msg/String"))
        node = context.create_node("talker")
        node.create_publisher("/chatter", kind, QoS())
        name = "turtlesim/action/RotateAbsolute_FeedbackMessage"
        node.create_publisher("/turn/_action/feedback", TypeId(name, msg.type_hash(name)), QoS())
        name = "std_srvs/srv/Empty"
        parts = [
            TypeId(part, msg.type_hash(part)) for part in (f"{name}_Request", f"{name}_Response")
        ]
        node.create_client("/clear", ServiceTypes(name, *parts, msg.type_hash), QoS())
        assert main(["doctor", "--report"]) == 0
    finally:
        context.close()
    lines = capsys.readouterr().out.splitlines()
    assert [line for line in lines if line.startswith("   ")] == [
        "   PLATFORM INFORMATION",
        "   NETWORK CONFIGURATION",
        "   RMW MIDDLEWARE",
        "   ROS 2 INFORMATION",
        "   ROS ENVIRONMENT",
        "   TOPIC LIST",
        "   SERVICE LIST",
        "   ACTION LIST",
        "   QOS COMPATIBILITY LIST",
    ]
    assert f"domain            : {os.environ['ROS_DOMAIN_ID']}" in lines
    assert "rcutils environment variables : RCUTILS_COLORIZED_OUTPUT=1" in lines
    start = lines.index("   TOPIC LIST")
    assert lines[start + 1 :] == [
        "topic            : /chatter",
        "publisher count  : 1",
        "subscriber count : 0",
        "",
        "   SERVICE LIST",
        "service       : /clear",
        "service count : 0",
        "client count  : 1",
        "",
        "   ACTION LIST",
        "action              : /turn",
        "action server count : 1",
        "action client count : 0",
        "",
        "   QOS COMPATIBILITY LIST",
        "compatibility status : No publisher/subscriber pairs found",
        "",
        "=" * 80,
        "!!! WARNING !!!",
        "The report includes all ROS 2 endpoint information and system platform information.",
        "Please review the report before sharing, as it may contain sensitive or private data.",
        "=" * 80,
    ]


INDEX = """
distributions:
  jazzy:
    distribution: [jazzy/distribution.yaml, jazzy/more.yaml]
  kilted:
    distribution: [jazzy/more.yaml]
"""

DISTRIBUTION = """
repositories:
  geometry2:
    release:
      packages: [tf2, tf2_ros]
      version: 0.36.10-1
  rclpy:
    release: {version: 7.1.3-2}
  in_work:
    source: {type: git}
  unreleased:
    release: {packages: [unreleased]}
"""


@pytest.fixture(autouse=True)
def index(tmp_path, monkeypatch):
    (tmp_path / "jazzy").mkdir()
    (tmp_path / "index.yaml").write_text(INDEX)
    (tmp_path / "jazzy/distribution.yaml").write_text(DISTRIBUTION)
    (tmp_path / "jazzy/more.yaml").write_text(
        "repositories:\n  a:\n    release: {version: 2.0.0-1}\n"
    )
    monkeypatch.setenv("ROSDISTRO_INDEX_URL", (tmp_path / "index.yaml").as_uri())
    monkeypatch.setenv("ROS_DISTRO", "jazzy")


@pytest.fixture
def prefix(tmp_path, monkeypatch):
    """A prefix with the packages `a` of version 1.10.0 and `mine` of version 3.0.0."""
    prefix = tmp_path / "prefix"
    for name, version in (("a", "1.10.0"), ("mine", " 3.0.0 ")):
        (prefix / "share" / name).mkdir(parents=True)
        text = f"<package><name>{name}</name><version>{version}</version></package>"
        (prefix / "share" / name / "package.xml").write_text(text)
        marker = prefix / "share/ament_index/resource_index/packages" / name
        marker.parent.mkdir(parents=True, exist_ok=True)
        marker.touch()
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(prefix))


def test_the_versions_of_a_distribution(monkeypatch):
    released = {"tf2": "0.36.10", "tf2_ros": "0.36.10", "rclpy": "7.1.3", "a": "2.0.0"}
    assert get_distro_package_versions() == released
    monkeypatch.setenv("ROS_DISTRO", "kilted")
    assert get_distro_package_versions() == {"a": "2.0.0"}
    monkeypatch.setenv("ROS_DISTRO", "noetic")
    with pytest.raises(LookupError, match="no distribution 'noetic'; it has jazzy, kilted"):
        get_distro_package_versions()


@pytest.mark.usefixtures("prefix")
def test_the_versions_of_installed_packages():
    versions = get_local_package_versions()
    assert (versions["a"], versions["mine"]) == ("1.10.0", "3.0.0")
    assert versions["turtlesim"].count(".") == 2


@pytest.mark.parametrize(
    ("local", "warnings"), [("1.9.9", 1), ("1.10.0", 0), ("1.10.1", 0), ("2.0", 0), ("1.2.30", 1)]
)
def test_a_package_that_is_older_than_its_release(local, warnings):
    result = Result()
    told = f"a has been updated to a new version. local: {local} < latest: 1.10.0"
    with pytest.warns(UserWarning, match=re.escape(told)) if warnings else nullcontext():
        compare_versions(result, {"a": local, "mine": "0.0.0"}, {"a": "1.10.0", "other": "9.9.9"})
    assert (result.warning, result.error) == (warnings, 0)


@pytest.mark.usefixtures("prefix")
def test_the_check_and_the_report():
    assert PackageCheck().category() == PackageReport().category() == "package"
    with pytest.warns(UserWarning, match="has been updated") as told:
        result = PackageCheck().check()
    assert (result.error, result.warning) == (0, len(told))
    assert any(str(each.message).startswith("a has been updated") for each in told)
    report = PackageReport().report()
    assert report.name == "PACKAGE VERSIONS"
    found = dict(report.items)
    assert (found["a"], found["mine"]) == ("latest=2.0.0, local=1.10.0", "local=3.0.0")


@pytest.mark.usefixtures("prefix")
def test_without_the_index(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("ROSDISTRO_INDEX_URL", (tmp_path / "absent.yaml").as_uri())
    result = PackageCheck().check()
    assert (result.error, result.warning) == (1, 0)
    assert "are not known" in capsys.readouterr().err
    with pytest.warns(UserWarning, match="are not known"):
        report = PackageReport().report()
    assert dict(report.items)["a"] == "local=1.10.0"
