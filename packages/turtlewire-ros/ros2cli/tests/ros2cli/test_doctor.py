"""`ros2 doctor`: findings, the report, versions of packages, and `ros2doctor.api`."""

import os
import re
import sys
from contextlib import nullcontext

import pytest

from ros2cli.graph import endpoints_of_topic
from ros2cli.main import main
from ros2doctor.api import (
    Report,
    Result,
    generate_reports,
    get_service_names,
    print_warning_notice,
    run_checks,
    run_checks_of_others,
)
from ros2doctor.api.action import ActionReport
from ros2doctor.api.environment import ALL_ENVIRONMENT_VARIABLES, EnvironmentReport
from ros2doctor.api.format import compute_padding, doctor_warn, format_print
from ros2doctor.api.network import InterfaceFlags, NetworkCheck, NetworkReport
from ros2doctor.api.package import (
    PackageCheck,
    PackageReport,
    compare_versions,
    get_distro_package_versions,
    get_local_package_versions,
)
from ros2doctor.api.platform import PlatformCheck
from ros2doctor.api.qos_compatibility import QoSCompatibilityCheck, QoSCompatibilityReport
from ros2doctor.api.topic import TopicCheck, TopicReport
from turtlewire import msg
from turtlewire.wire import open_context
from turtlewire.wire.base import ServiceTypes, TypeId
from turtlewire.wire.qos import QoS, Reliability


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


# The checks and reports of `ros2doctor.api`, including other packages'.

CHECKS = """
from ros2doctor.api import DoctorCheck, DoctorReport, Report, Result


class TiresCheck(DoctorCheck):
    def category(self):
        return "tires"

    def check(self):
        result = Result()
        result.add_warning()
        return result


class TiresReport(DoctorReport):
    def category(self):
        return "tires"

    def report(self):
        report = Report("TIRES")
        report.add_to_report("front", 2.1)
        return report
"""


