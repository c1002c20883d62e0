"""The students of a class: names and ROS domains."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

from turtle_class import ClassError
from turtlewire.terminal.printable import printable
from turtlewire.wire.environment import MAX_DOMAIN_ID

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["Seat", "read_roster", "seats_of_domains"]

_RANGE = re.compile(r"(\d{1,4})(?:-(\d{1,4}))?", re.ASCII)
_NUMBER = re.compile(r"\d{1,4}", re.ASCII)
_DOMAINS = f"a domain is a number from 0 to {MAX_DOMAIN_ID}"
_HOW = "write a line `name,domain` for each student, or in a .yaml file `name: domain`"


class Seat(NamedTuple):
    """A student.

    Attributes:
        name: What the page shows.
        domain: The student's ROS_DOMAIN_ID.
    """

    name: str
    domain: int


def seats_of_domains(text: str) -> list[Seat]:
    """Return the seats of domains such as ``1-30,40``.

    Raises:
        ClassError: The text is something else.
    """
    seats = []
    for part in text.split(","):
        found = _RANGE.fullmatch(part.strip())
        if found is None:
            raise ClassError(f"{part!r} names no domains: write them as 1-30 or 1-10,15,20")
        first, last = int(found[1]), int(found[2] or found[1])
        if not first <= last <= MAX_DOMAIN_ID:
            raise ClassError(f"{part!r} names no domains: {_DOMAINS}, the smaller one first")
        seats += [Seat(f"Domain {number}", number) for number in range(first, last + 1)]
    return _unique(((seat, "") for seat in seats), "--domains")


def read_roster(path: Path) -> list[Seat]:
    """Return the students of a file: ``name,domain`` lines, or YAML of ``name: domain``.

    Raises:
        ClassError: The file cannot be read, or a line is wrong; the text names it.
    """
    file = printable(path.name)
    try:
        text = path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise ClassError(f"the roster {file} cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise ClassError(f"the roster {file} is not UTF-8: save it as UTF-8") from None
    rows = _yaml_rows(text, file) if path.suffix in {".yaml", ".yml"} else _csv_rows(text, file)
    seats = _unique(
        (
            (_seat(name, domain, f"{file}, line {line}"), f", line {line}")
            for line, name, domain in rows
        ),
        file,
    )
    if not seats:
        raise ClassError(f"{file} holds no students: {_HOW}")
    return seats


def _csv_rows(text: str, file: str) -> Iterator[tuple[int, str, str]]:
    reader = csv.reader(text.splitlines())
    for row in _readable_rows(reader, file):
        cells = [cell.strip() for cell in row]
        if (
            not any(cells)
            or cells[0].startswith("#")
            or (reader.line_num == 1 and [cell.lower() for cell in cells] == ["name", "domain"])
        ):
            continue
        if len(cells) != 2:
            raise ClassError(f"{file}, line {reader.line_num}: {','.join(row)!r}: {_HOW}")
        yield reader.line_num, cells[0], cells[1]


def _readable_rows(rows: Iterable[list[str]], file: str) -> Iterator[list[str]]:
    try:
        yield from rows
    except csv.Error as error:
        raise ClassError(f"{file} is not CSV: {error}") from None


def _yaml_rows(text: str, file: str) -> Iterator[tuple[int, str, str]]:
    import yaml

    try:
        root: Any = yaml.compose(text, yaml.SafeLoader)
    except yaml.YAMLError as error:
        raise ClassError(f"{file} is not YAML: {printable(str(error))}") from None
    except RecursionError:
        raise ClassError(f"{file} is nested too deeply: {_HOW}") from None
    if root is None:
        return
    if not isinstance(root, yaml.MappingNode):
        raise ClassError(f"{file}, line {root.start_mark.line + 1}: {_HOW}")
    for name, domain in root.value:
        line = name.start_mark.line + 1
        if not (isinstance(name, yaml.ScalarNode) and isinstance(domain, yaml.ScalarNode)):
            raise ClassError(f"{file}, line {line}: {_HOW}")
        yield line, name.value.strip(), domain.value.strip()


def _seat(name: str, domain: str, place: str) -> Seat:
    if not name:
        raise ClassError(f"{place}: the name is missing: {_HOW}")
    if not _NUMBER.fullmatch(domain) or int(domain) > MAX_DOMAIN_ID:
        raise ClassError(f"{place}: {domain!r} is not a domain of {printable(name)}: {_DOMAINS}")
    return Seat(printable(name), int(domain))


def _unique(seats: Iterable[tuple[Seat, str]], file: str) -> list[Seat]:
    by_domain: dict[int, Seat] = {}
    for seat, place in seats:
        other = by_domain.setdefault(seat.domain, seat)
        if other is not seat:
            raise ClassError(
                f"{file}{place}: domain {seat.domain} belongs to {other.name} and {seat.name}: "
                "give each student another domain"
            )
    return list(by_domain.values())
