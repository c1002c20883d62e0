"""Answers questions about rclpy, for ours and for a real one alike.

Arguments: a file of questions and one of its sections. Each statement of the section is a question;
the answers are a JSON list: what a statement prints and the repr of its value, or its exception.
"""

from __future__ import annotations

import ast
import contextlib
import io
import json
import re
import sys
from pathlib import Path
from typing import Any


def sections(path: Path) -> dict[str, list[ast.stmt]]:
    """Return the questions of a file by section; a section begins with a comment."""
    parts = re.split(r"^# (.+)\n", path.read_text(encoding="utf-8"), flags=re.MULTILINE)
    return {name: ast.parse(text).body for name, text in zip(parts[1::2], parts[2::2], strict=True)}


def answer(question: ast.stmt, names: dict[str, Any]) -> str:
    """Run ``question`` in the namespace ``names``."""
    printed = io.StringIO()
    shown = ""
    try:
        with contextlib.redirect_stdout(printed):
            if isinstance(question, ast.Expr):
                shown = repr(eval(compile(ast.Expression(question.value), "", "eval"), names))
            else:
                exec(compile(ast.Module([question], []), "", "exec"), names)
    except Exception as error:
        shown = f"{type(error).__name__}: {error}"
    # Only a real one names lines of its C++, and addresses differ in any case.
    text = re.sub(r", at /project/src/\S+:\d+|0x[0-9a-f]+", "", printed.getvalue() + shown)
    return "\n".join(line.rstrip() for line in text.splitlines())


if __name__ == "__main__":
    names: dict[str, Any] = {}
    asked = sections(Path(sys.argv[1]))[sys.argv[2]]
    print(json.dumps([answer(question, names) for question in asked]))
