"""Errors of the engine travel between processes with their hints."""

from __future__ import annotations

import pickle

import pytest

from turtlewire import Buffer
from turtlewire.errors import LookupException, WireError


@pytest.mark.parametrize("error", [LookupException("no frame"), WireError("no network")])
def test_a_pickled_error_keeps_the_hint_that_it_was_given(error):
    copy = pickle.loads(pickle.dumps(error.with_hint("Start a broadcaster.")))
    assert (type(copy), str(copy)) == (type(error), str(error))
    assert copy.hint == "Start a broadcaster."


def test_a_pickled_error_keeps_the_hint_that_only_the_buffer_could_give():
    buffer = Buffer()
    buffer.set_transform("world", "robot", 1, (0, 0, 0), (0, 0, 0, 1))
    with pytest.raises(LookupException) as caught:
        buffer.lookup_transform("world", "robto")
    copy = pickle.loads(pickle.dumps(caught.value))
    assert "robot" in caught.value.hint
    assert copy.hint == caught.value.hint
