"""The 16 bytes in front of requests and responses, as a real rmw_cyclonedds writes them."""

from __future__ import annotations

import json
from pathlib import Path

from turtlewire.wire.base import RequestId
from turtlewire.wire.cyclone.services import format_service_id
from turtlewire.wire.services import join_header, split_header

CALLS = json.loads(
    (Path(__file__).parents[1] / "golden" / "wire" / "service_calls.json").read_text()
)


def test_the_headers_of_a_real_ros_2_are_reproduced():
    checked = 0
    for call in CALLS:
        for part in (call["request"], call["response"]):
            payload = bytes.fromhex(part["bytes"])
            request_id = RequestId(
                int.from_bytes(bytes.fromhex(part["header_guid"]), "little"), part["header_seq"]
            )
            cdr = bytes.fromhex(part["encapsulation"] + part["payload"])
            assert split_header(payload) == (request_id, cdr)
            assert join_header(request_id, cdr) == payload
            checked += 1
    assert checked == 2 * len(CALLS) == 16


def test_a_payload_too_short_for_the_header_is_none():
    assert split_header(b"\x00\x01\x00\x00" + bytes(15)) is None


def test_service_ids_are_spelled_like_those_of_rmw_cyclonedds():
    participant = bytes.fromhex("0110a83ed762017dd5286bfb000001c1")
    assert format_service_id(participant, 1) == " 1.10.a8.3e.d7.62.1.7d.d5.28.6b.fb.0.0.0.1"
