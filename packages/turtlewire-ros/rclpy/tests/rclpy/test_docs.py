"""The programs of docs/how-to/asyncio.md print what the page says."""

import subprocess
import sys

import pytest
from tests.how_to import blocks, blocks_of
from tests.places import HOW_TO

PAGE = (HOW_TO / "asyncio.md").read_text()
PROGRAMS, OUTPUTS = blocks_of(PAGE, "python"), blocks_of(PAGE, "text")


def test_each_program_has_its_output():
    assert [kind for kind, _ in blocks(PAGE)] == ["python", "text"] * 4


@pytest.mark.parametrize("middleware", ["local", "rmw_cyclonedds_cpp"])
@pytest.mark.parametrize("index", range(4))
def test_a_program_prints_what_the_page_says(monkeypatch, middleware, index):
    monkeypatch.setenv("RMW_IMPLEMENTATION", middleware)
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", PROGRAMS[index]],
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, OUTPUTS[index], "")
