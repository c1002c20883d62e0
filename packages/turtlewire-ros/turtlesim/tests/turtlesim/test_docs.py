"""The program of the how-to page prints what the page says."""

from __future__ import annotations

import re
import subprocess
import sys

from tests.places import HOW_TO

PAGE = HOW_TO / "simulate.md"


def test_the_page_does_what_it_says():
    (program, printed), *others = re.findall(
        r"^```python\n(.*?)^```\n\n```text\n(.*?)^```$", PAGE.read_text(), re.MULTILINE | re.DOTALL
    )
    assert not others
    run = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    assert run.stdout == printed
