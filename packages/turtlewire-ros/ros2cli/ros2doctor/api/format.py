"""Prints reports and warnings."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Collection
from types import TracebackType
from typing import Any


def format_print(report: Any) -> None:
    """Print title and lines of a `ros2doctor.api.Report`."""
    width = compute_padding(report.items)
    print(f"\n   {report.name}")
    for name, value in report.items:
        print(f"{name:{width}} : {value}")


def compute_padding(report_items: Collection[tuple[str, Any]]) -> int:
    """Return the length of the longest name."""
    return max((len(name) for name, _ in report_items), default=0)


def custom_warning_format(
    msg: Any,
    cat: type[Warning],
    filename: str,
    linenum: int,
    file: Any = None,
    line: str | None = None,
) -> str:
    """Return the text of a warning, with the place from which it came."""
    return f"{filename}: {linenum}: {msg}\n"


class CustomWarningFormat:
    """Within it, warnings have the form of `custom_warning_format`."""

    def __enter__(self) -> None:
        self._before = warnings.formatwarning
        warnings.formatwarning = custom_warning_format  # type: ignore[assignment]  # optional ones

    def __exit__(
        self,
        t: type[BaseException] | None,
        v: BaseException | None,
        trb: TracebackType | None,
    ) -> None:
        warnings.formatwarning = self._before


def doctor_warn(msg: str) -> None:
    """Warn of something that need not be a fault."""
    with CustomWarningFormat():
        warnings.warn(msg, stacklevel=2)


def doctor_error(msg: str) -> None:
    """Print a fault to stderr."""
    print(f"ERROR: {msg}", file=sys.stderr)
