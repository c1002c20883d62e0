"""Results of tests as JUnit's XML."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree as ET

if TYPE_CHECKING:
    import unittest


def unittestResultsToXml(  # noqa: N802  ROS 2's name
    *,
    name: str = "launch_test",
    test_results: Mapping[Any, unittest.TestResult] = {},
) -> ET.ElementTree:
    """Make the document: one ``testsuite`` for each launch.

    Args:
        name: Name of the whole.
        test_results: What came of each launch.
    """
    root = ET.Element("testsuites", {"name": name})
    suites = [unittestResultToXml(str(run), result) for run, result in test_results.items()]
    for count in ("tests", "errors", "failures", "skipped"):
        root.set(count, str(sum(int(suite.get(count, "0")) for suite in suites)))
    root.set("time", f"{sum(float(suite.get('time', '0')) for suite in suites):.3f}")
    root.extend(suites)
    return ET.ElementTree(root)


def unittestResultToXml(  # noqa: N802  ROS 2's name
    name: str, test_result: Any
) -> ET.Element:
    """Make the ``testsuite`` of one launch.

    Args:
        name: Its name.
        test_result: A :class:`launch_testing.test_runner.TestResult`.
    """
    cases = list(test_result.testCases)
    # What failed outside of tests, for example in setUpClass.
    cases += [case for case, _ in test_result.errors if case not in cases]
    suite = ET.Element(
        "testsuite",
        {
            "name": name,
            "tests": str(len(cases)),
            "errors": str(len(test_result.errors)),
            "failures": str(len(test_result.failures) + len(test_result.unexpectedSuccesses)),
            "skipped": str(len(test_result.skipped)),
            "time": f"{sum(test_result.testTimes.values()):.3f}",
        },
    )
    suite.extend(unittestCaseToXml(test_result, case) for case in cases)
    if not cases and not test_result.wasSuccessful():
        # A launch without tests that could not run must also be visible.
        case = ET.SubElement(suite, "testcase", {"classname": name, "name": "launch"})
        ET.SubElement(case, "failure", {"message": getattr(test_result, "message", "")})
        suite.set("tests", "1")
        suite.set("failures", "1")
    return suite


def unittestCaseToXml(  # noqa: N802  ROS 2's name
    test_result: Any, test_case: Any
) -> ET.Element:
    """Make the ``testcase`` of one test.

    Args:
        test_result: The result that it belongs to.
        test_case: The test.
    """
    name = getattr(test_case, "_testMethodName", str(test_case))
    element = ET.Element(
        "testcase",
        {
            "classname": f"{type(test_case).__module__}.{type(test_case).__name__}",
            "name": name,
            "time": f"{test_result.testTimes.get(test_case, 0.0):.3f}",
        },
    )
    for kind, found in (
        ("failure", test_result.failures),
        ("error", test_result.errors),
        ("skipped", test_result.skipped),
    ):
        for case, text in found:
            if case is test_case:
                last = text.strip().splitlines()[-1] if text.strip() else ""
                child = ET.SubElement(element, kind, {"message": _printable(last)})
                if kind != "skipped":
                    child.text = _printable(text)
    if test_case in test_result.unexpectedSuccesses:
        ET.SubElement(element, "failure", {"message": "unexpected success"})
    return element


def _printable(text: str) -> str:
    """Return the text without characters that XML does not allow."""
    return "".join(character for character in text if character >= " " or character in "\t\n\r")
