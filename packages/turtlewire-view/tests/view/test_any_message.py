"""Whatever a message holds, each display answers with what can be sent, and one line."""

from __future__ import annotations

import json
import re

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from tests.needs import only_first_is_fast

from turtlewire import msg
from turtlewire_view.displays import display_for, display_types, displays_of
from turtlewire_view.displays.content import Content, Removal, Status
from turtlewire_view.displays.options import OptionError, option_table

SEQUENCE = re.compile(r"sequence<([^,>]+)(?:, *\d+)?>|([^\[]+)\[(\d+)\]")
INTEGERS = re.compile(r"(u?)int(8|16|32|64)")
TEXTS = st.sampled_from(
    ["", "map", "<img src=x onerror=alert(1)>", "\x1b[2J", "a/b", "\ud800x"[1:]]
)
NUMBERS = st.one_of(
    st.sampled_from([float("nan"), float("inf"), -float("inf"), 0.0, -1.0, 1e300, 1e-300, 5e6]),
    st.floats(-10, 10),
)


def numbers_of_32_bits():
    return st.one_of(
        st.sampled_from([float("nan"), float("inf"), -float("inf"), 0.0, -1.0, 3e38]),
        st.floats(-10, 10, width=32),
    )


def value(kind: str):
    """A strategy for one field."""
    listed = SEQUENCE.fullmatch(kind)
    if listed is not None:
        element, fixed, size = listed.groups()
        if fixed is not None:
            return st.lists(value(fixed), min_size=int(size), max_size=int(size))
        is_large = element.startswith("visualization_msgs/Interactive")
        return st.lists(value(element), max_size=1 if is_large else 8)
    whole = INTEGERS.fullmatch(kind)
    if kind in {"octet", "byte", "char"} or whole is not None:
        bits = int(whole[2]) if whole else 8
        low = -(2 ** (bits - 1)) if whole and not whole[1] else 0
        high = 2**bits - 1 + low if low else 2**bits - 1
        return st.one_of(st.integers(max(low, -1), min(high, 12)), st.integers(low, high))
    if kind == "boolean":
        return st.booleans()
    if kind.startswith("string"):
        return TEXTS
    if kind in {"float", "double"}:
        return numbers_of_32_bits() if kind == "float" else NUMBERS
    package, _, name = kind.partition("/")
    return messages(f"{package}/msg/{name}")


def messages(type_name: str):
    """A strategy for messages of a type, as they come out of the decoder."""
    cls = msg.get_message(type_name)
    fields = {name: value(kind) for name, kind in cls.get_fields_and_field_types().items()}
    return st.builds(cls, **fields).map(lambda each: msg.deserialize(cls, msg.serialize(each)))


DISPLAYS = display_types()
SENT = {"f4", "u1", "u2", "u4", "i4", "i1"}
ANY_OPTION = st.one_of(
    st.none(), st.booleans(), st.floats(), st.integers(), st.text(max_size=3), st.just([1e999, "x"])
)


def options_of(kind):
    """A strategy for options: valid choices, and anything."""
    table = option_table(kind)
    own = [st.tuples(st.just(name), st.sampled_from(each.choices or (each.value,)))
           for name, each in table.items()]  # fmt: skip
    pairs = st.one_of(*own, st.tuples(st.sampled_from([*table, "none"]), ANY_OPTION))
    return st.lists(pairs, max_size=4).map(dict)


def check(outputs) -> None:
    assert isinstance(outputs[-1], Status)
    assert "\n" not in outputs[-1].text
    assert outputs[-1].text.isprintable()
    for output in outputs[:-1]:
        assert isinstance(output, (Content, Removal))
        if isinstance(output, Content):
            json.dumps([output.header, output.anchor], allow_nan=False)
            for array in output.arrays.values():
                assert array.dtype.str.lstrip("<|") in SENT
                assert np.isfinite(array).all()
            assert output.frame_id != ""


@pytest.mark.parametrize("type_name", [*DISPLAYS, "map_msgs/msg/OccupancyGridUpdate"])
def test_any_message_gets_an_answer(type_name):
    shown_by = DISPLAYS.get(type_name, DISPLAYS["nav_msgs/msg/OccupancyGrid"])

    @settings(deadline=None, max_examples=40, suppress_health_check=[HealthCheck.data_too_large])
    @given(st.lists(messages(type_name), min_size=1, max_size=3), options_of(shown_by.kind))
    def law(sent, options):
        try:
            display = shown_by(options)
        except OptionError:
            display = shown_by()
        display.budget = 5
        is_robot = shown_by.kind == "robot_model"
        is_silent = is_robot and display.options.text("source") != "topic"
        for message in sent:
            outputs = display.content(message)
            assert bool(outputs) != is_silent
            if outputs:
                check(outputs)

    law()


@pytest.mark.parametrize("kind", only_first_is_fast("camera", "depth_cloud"))
def test_any_messages_of_several_topics_get_answers(kind):
    of_kind = displays_of(kind)
    display_type = of_kind["sensor_msgs/msg/Image"]
    topics = {"/eye/depth": "sensor_msgs/msg/Image", "/color": "sensor_msgs/msg/Image",
              "/eye/camera_info": "sensor_msgs/msg/CameraInfo"}  # fmt: skip
    any_topic = st.sampled_from([*topics]).flatmap(
        lambda topic: st.tuples(st.just(topic), messages(topics[topic]))
    )

    @settings(deadline=None, max_examples=60)
    @given(st.lists(any_topic, min_size=2, max_size=5), st.sampled_from(["16UC1", "32FC1"]))
    def law(sent, encoding):
        display = display_type({"color_topic": "/color"} if kind == "depth_cloud" else {})
        display.topic, display.budget = "/eye/depth", 5
        for topic, message in sent:
            if topic == "/eye/depth":
                message.encoding = encoding
            if topic == "/color" and kind == "camera":
                continue
            outputs = display.take(topic, message)
            if outputs:
                check(outputs)

    law()


def test_only_descriptions_among_strings_are_robots():
    assert display_for("/robot_description", "std_msgs/msg/String").kind == "robot_model"
    assert display_for("/arm/robot_description", "std_msgs/msg/String") is not None
    assert display_for("/chatter", "std_msgs/msg/String") is None
    assert display_for("/scan", "sensor_msgs/msg/LaserScan").kind == "laser_scan"
    assert display_for("/x", "std_msgs/msg/Bool") is None
