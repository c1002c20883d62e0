"""The base classes of checks and reports, and what they return."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from ros2doctor.api.format import doctor_error, doctor_warn

if TYPE_CHECKING:
    from turtlewire.doctor.finding import Finding


class DoctorCheck:
    """Base of checks."""

    def category(self) -> str:
        """Return the checked category, for example ``network``."""
        raise NotImplementedError

    def check(self) -> Result:
        """Check it."""
        raise NotImplementedError


class DoctorReport:
    """Base of reports."""

    def category(self) -> str:
        """Return the reported category, for example ``network``."""
        raise NotImplementedError

    def report(self) -> Report | list[Report]:
        """Report it."""
        raise NotImplementedError


class Report:
    """A title, and lines of a name and a value each.

    Args:
        name: The title.
    """

    __slots__ = ("items", "name")
    __hash__ = None  # type: ignore[assignment]  # it can change

    def __init__(self, name: str) -> None:
        self.name = name
        self.items: list[tuple[str, Any]] = []

    def __eq__(self, other: object) -> bool:
        """Compare title and lines."""
        if not isinstance(other, Report):
            return NotImplemented
        return (self.name, self.items) == (other.name, other.items)

    def add_to_report(self, item_name: str, item_info: Any) -> None:
        """Add a line."""
        self.items.append((item_name, item_info))


class Result:
    """The numbers of errors and warnings that a check has found."""

    __slots__ = ("error", "warning")

    def __init__(self) -> None:
        self.error = 0
        self.warning = 0

    def add_error(self) -> None:
        """Count an error."""
        self.error += 1

    def add_warning(self) -> None:
        """Count a warning."""
        self.warning += 1


def result_of(findings: Iterable[Finding]) -> Result:
    """Print the findings of ``turtlewire doctor`` to stderr, and count them."""
    result = Result()
    for finding in findings:
        text = f"{finding.text}\n{finding.remedy}"
        if finding.is_problem:
            result.add_error()
            doctor_error(text)
        else:
            result.add_warning()
            doctor_warn(text)
    return result
