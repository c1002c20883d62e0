"""Every answer of the real tf2_py of Jazzy and Lyrical, on both cores."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest
from tests.needs import COMPILED_CORE

from tests import places

GOLDEN = places.GOLDEN / "tf2"
#: Jazzy's first core and its newest, and Lyrical's: the distribution, answers, and texts. Of the
#: texts of the first, 0.36.20 gives 854 no longer.
FILES = {
    "dev.jsonl.gz": ("jazzy", 24969, 12589 - 854),
    "jazzy-0.36.20-dev.jsonl.gz": ("jazzy", 15313, 9167),
    "lyrical-0.45.7-dev.jsonl.gz": ("lyrical", 12030, 7747),
}


@pytest.mark.parametrize("file", FILES)
@pytest.mark.parametrize("core", ["native", "python"])
def test_all_answers_equal(core: str, file: str) -> None:
    if core == "native":
        pytest.importorskip("turtlewire._native", reason=COMPILED_CORE)
    distro, answers, texts = FILES[file]
    command = [sys.executable, str(GOLDEN / "check.py"), str(GOLDEN / file), "--allow-subclass"]
    run = subprocess.run(
        command,
        env={**os.environ, "TURTLEWIRE_CORE": core, "ROS_DISTRO": distro},
        capture_output=True,
        text=True,
        timeout=840,
        check=False,
    )
    assert run.returncode == 0, run.stdout + run.stderr
    assert (
        run.stdout.splitlines()[-1]
        == f"{answers} of {answers} answers equal (class/numbers), {texts} texts equal"
    )