@pytest.fixture
def tires(tmp_path, monkeypatch):
    (tmp_path / "tires.py").write_text(CHECKS)
    metadata = tmp_path / "tires-1.0.dist-info"
    metadata.mkdir()
    (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: tires\nVersion: 1.0\n")
    (metadata / "entry_points.txt").write_text(
        "[ros2doctor.checks]\ntires = tires:TiresCheck\n"
        "[ros2doctor.report]\ntires = tires:TiresReport\n"
    )
    monkeypatch.syspath_prepend(str(tmp_path))
    yield metadata / "entry_points.txt"
    sys.modules.pop("tires", None)


@pytest.fixture
def broken(tires):
    text = tires.read_text().replace("\ntires =", "\nbroken = tires:Broken\ntires =")
    tires.write_text(text)
    module = tires.parent.parent / "tires.py"
    module.write_text(f"{CHECKS}\n\nclass Broken:\n    pass\n")


@pytest.mark.filterwarnings("ignore")  # the findings of this machine
def test_checks_of_other_packages_count(tires):
    failed, count, total = run_checks()
    assert total == 2
    assert "tires" not in failed
    failed, more, _ = run_checks(include_warnings=True)
    assert "tires" in failed
    assert more > count


def test_reports_have_titles_and_lines(tires, capsys):
    assert [each.name for each in generate_reports()] == [
        *("PLATFORM INFORMATION", "NETWORK CONFIGURATION", "RMW MIDDLEWARE", "ROS 2 INFORMATION"),
        *("ROS ENVIRONMENT", "TOPIC LIST", "SERVICE LIST", "ACTION LIST"),
        *("QOS COMPATIBILITY LIST", "TIRES"),
    ]
    (report,) = generate_reports(categories=["tires"])
    report.add_to_report("longest name", 0)
    format_print(report)
    assert capsys.readouterr().out == "\n   TIRES\nfront        : 2.1\nlongest name : 0\n"


@pytest.mark.filterwarnings("ignore")  # the findings of this machine
def test_a_broken_check_does_not_stop_the_others(broken, capsys):
    failed, _, total = run_checks(include_warnings=True)
    assert total == 2
    assert "tires" in failed
    told = "Failed to call 'ros2doctor.checks' extension 'broken': AttributeError: 'Broken' object"
    assert capsys.readouterr().err.count(told) == 1
    assert [report.name for report in generate_reports(categories=["tires"])] == ["TIRES"]
    told = "Failed to call 'ros2doctor.report' extension 'broken': AttributeError: 'Broken' object"
    assert told in capsys.readouterr().err


def test_check_without_a_result_is_reported(tires, capsys):
    module = tires.parent.parent / "tires.py"
    module.write_text(CHECKS.replace("return result", "return None"))
    assert run_checks_of_others() == (set(), 0, 0)
    told = "extension 'tires': TypeError: check() returned None, expected a Result"
    assert told in capsys.readouterr().err


def test_the_command_runs_the_checks_of_others(tires, capsys):
    main(["doctor"])
    assert capsys.readouterr().out.endswith("\nAll 1 checks of other packages passed\n")
    assert main(["doctor", "--include-warnings"]) == 1
    shown = capsys.readouterr().out
    assert shown.endswith("\n1/1 check(s) of other packages failed\n\nFailed modules: tires\n")
    assert main(["doctor", "--report"]) == 0
    report = capsys.readouterr().out
    print_warning_notice()
    assert report.endswith(f"\n   TIRES\nfront : 2.1\n{capsys.readouterr().out}")


def test_parts():
    result = Result()
    result.add_error()
    assert (result.error, result.warning) == (1, 0)
    assert compute_padding(Report("nothing").items) == 0
    with pytest.warns(UserWarning, match="careful"):
        doctor_warn("careful")


def test_reports_of_one_category():
    assert [each.name for each in generate_reports(categories=["platform"])] == [
        "PLATFORM INFORMATION",
        "ROS 2 INFORMATION",
    ]
    assert generate_reports(categories=["none"]) == []
    report, other = Report("x"), Report("x")
    assert report == other
    report.add_to_report("a", 1)
    assert report != other


def test_the_variables_that_are_set(monkeypatch):
    for name in ALL_ENVIRONMENT_VARIABLES:
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("CYCLONEDDS_URI", "<x/>")
    monkeypatch.setenv("ROS_PACKAGE_PATH", "/p")
    monkeypatch.setenv("ROS_HOME", "/h")
    assert EnvironmentReport().report().items == [
        ("ROS environment variables", "ROS_HOME=/h, ROS_PACKAGE_PATH=/p"),
        ("rcutils environment variables", ""),
        ("rmw environment variables", "CYCLONEDDS_URI=<x/>"),
    ]


def wait_for_owners(*topics):
    """Wait until a participant knows the node of each endpoint; endpoints are announced before."""
    context = open_context()
    try:
        graph = context.graph
        assert graph.wait_for(
            lambda: all(
                found and all(each.node for each in found)
                for topic in topics
                for kind in ("publisher", "subscription")
                for found in [endpoints_of_topic(graph, topic, kind)]
            ),
            60_000_000_000,
        )
    finally:
        context.close()


def test_checks_of_topics(capsys):
    context = open_context()
    try:
        kind = TypeId("std_msgs/msg/String", msg.type_hash("std_msgs/msg/String"))
        node = context.create_node("talker")
        node.create_publisher("/alone", kind, QoS())
        node.create_subscription("/unsaid", kind, QoS())
        with pytest.warns(UserWarning, match="detected on") as warned:
            assert TopicCheck().check().warning == 2
        assert [str(each.message) for each in warned] == [
            "Publisher without subscriber detected on /alone.",
            "Subscriber without publisher detected on /unsaid.",
        ]
        assert QoSCompatibilityReport().report().items == [
            ("compatibility status", "No publisher/subscriber pairs found")
        ]
        node.create_subscription("/alone", kind, QoS())
        node.create_publisher("/unsaid", kind, QoS(reliability=Reliability.BEST_EFFORT))
        wait_for_owners("/alone", "/unsaid")
        assert TopicCheck().check().warning == 0
        result = QoSCompatibilityCheck().check()
        assert (result.error, result.warning) == (1, 0)
        fault = "Best effort publisher and reliable subscription"
        told = f"ERROR: QoS compatibility error found on topic [/unsaid]: ERROR: {fault}"
        assert told in capsys.readouterr().err
        assert [value for _, value in QoSCompatibilityReport().report().items] == [
            *("/alone [std_msgs/msg/String]", "/talker", "/talker", "OK"),
            *("/unsaid [std_msgs/msg/String]", "/talker", "/talker", f"ERROR: {fault}"),
        ]
        assert ("topic", "/alone") in TopicReport().report().items
        assert ActionReport().report().items[0] == ("action", "none")
        assert get_service_names() == []
    finally:
        context.close()


def test_the_interfaces(monkeypatch):
    report = NetworkReport().report()
    assert report.name == "NETWORK CONFIGURATION"
    assert next(name for name, _ in report.items) == "device"
    assert str(InterfaceFlags("nothing")) == ""
    if sys.platform == "linux":
        assert ("inet", "127.0.0.1") in report.items
        assert "LOOPBACK" in InterfaceFlags("lo").flags
        assert str(InterfaceFlags("lo")).endswith("UP,LOOPBACK>")
    assert NetworkCheck().check().error == 0  # it is not to look for others
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET")
    monkeypatch.setattr("turtlewire.doctor.setup_findings.multicast_works", lambda: False)
    assert NetworkCheck().check().error == 1
    monkeypatch.setenv("ROS_DISTRO", "electric")
    with pytest.warns(UserWarning, match="ROS_DISTRO is 'electric'"):
        assert PlatformCheck().check().error == 0
