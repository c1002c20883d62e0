"""The examples of the buffer's how-to page, run."""

from __future__ import annotations

import doctest

from tests.places import HOW_TO

PAGE = HOW_TO / "tf_buffer.md"


def test_the_examples_do_what_the_page_says() -> None:
    failed, tried = doctest.testfile(str(PAGE), module_relative=False)
    assert (failed, tried) == (0, 35)


def test_the_page_has_both_ways_in() -> None:
    page = PAGE.read_text()
    assert "buffer.set_transform(" in page
    assert "buffer.set_transforms(" in page
