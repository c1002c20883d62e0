"""Bytes, defaults, fields and hashes of a real ROS 2 Jazzy."""

import math

from turtlewire import msg


def _has_nan(value):
    if isinstance(value, dict):
        return any(map(_has_nan, value.values()))
    if isinstance(value, list):
        return any(map(_has_nan, value))
    return value == "nan" or (isinstance(value, float) and math.isnan(value))


def test_cases_encode_to_the_bytes_of_ros(golden, message_from):
    cases = golden("cdr_cases.json")
    for case in cases:
        message = message_from(case["type"], case["values"])
        assert msg.serialize(message).hex() == case["bytes"], case["name"]
    assert len(cases) == 101


def test_cases_decode_to_the_values_of_ros(golden, message_from):
    compared = 0
    for case in golden("cdr_cases.json"):
        cls = msg.get_message(case["type"])
        for data in (case["bytes"], case.get("wire_bytes", case["bytes"])):
            decoded = msg.deserialize(cls, bytes.fromhex(data))
            assert msg.serialize(decoded).hex() == case["bytes"], case["name"]
        if case["roundtrip_equal"] and not _has_nan(case["values"]):
            assert decoded == message_from(case["type"], case["values"]), case["name"]
            compared += 1
    assert compared == 98


def test_cases_carry_our_type_hashes(golden):
    hashed = [case for case in golden("cdr_cases.json") if case.get("type_hash")]
    for case in hashed:
        assert msg.type_hash(case["type"]) == case["type_hash"], case["name"]
    assert len(hashed) == 101


def test_default_messages_encode_to_the_bytes_of_ros(golden):
    defaults = golden("default_bytes.json")
    for full_name, data in defaults.items():
        cls = msg.get_message(full_name)
        assert msg.serialize(cls()).hex() == data, full_name
        assert msg.deserialize(cls, bytes.fromhex(data)) == cls(), full_name
    assert len(defaults) == 204


def test_fields_and_their_types_are_those_of_ros(golden):
    interfaces = golden("interface_fields.json")
    for full_name, fields in interfaces.items():
        ours = msg.get_message(full_name).get_fields_and_field_types()
        assert list(ours.items()) == list(fields.items()), full_name
    assert len(interfaces) == 204


def test_type_hashes_are_those_of_ros(golden):
    hashes = golden("type_hashes.json")
    for full_name, expected in hashes.items():
        assert msg.type_hash(full_name) == expected, full_name
    assert len(hashes) == 237


def test_samples_of_the_running_demo_come_out_as_they_went_in(golden, message_from):
    samples = golden("demo_topics.json")
    for sample in samples:
        package, kind, _, name = sample["dds_type"].split("::")
        cls = msg.get_message(f"{package}/{kind}/{name.removesuffix('_')}")
        data = bytes.fromhex(sample["bytes"])
        decoded = msg.deserialize(cls, data)
        again = msg.serialize(decoded)
        assert again + bytes(-len(again) % 4) == data, sample["topic"]
        if sample["dds_type"].endswith("Log_"):
            sample["values"]["file"] = (
                decoded.file
            )  # the capture's values have another directory than its bytes
        assert decoded == message_from(cls._TYPE_NAME, sample["values"]), sample["topic"]
    assert len(samples) == 32


def test_payloads_of_service_calls_decode_and_encode(golden, message_from):
    calls = golden("service_calls.json")
    count = 0
    for call in calls:
        for side in ("request", "response"):
            part = call[side]
            package, kind, _, name = part["dds_type"].split("::")
            cls = msg.get_message(f"{package}/{kind}/{name.removesuffix('_')}")
            payload = bytes.fromhex(part["payload"])
            decoded = msg.deserialize(cls, bytes.fromhex(part["encapsulation"]) + payload)
            encoded = msg.serialize(decoded)[4:]
            assert payload.startswith(encoded), call["service"]
            assert set(payload[len(encoded) :]) <= {0}, call["service"]
            assert decoded == message_from(cls._TYPE_NAME, part["values"]), call["service"]
            count += 1
    assert count == 2 * len(calls) == 16
