"""Packets are read as they were written."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays_of

from turtlewire.web.packets import encode_packet

from .fake_view import decode_packet

KINDS = st.sampled_from([np.float32, np.float64, np.uint8, np.uint16, np.int32])
ARRAYS = st.dictionaries(
    st.text(max_size=5),
    KINDS.flatmap(lambda kind: arrays_of.arrays(kind, arrays_of.array_shapes(min_side=0))),
    max_size=3,
)


@given(st.dictionaries(st.text(st.characters(codec="utf-8")), st.text()), ARRAYS)
def test_a_packet_comes_back(header, arrays):
    header = {name: value for name, value in header.items() if name != "arrays"}
    decoded = decode_packet(encode_packet(header, arrays))
    found = decoded.pop("arrays")
    assert decoded == header
    assert list(found) == list(arrays)
    for name, array in arrays.items():
        np.testing.assert_array_equal(found[name], array)


def test_slices_are_sent_in_order():
    columns = np.arange(12, dtype=np.float32).reshape(4, 3)[:, ::2]
    found = decode_packet(encode_packet({}, {"columns": columns}))["arrays"]["columns"]
    np.testing.assert_array_equal(found, columns)


def test_numbers_that_json_cannot_hold_are_refused():
    with pytest.raises(ValueError, match="not JSON compliant"):
        encode_packet({"speed": float("nan")})
