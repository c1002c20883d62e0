"""Results as pages, and as JUnit XML, which GitHub, GitLab and Jenkins show.

The pages are an overview and one for each student. They need no JavaScript and no network.
Everything that students wrote is escaped: folder names, files, error texts, what they print.
"""

from __future__ import annotations

import functools
import html
from collections.abc import Sequence
from importlib.resources import files
from typing import TYPE_CHECKING
from urllib.parse import quote
from xml.etree import ElementTree as ET

from turtlewire.terminal.printable import printable, printable_lines
from turtlewire.wording import counted

if TYPE_CHECKING:
    from turtle_class.grading import GradeReport
    from turtle_class.runner import CheckResult, Outcome

__all__ = [
    "as_junit",
    "overview",
    "student_page",
]


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


_STYLE = """
:root { --hint: #fff4d6; } @media (prefers-color-scheme: dark) { :root { --hint: #3a3217; } }
body { max-width: 75rem; margin: 0 auto; padding: 1rem; }
a { color: inherit; } h1 { margin: 0.3rem 0; } h2 { margin: 0 0 0.3rem; font-size: 1.15rem; }
.quiet { color: var(--quiet); } .good { color: var(--good); } .bad { color: var(--bad); }
.wide { overflow-x: auto; } table { border-collapse: collapse; }
th, td { padding: 0.35rem 0.7rem; border-bottom: 1px solid var(--line); text-align: center; }
th:first-child { text-align: left; position: sticky; left: 0; background: var(--paper); }
tbody th { font-weight: 500; } td { white-space: nowrap; } thead th { vertical-align: bottom; }
section { background: var(--card); border: 1px solid var(--line); border-radius: 0.6rem;
  padding: 0.9rem 1.1rem; margin: 1rem 0; }
ul.checks { list-style: none; padding: 0; margin: 0.4rem 0; } ul.checks li { margin: 0.25rem 0; }
.hint { background: var(--hint); border-radius: 0.4rem; padding: 0.5rem 0.8rem; margin: 0.4rem 0; }
pre { overflow-x: auto; background: var(--paper); border: 1px solid var(--line); padding: 0.6rem;
  border-radius: 0.4rem; font-size: 0.85rem; } mark { background: var(--hint); color: inherit; }
details summary { cursor: pointer; }
@media print { section { break-inside: avoid; } }
"""
_POLICY = "default-src 'none'; style-src 'unsafe-inline'"
_SIGNS = {"passed": ("good", "✓"), "failed": ("bad", "✗"), "skipped": ("quiet", "○")}
_LINES_AROUND = 2


def overview(reports: Sequence[GradeReport], title: str, when: str) -> str:
    """Return the table of all students; ``title`` and ``when`` stand above it."""
    exercises = [outcome.exercise for outcome in reports[0].outcomes]
    head = "".join(f"<th scope=col>{_text(each.title)}</th>" for each in exercises)
    rows = "".join(_row(report) for report in reports)
    solved = _line_of_totals(reports)
    body = (
        f"<h1>{_text(title)}</h1><p class=quiet>{counted(len(reports), 'student')}, "
        f"{counted(len(exercises), 'exercise')}, graded {_text(when)}. "
        "Click a student's name for results and hints.</p><div "
        "class=wide><table><thead><tr><th scope=col>Student</th>"
        f"<th scope=col>Solved</th>{head}</tr></thead><tbody>{rows}</tbody>"
        f"<tfoot>{solved}</tfoot></table></div>"
        "<p class=quiet>✓ solved · 2/4 checks passed · ○ not handed in</p>"
    )
    return _page(title, body)


def _row(report: GradeReport) -> str:
    cells = "".join(f"<td>{_cell(outcome)}</td>" for outcome in report.outcomes)
    return (
        f'<tr><th scope=row><a href="{quote(report.slug)}.html">{_text(report.student)}</a></th>'
        f"<td>{report.passed} of {len(report.outcomes)}</td>{cells}</tr>"
    )


def _cell(outcome: Outcome) -> str:
    if outcome.passed:
        return "<span class=good>✓</span>"
    if not outcome.handed_in:
        return "<span class=quiet>○</span>"
    return f"<span class=bad>{outcome.points}/{len(outcome.results)}</span>"


def _line_of_totals(reports: Sequence[GradeReport]) -> str:
    columns = zip(*(report.outcomes for report in reports), strict=True)
    cells = "".join(
        f"<td class=quiet>{sum(outcome.passed for outcome in column)}</td>" for column in columns
    )
    return f"<tr><th scope=row class=quiet>Solved by</th><td></td>{cells}</tr>"


def student_page(report: GradeReport, when: str) -> str:
    """Return a student's page: results and advice."""
    parts = "".join(_exercise(outcome) for outcome in report.outcomes)
    body = (
        f'<p><a href="index.html">All students</a></p><h1>{_text(report.student)}</h1>'
        f"<p>{report.passed} of {counted(len(report.outcomes), 'exercise')} solved "
        f"<span class=quiet>· graded {_text(when)}</span></p>{parts}"
    )
    return _page(report.student, body)


def _exercise(outcome: Outcome) -> str:
    title = f"{_cell(outcome)} {_text(outcome.exercise.title)}"
    checks = "".join(f"<li>{_check(result, outcome)}</li>" for result in outcome.results)
    log = ""
    if outcome.log.strip() and not outcome.passed:
        text = html.escape(printable_lines(outcome.log))
        log = f"<details><summary>What it printed</summary><pre>{text}</pre></details>"
    return f"<section><h2>{title}</h2><ul class=checks>{checks}</ul>{log}</section>"


def _check(result: CheckResult, outcome: Outcome) -> str:
    kind, sign = _SIGNS[result.state]
    line = f"<span class={kind}>{sign}</span> {_text(result.check)}"
    if result.state == "passed":
        return line
    if result.state == "skipped":
        return f"{line} <span class=quiet>{_text(result.text)} {_text(result.hint)}</span>"
    hint = f"<div class=hint>{_text(result.hint)}</div>" if result.hint else ""
    return f"{line}<div>{_text(result.text)}</div>{hint}{_excerpt(result, outcome)}"


def _excerpt(result: CheckResult, outcome: Outcome) -> str:
    """Return the line that an error points to, and those around it."""
    lines = outcome.files.get(result.file, "").splitlines()
    if not 0 < result.line <= len(lines):
        return ""
    first = max(1, result.line - _LINES_AROUND)
    shown = []
    for number in range(first, min(len(lines), result.line + _LINES_AROUND) + 1):
        text = html.escape(f"{number:4}  {printable_lines(lines[number - 1])}")
        shown.append(f"<mark>{text}</mark>" if number == result.line else text)
    return f"<p class=quiet>{_text(result.file)}</p><pre>{chr(10).join(shown)}</pre>"


def _text(text: str) -> str:
    return html.escape(printable(text))


def _page(title: str, body: str) -> str:
    return (
        "<!doctype html><html lang=en><head><meta charset=utf-8>"
        f'<meta http-equiv="Content-Security-Policy" content="{_POLICY}">'
        '<meta name=viewport content="width=device-width, initial-scale=1">'
        f"<title>{_text(title)}</title><style>{_kit()}{_STYLE}</style></head><body>{body}</body></html>\n"
    )


@functools.cache
def _kit() -> str:
    """Return the style of all pages: a report is one file."""
    return (files("turtlewire.web") / "kit" / "kit.css").read_text(encoding="utf-8")
