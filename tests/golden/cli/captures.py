"""The captured command lines."""

from __future__ import annotations

import atexit
import functools
import re
import tempfile
from dataclasses import dataclass
from pathlib import Path

from tests import archive

HERE = Path(__file__).parent
INPUTS = HERE / "inputs.txt"


@dataclass(frozen=True)
class Case:
    """One captured command."""

    name: str
    command: str
    exit_code: int
    interrupt_after: float | None
    stdout: str
    stderr: str
    cut_to: int | None

    @property
    def number(self) -> int:
        return int(self.name[:3])


def captures() -> list[Case]:
    """All captures, by their numbers."""
    files = set(HERE.glob("*.txt")) - {INPUTS}
    entries = [item for path in files for item in archive.read(path).items()]
    return [_parse(name, entry.content.decode()) for name, entry in sorted(entries)]


@functools.cache
def inputs() -> Path:
    """The folder of the launch and parameter files which the commands use."""
    folder = tempfile.TemporaryDirectory()
    atexit.register(folder.cleanup)
    archive.unpack(INPUTS, Path(folder.name))
    return Path(folder.name)


def _parse(name: str, text: str) -> Case:
    header, _, rest = text.partition("----- stdout -----\n")
    fields = dict(re.findall(r"^# ([a-z ]+): (.*)$", header, re.MULTILINE))
    # Paths and source lines in the captures were replaced, so the byte counts are not those of the files.
    stdout, _, stderr = rest.partition("\n----- stderr -----\n")
    ended = re.search(r"after ([0-9.]+) s", fields["ended"])
    cut = re.search(r"cut to its first (\d+) lines", fields.get("note", ""))
    return Case(
        name=name,
        command=fields["command"],
        exit_code=int(fields["exit code"]),
        interrupt_after=float(ended.group(1)) if ended else None,
        stdout=stdout,
        stderr=stderr.removesuffix("\n----- end -----\n"),
        cut_to=int(cut.group(1)) if cut else None,
    )


def capture(name: str) -> Case:
    """The capture of a name."""
    (found,) = (case for case in captures() if case.name == name)
    return found
