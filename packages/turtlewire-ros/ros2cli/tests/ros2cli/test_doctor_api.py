"""`ros2doctor.api`: checks and reports, with those of other packages."""

from __future__ import annotations

import subprocess
import sys

import pytest

from ros2cli.main import main
from ros2doctor.api import Report, Result, generate_reports, run_checks, run_checks_of_others
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
        *("PLATFORM INFORMATION", "RMW MIDDLEWARE", "ROS 2 INFORMATION", "TOPIC LIST", "TIRES")
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
    assert capsys.readouterr().out.endswith("\n   TIRES\nfront : 2.1\n")


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
    shown = subprocess.run(run, capture_output=True, text=True, check=True, timeout=840).stdout
    assert "\n   PLATFORM INFORMATION\nsystem " in shown
    assert "\n   TOPIC LIST\n" in shown
