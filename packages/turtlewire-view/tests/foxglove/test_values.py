"""Parameters as JSON, definitions, and differences of connections."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from turtlewire import msg
from turtlewire.errors import InterfaceError
from turtlewire.msg.parser import parse_message
from turtlewire_view.foxglove.connections import GraphConnections, difference
from turtlewire_view.foxglove.parameters import from_json, to_json
from turtlewire_view.foxglove.schemas import full_name, schema

floats = st.floats(allow_nan=True, allow_infinity=True)


values = st.one_of(
    st.booleans(),
    st.integers(-(2**63), 2**63 - 1),
    st.text(),
    floats,
    st.lists(st.booleans(), min_size=1),
    st.lists(st.integers(-(2**63), 2**63 - 1), min_size=1),
    st.lists(st.text(), min_size=1),
    st.lists(floats, min_size=1),
)


@given(values)
def test_a_parameter_comes_back_from_json_as_it_was(value):
    before = from_json(value, None, 0)
    shown = json.loads(json.dumps(to_json("/n.p", before), allow_nan=False))
    after = from_json(shown["value"], shown.get("type"), before.type)
    assert to_json("/n.p", after) == shown
    assert after.type == before.type


def test_numbers_of_javascript_take_the_type_that_the_parameter_has():
    assert from_json(2, None, 3).double_value == 2.0
    assert from_json(2, None, 2).integer_value == 2
    assert from_json(2, "float64", 0).type == 3
    assert list(from_json([1, 2.5], None, 7).double_array_value) == [1.0, 2.5]
    assert from_json([], None, 7).type == 7
    assert from_json([], "float64_array", 0).type == 8
    assert from_json(None, None, 3).type == 0
    assert to_json("/n.p", from_json(None, None, 3)) == {"name": "/n.p"}


@pytest.mark.parametrize(
    ("value", "type_name", "present_type", "reason"),
    [
        ({"a": 1}, None, 0, "a parameter must be a bool"),
        ([[1]], None, 0, "a parameter must be a bool"),
        ([1, "a"], None, 0, "the items of a list are of different types"),
        (2**63, None, 0, "does not fit into 64 bits"),
        (10**400, None, 3, "does not fit into 64 bits"),
        ("*", "byte_array", 0, "base64"),
        (7, "byte_array", 0, "base64"),
    ],
    ids=["object", "nested", "mixed", "integer", "double", "base64", "bytes"],
)
def test_values_that_no_parameter_can_have(value, type_name, present_type, reason):
    with pytest.raises(ValueError, match=reason):
        from_json(value, type_name, present_type)


def test_parts_of_services_and_actions_are_written_as_a_file_would_be():
    text = schema("rcl_interfaces/srv/ListParameters_Request")
    assert text == "uint64 DEPTH_RECURSIVE=0\nstring[] prefixes\nuint64 depth\n"
    text = schema("example_interfaces/action/Fibonacci_FeedbackMessage")
    head, *rest = text.split("\n" + 80 * "=" + "\n")
    assert head.startswith(
        "unique_identifier_msgs/UUID goal_id\nexample_interfaces/Fibonacci_Feedback"
    )
    assert any(
        part.startswith("MSG: example_interfaces/Fibonacci_Feedback\nint32[]") for part in rest
    )


def test_a_written_definition_means_what_was_parsed():
    """The text of a request is read back by the parser of .msg files."""
    names = msg.interfaces()
    for package, kinds in names.items():
        for name in kinds["srv"]:
            request = msg.get_service(f"{package}/srv/{name}").Request
            body = schema(f"{package}/srv/{name}_Request").split("\n" + 80 * "=")[0]
            parsed = parse_message(f"{package}/msg/X", body)
            wanted = [(field.name, str(field.type)) for field in request._DEFINITION.fields]
            assert [(field.name, str(field.type)) for field in parsed.fields] == wanted


def test_names_of_types():
    assert full_name("std_msgs/String") == full_name("std_msgs/msg/String") == "std_msgs/msg/String"
    for wrong in ("x", "", "a/b/c/d", "std_msgs/msg/Nothing", "a::b", "../x/y"):
        with pytest.raises(InterfaceError):
            schema(wrong)


def test_only_changes_are_sent():
    empty = GraphConnections({}, {}, {})
    now = GraphConnections({"/a": ["/n"]}, {"/a": ["/m"], "/b": ["/m"]}, {"/s": ["/n"]})
    told = difference(empty, now)
    assert told["publishedTopics"] == [{"name": "/a", "publisherIds": ["/n"]}]
    assert [each["name"] for each in told["subscribedTopics"]] == ["/a", "/b"]
    assert told["advertisedServices"] == [{"name": "/s", "providerIds": ["/n"]}]
    assert not any(difference(now, now).values())
    later = GraphConnections({}, {"/a": ["/m"]}, {})
    told = difference(now, later)
    assert told["publishedTopics"] == [{"name": "/a", "publisherIds": []}]
    assert (told["removedTopics"], told["removedServices"]) == (["/b"], ["/s"])
