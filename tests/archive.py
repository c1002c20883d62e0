"""Folders of small text files as one file, which is easier to read and to compare.

Above each file is a line ``==== NAME ====``. A file that may be executed has ``(executable)``
after its name, and one whose last line does not end ``(no newline at the end)``::

    python tests/archive.py pack FOLDER > FILE
    python tests/archive.py unpack FILE FOLDER
"""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import NamedTuple

HEADER = re.compile(
    rb"^==== (\S+)(?: \((executable)\))?(?: \((no newline at the end)\))? ====\n", re.MULTILINE
)
EXECUTABLE = 0o111


class Entry(NamedTuple):
    """One file."""

    content: bytes
    executable: bool = False


def read(path: Path) -> dict[str, Entry]:
    """Return the files of an archive by their names."""
    before, *parts = HEADER.split(path.read_bytes())
    if before or not parts:
        raise ValueError(f"{path} does not begin with a line `==== NAME ====`")
    entries = {}
    for name, executable, unended, content in zip(*[iter(parts)] * 4, strict=True):
        if name.decode() in entries:
            raise ValueError(f"{path} has {name.decode()} twice")
        kept = content.removesuffix(b"\n") if unended else content
        entries[name.decode()] = Entry(kept, executable is not None)
    return entries


def write(entries: dict[str, Entry]) -> bytes:
    """Return the archive of some files."""
    parts = []
    for name, (content, executable) in entries.items():
        if HEADER.search(content + b"\n") or re.search(r"\s", name):
            raise ValueError(f"{name} does not fit into an archive")
        unended = content and not content.endswith(b"\n")
        notes = " (executable)" * executable + " (no newline at the end)" * bool(unended)
        parts.append(f"==== {name}{notes} ====\n".encode() + content + b"\n" * bool(unended))
    return b"".join(parts)


def unpack(path: Path, folder: Path, within: str = "") -> None:
    """Write the files of an archive, or those whose names begin with `within`, into a folder."""
    for name, entry in read(path).items():
        if name.startswith(within):
            file = folder / name.removeprefix(within)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(entry.content)
            if entry.executable:
                file.chmod(file.stat().st_mode | EXECUTABLE)


def pack(folder: Path) -> bytes:
    """Return the archive of a folder."""
    files = sorted(path for path in folder.rglob("*") if path.is_file())
    return write(
        {
            path.relative_to(folder).as_posix(): Entry(
                path.read_bytes(), bool(path.stat().st_mode & EXECUTABLE)
            )
            for path in files
        }
    )


if __name__ == "__main__":
    if sys.argv[1] == "pack":
        sys.stdout.buffer.write(pack(Path(sys.argv[2])))
    else:
        unpack(Path(sys.argv[2]), Path(sys.argv[3]))
