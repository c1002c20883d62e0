"""Fails when a line of a tracked text file is longer than 100 characters.

ruff checks Python only. Exceptions: tables, links and outputs of programs in Markdown, headings
that are such outputs, a line that is one word, and a linter's directive at the end of a line.
"""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

LIMIT = 100
ROOT = Path(__file__).resolve().parent.parent
#: Captured from elsewhere, drawn by a program, or tables whose rows are lines.
FOREIGN = re.compile(
    r"tests/golden/|.*/vendor/|tests/tutorial/verbatim/|.*\.svg$|LICENSE$|\.importlinter$"
    r"|.*/package-lock\.json$|tools/locks/"
    r"|.*\.ipynb$|.*/test_surface\.py$|tests/test_compatibility\.py$"
    r"|.*/urdf/test_parser\.py$|.*/page/packages\.json$"
)
#: What Python prints for a message or an error.
OUTPUT = re.compile(r"\w+(\.\w+)+(\(|: )")
DIRECTIVE = re.compile(r"\s*#\s*(noqa|type: ignore).*$")


def too_long(path: str, line: str) -> bool:
    """Return True if a line is too long and could be shorter."""
    line = DIRECTIVE.sub("", line)
    if len(line) <= LIMIT or " " not in line.strip().removeprefix("# "):
        return False
    is_table = path.endswith(".md") and line.startswith(("|", "### `", "> Hint: "))
    is_output = path.endswith(".md") and OUTPUT.match(line)
    is_requirement = path.endswith(".toml") and re.search(r"; (python|impl)\w+ ", line)
    return not (is_table or is_output or is_requirement or "://" in line)


def main() -> int:
    """Print the lines that are too long; the exit status."""
    listed = subprocess.run(
        ["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True
    )
    found = 0
    for path in listed.stdout.split("\0"):
        if not path or FOREIGN.match(path) or not (ROOT / path).is_file():
            continue
        try:
            lines = (ROOT / path).read_text(encoding="utf-8").splitlines()
        except UnicodeDecodeError:
            continue  # no text
        for number, line in enumerate(lines, 1):
            if too_long(path, line):
                found += 1
                print(f"{path}:{number}: {len(line)} characters, more than {LIMIT}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
