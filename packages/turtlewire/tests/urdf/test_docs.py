"""The examples of the how-to page about URDF; a `text` block is the previous block's output."""

from __future__ import annotations

import doctest
import re
import sys

from tests.how_to import blocks
from tests.places import HOW_TO, PATH

PAGE = HOW_TO / "urdf.md"


def commands(text):
    """The lines of a shell block; a here-document is one, and so is a line that is continued."""
    text = text.replace("\\\n", "")
    found = re.findall(r"^(?:cat .*?^END$|.+?)(?:\n|\Z)", text, re.MULTILINE | re.DOTALL)
    return [line.rstrip("\n") for line in found]


def test_the_page_does_what_it_says(run, tmp_path):
    path = PATH
    options = {"cwd": tmp_path, "environment": {"PATH": path}}
    found = blocks(PAGE.read_text())
    assert len(found) == 13
    printed = ""
    for kind, text in found:
        if kind == "text":
            flags = doctest.ELLIPSIS
            assert doctest.OutputChecker().check_output(text, printed, flags), printed
        elif kind == "python":
            printed = outcome(run(sys.executable, "-c", text, **options))
        else:
            for line in commands(text):
                if line.endswith(" &"):
                    run("bash", "-c", f"exec {line.removesuffix(' &')}", **options)
                else:
                    printed = outcome(run("bash", "-c", line, **options))


def outcome(program):
    """Return the output, without the log and the waiting time for the first transform."""
    assert program.wait() == 0, program.text
    skipped = ("[INFO]", "Waiting", "Warning")
    return "".join(
        f"{line}\n" for line in program.text.splitlines() if not line.startswith(skipped)
    )
