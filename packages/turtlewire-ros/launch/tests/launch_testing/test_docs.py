"""The how-to page about launch tests, run."""

import os
import shlex
import subprocess

from tests.how_to import blocks, blocks_of
from tests.places import HOW_TO, PATH

PAGE = HOW_TO / "test_a_node.md"


def test_the_page_does_what_it_says(tmp_path):
    text = PAGE.read_text()
    assert [kind for kind, _ in blocks(text)] == ["python", "sh", "sh", "python", "sh"]
    names = ("test_talker.py", "test_talker_functions.py")
    assert [f"`{name}`" in text for name in names] == [True, True]
    programs = blocks_of(text, "python")
    for name, code in zip(names, programs, strict=True):
        (tmp_path / name).write_text(code)
    path = PATH
    for line in "".join(blocks_of(text, "sh")).splitlines():
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
