"""`ros2doctor.api`: checks and reports, with those of other packages."""

from __future__ import annotations

import subprocess
import sys

import pytest

from ros2doctor.api import Report, Result, generate_reports, run_checks
from ros2doctor.api.format import compute_padding, doctor_warn, format_print

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
        *("PLATFORM INFORMATION", "RMW MIDDLEWARE", "ROS 2 INFORMATION", "TOPIC LIST", "TIRES")
    ]
    (report,) = generate_reports(categories=["tires"])
    report.add_to_report("longest name", 0)
    format_print(report)
    assert capsys.readouterr().out == "\n   TIRES\nfront        : 2.1\nlongest name : 0\n"


def test_parts():
    result = Result()
    result.add_error()
    assert (result.error, result.warning) == (1, 0)
    assert compute_padding(Report("nothing").items) == 0
    with pytest.warns(UserWarning, match="careful"):
        doctor_warn("careful")


def test_the_report_of_the_command_is_the_same():
    program = "from ros2cli.main import main; main(['doctor', '--report'])"
    run = [sys.executable, "-c", program]
    shown = subprocess.run(run, capture_output=True, text=True, check=True, timeout=100).stdout
    assert "\n   PLATFORM INFORMATION\nsystem " in shown
    assert "\n   TOPIC LIST\n" in shown
