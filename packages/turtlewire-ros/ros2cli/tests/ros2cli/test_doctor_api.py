"""`ros2doctor.api`: checks and reports, including other packages'."""

import sys

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
from ros2doctor.api.platform import PlatformCheck
from ros2doctor.api.qos_compatibility import QoSCompatibilityCheck, QoSCompatibilityReport
from ros2doctor.api.topic import TopicCheck, TopicReport
from turtlewire import msg
from turtlewire.wire import open_context
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS, Reliability

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
