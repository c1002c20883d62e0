"""What a page makes of a packet."""

from __future__ import annotations

import json
import struct

import numpy as np


def decode_packet(data):
    """The header, with each array in place of its description; or what a text says."""
    if isinstance(data, str):
        return json.loads(data)
    (length,) = struct.unpack_from("<I", data)
    header = json.loads(data[4 : 4 + length])
    start = 4 + length
    for name, (kind, shape) in header["arrays"].items():
        assert start % 8 == 0
        count = int(np.prod(shape))
        header["arrays"][name] = np.frombuffer(data, "<" + kind, count, start).reshape(shape)
        start += -(-header["arrays"][name].nbytes // 8) * 8
    assert start == len(data)
    return header
