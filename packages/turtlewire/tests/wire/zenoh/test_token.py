"""Tokens, QoS texts and attachments, as rmw_zenoh_cpp writes and reads them."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from turtlewire.wire.qos import (
    BEST_AVAILABLE_NS,
    INFINITE_NS,
    Durability,
    History,
    Liveliness,
    QoS,
    Reliability,
)
from turtlewire.wire.zenoh.protocol import (
    NODE,
    PUBLISHER,
    Attachment,
    Token,
    adapted,
    format_qos,
    pack_attachment,
    parse_qos,
)

HASH = "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"
NODE_TEXT = "@ros2_lv/2/aac3178e146ba6f1fc6e6a4085e77f21/0/0/NN/%/%ns/listener"
PUBLISHER_TEXT = (
    "@ros2_lv/2/8b20917502ee955ac4476e0266340d5c/0/10/MP/%/%/talker/%chatter/"
    f"std_msgs::msg::dds_::String_/{HASH}/::,7:,:,:,,"
)


def test_a_node():
    token = Token.parse(NODE_TEXT)
    assert token is not None
    assert token.kind == NODE
    assert (token.domain_id, token.session) == (2, "aac3178e146ba6f1fc6e6a4085e77f21")
    assert (token.enclave, token.namespace, token.node) == ("/", "/ns", "listener")
    assert token.text == NODE_TEXT


def test_an_endpoint():
    token = Token.parse(PUBLISHER_TEXT)
    assert token is not None
    assert (token.kind, token.name) == (PUBLISHER, "/chatter")
    assert token.data_key == f"2/chatter/std_msgs::msg::dds_::String_/{HASH}"
    assert parse_qos(token.qos).depth == 7
    assert token.text == PUBLISHER_TEXT


def test_later_versions_add_a_field():
    token = Token.parse(PUBLISHER_TEXT + "/backends:cpu:1")
    assert token is not None
    assert token.text == PUBLISHER_TEXT


@pytest.mark.parametrize(
    "text",
    [
        "",
        "@ros2_lv/2/aac3",
        "@other/2/aac3/0/0/NN/%/%/listener",
        "@ros2_lv/two/aac3/0/0/NN/%/%/listener",
        "@ros2_lv/2/aac3/0/0/XX/%/%/listener",
        "@ros2_lv/2/aac3/0/0/NN//%/listener",
        "@ros2_lv/2/aac3/0/0/MP/%/%/talker/%chatter",
    ],
)
def test_invalid_tokens(text: str):
    assert Token.parse(text) is None


def test_the_gid_is_the_hash_of_the_text():
    """XXH3 of 128 bits, the low half first; its reference value of no bytes is known."""
    from xxhash import xxh3_128_hexdigest

    assert xxh3_128_hexdigest(b"") == "99aa06d3014798d86001c324468d497f"
    token = Token.parse(NODE_TEXT)
    assert token is not None
    high, low = divmod(int(xxh3_128_hexdigest(NODE_TEXT.encode()), 16), 1 << 64)
    assert token.gid == low.to_bytes(8, "little") + high.to_bytes(8, "little")


def test_the_text_of_a_qos():
    assert format_qos(adapted(QoS())) == "::,10:,:,:,,"
    assert format_qos(adapted(QoS(depth=42))) == "::,:,:,:,,"
    system_default = QoS(History.SYSTEM_DEFAULT, 0, *[Reliability.SYSTEM_DEFAULT] * 2)
    assert format_qos(adapted(system_default)) == "::,:,:,:,,"
    best_available = QoS(
        reliability=Reliability.BEST_AVAILABLE,
        durability=Durability.BEST_AVAILABLE,
        deadline_ns=BEST_AVAILABLE_NS,
        liveliness=Liveliness.BEST_AVAILABLE,
        liveliness_lease_ns=BEST_AVAILABLE_NS,
    )
    assert format_qos(adapted(best_available)) == "4:4:,10:,854775806:,:5,,854775806"
    special = QoS(
        History.KEEP_ALL,
        5,
        Reliability.BEST_EFFORT,
        Durability.TRANSIENT_LOCAL,
        1_500_000_000,
        2,
        Liveliness.MANUAL_BY_TOPIC,
        3_000_000_000,
    )
    assert format_qos(special) == "2:1:2,5:1,500000000:0,2:3,3,0"


durations = st.integers(1, INFINITE_NS)


@given(
    st.builds(
        QoS,
        st.sampled_from([History.KEEP_LAST, History.KEEP_ALL]),
        st.integers(1, 2**31),
        st.sampled_from([Reliability.RELIABLE, Reliability.BEST_EFFORT]),
        st.sampled_from([Durability.TRANSIENT_LOCAL, Durability.VOLATILE]),
        durations,
        durations,
        st.sampled_from([Liveliness.AUTOMATIC, Liveliness.MANUAL_BY_TOPIC]),
        durations,
        st.just(False),
    )
)
def test_a_qos_survives(qos: QoS):
    assert parse_qos(format_qos(qos)) == qos


@pytest.mark.parametrize("text", ["", "::,10:,:,:", "x::,10:,:,:,,", "9::,10:,:,:,,", "::10:::"])
def test_invalid_qos(text: str):
    with pytest.raises(ValueError, match=r"\S"):
        parse_qos(text)


def test_the_bytes_of_an_attachment():
    attachment = Attachment(3, 1_700_000_000_000_000_001, bytes(range(16)))
    packed = pack_attachment(*attachment)
    assert len(packed) == 33
    assert packed[:8] == b"\x03" + bytes(7)
    assert packed[16] == 16
    assert Attachment.unpack(packed) == attachment


def test_the_attachment_of_the_first_jazzy_versions():
    number, stamp, gid = (7).to_bytes(8, "little"), (9).to_bytes(8, "little"), b"g" * 16
    data = b"\x0fsequence_number" + number + b"\x10source_timestamp" + stamp
    data += b"\x0asource_gid\x10" + gid
    assert Attachment.unpack(data) == Attachment(7, 9, gid)


@given(st.binary(max_size=100).filter(lambda data: len(data) not in {33, 77}))
def test_invalid_attachments(data: bytes):
    with pytest.raises(ValueError, match=f"an attachment of {len(data)} bytes"):
        Attachment.unpack(data)
