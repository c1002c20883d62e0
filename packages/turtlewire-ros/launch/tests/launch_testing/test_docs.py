"""The how-to page about launch tests, run."""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

from tests.places import HOW_TO

PAGE = HOW_TO / "test_a_node.md"


def test_the_page_does_what_it_says(tmp_path):
    text = PAGE.read_text()
    blocks = re.findall(r"^```(\w+)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    assert [kind for kind, _ in blocks] == ["python", "sh", "sh", "python", "sh"]
    names = ("test_talker.py", "test_talker_functions.py")
    assert [f"`{name}`" in text for name in names] == [True, True]
    programs = [code for kind, code in blocks if kind == "python"]
    for name, code in zip(names, programs, strict=True):
        (tmp_path / name).write_text(code)
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    for line in "".join(code for kind, code in blocks if kind == "sh").splitlines():
        done = subprocess.run(
            shlex.split(line),
            cwd=tmp_path,
            env={**os.environ, "PATH": path},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=840,
            check=False,
        )
        assert done.returncode == 0, (line, done.stdout)
    assert 'tests="3"' in (tmp_path / "report.xml").read_text()
