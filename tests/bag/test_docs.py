"""The how-to about bags does what it says."""

from __future__ import annotations

import doctest
from pathlib import Path

from tests.bag.conftest import write_bag

PAGE = Path(__file__).parents[2] / "docs" / "how-to" / "bags.md"


def test_the_page(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_bag(tmp_path / "my_bag")
    found = doctest.testfile(str(PAGE), module_relative=False)
    assert found.attempted > 15
    assert found.failed == 0
