"""Results as JUnit XML, which GitHub, GitLab and Jenkins show."""

from __future__ import annotations

from typing import TYPE_CHECKING
from xml.etree import ElementTree as ET

from turtlewire.terminal.printable import printable, printable_lines

if TYPE_CHECKING:
    from turtle_class.grading import GradeReport
    from turtle_class.runner import CheckResult, Outcome

__all__ = ["as_junit"]


def as_junit(report: GradeReport) -> str:
    """Return a student's results: a suite for each exercise, a case for each check."""
    suites = [_suite(report, outcome) for outcome in report.outcomes]
    root = ET.Element("testsuites", {"name": report.student, **_totals(suites)})
    root.extend(suites)
    ET.indent(root)
    return ET.tostring(root, encoding="unicode", xml_declaration=True) + "\n"


def _totals(suites: list[ET.Element]) -> dict[str, str]:
    counted = ("tests", "failures", "errors", "skipped")
    return {name: str(sum(int(suite.get(name, 0)) for suite in suites)) for name in counted}


def _suite(report: GradeReport, outcome: Outcome) -> ET.Element:
    states = [result.state for result in outcome.results]
    suite = ET.Element(
        "testsuite",
        name=outcome.exercise.name,
        tests=str(len(states)),
        failures=str(states.count("failed")),
        errors="0",
        skipped=str(states.count("skipped")),
        time=f"{outcome.seconds:.3f}",
    )
    for result in outcome.results:
        suite.append(_case(f"{report.student}.{outcome.exercise.name}", result))
    if outcome.log:
        ET.SubElement(suite, "system-out").text = printable_lines(outcome.log)
    return suite


def _case(class_name: str, result: CheckResult) -> ET.Element:
    case = ET.Element("testcase", classname=class_name, name=result.check)
    text, hint = printable_lines(result.text), printable_lines(result.hint)
    if result.state == "skipped":
        ET.SubElement(case, "skipped", message=printable(result.text))
    elif result.state == "failed":
        failure = ET.SubElement(case, "failure", message=printable(result.text))
        place = f"{printable(result.file)}, line {result.line}" if result.line else ""
        failure.text = "\n".join(filter(None, (text, hint, place)))
    return case
