from array import array

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rcl_interfaces.msg import Parameter as ParameterMsg
from rcl_interfaces.msg import ParameterType, ParameterValue
from rclpy.parameter import (
    Parameter,
    get_parameter_value,
    parameter_dict_from_yaml_file,
    parameter_value_to_python,
)
from turtlewire import msg

Type = Parameter.Type
VALUES = [
    (None, Type.NOT_SET),
    (True, Type.BOOL),
    (3, Type.INTEGER),
    (3.0, Type.DOUBLE),
    ("x", Type.STRING),
    ([b"a", b"b"], Type.BYTE_ARRAY),
    ([], Type.BYTE_ARRAY),
    ([True, False], Type.BOOL_ARRAY),
    ([1, 2], Type.INTEGER_ARRAY),
    ([1.0, 2.0], Type.DOUBLE_ARRAY),
    (["a", "b"], Type.STRING_ARRAY),
    ((1, 2), Type.INTEGER_ARRAY),
    (array("q", [1, 2]), Type.INTEGER_ARRAY),
    (array("d", [1.0]), Type.DOUBLE_ARRAY),
]


def test_the_numbers_are_those_of_the_message():
    for type_ in Type:
        assert getattr(ParameterType, f"PARAMETER_{type_.name}") == type_.value


@pytest.mark.parametrize(("value", "type_"), VALUES)
def test_types_are_found_and_messages_hold_them(value, type_):
    parameter = Parameter("p", value=value)
    assert (parameter.name, parameter.type_, parameter.value) == ("p", type_, value)
    wire = msg.deserialize(ParameterMsg, msg.serialize(parameter.to_parameter_msg()))
    back = Parameter.from_parameter_msg(wire)
    assert (back.name, back.type_) == ("p", type_)
    assert (back.value is None and value is None) or (
        list(back.value) == list(value) if hasattr(value, "__len__") else back.value == value
    )


@pytest.mark.parametrize(
    ("value", "text"),
    [
        ({1: 2}, "The given value is not one of the allowed types '{1: 2}'."),
        (b"x", "The given value is not one of the allowed types 'b'x''."),
        ([1, 2.0], "The given value is not a list of one of the allowed types '[1, 2.0]'."),
        ([None], "The given value is not a list of one of the allowed types '[None]'."),
    ],
)
def test_values_without_a_type(value, text):
    with pytest.raises(TypeError) as caught:
        Parameter("p", value=value)
    assert str(caught.value) == text


@given(st.sampled_from(list(Type)), st.sampled_from(VALUES))
def test_type_and_value_have_to_agree(type_, pair):
    value, found = pair
    empty = value == [] and type_.name.endswith("_ARRAY")
    int_like = (found is Type.BOOL and type_ is Type.INTEGER) or (
        found is Type.BOOL_ARRAY and type_ is Type.INTEGER_ARRAY
    )
    if type_ is found or empty or int_like:  # Python's bool is an int
        assert Parameter("p", type_, value).type_ is type_
    else:
        with pytest.raises(ValueError, match=r"^Type 'Type\.[A-Z_]+' and value '.*' do not agree$"):
            Parameter("p", type_, value)


def test_other_errors():
    with pytest.raises(
        TypeError,
        match=r"^type must be an instance of '<enum 'Parameter\.Type'>'$|^type must be an instance "
        r"of '<enum 'Type'>'$",
    ):
        Parameter("p", 4, "x")
    with pytest.raises(RuntimeError, match=r"^unexpected parameter type 99$"):
        parameter_value_to_python(ParameterValue(type=99))
    with pytest.raises(ValueError):
        Parameter.from_parameter_msg(ParameterMsg(value=ParameterValue(type=99)))


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("true", True),
        ("5", 5),
        ("5.5", 5.5),
        ("hello world", "hello world"),
        ("'5'", "5"),
        ("[1, 2]", [1, 2]),
        ("[1.0, 2.0]", [1.0, 2.0]),
        ("[a, b]", ["a", "b"]),
        ("[true]", [True]),
        ("[1, a]", "[1, a]"),
        ("{a: 1}", "{a: 1}"),
        ("null", "null"),
        ("", ""),
        ("2026-01-01", "2026-01-01"),
        ("[unclosed", "[unclosed"),
        ("2026-13-01", "2026-13-01"),
        ("[" * 50_000, "[" * 50_000),
    ],
)
def test_values_from_yaml(text, value):
    made = parameter_value_to_python(get_parameter_value(text))
    assert (list(made) if isinstance(value, list) else made) == value


FILE = """\
/**:
  ros__parameters: {shared: wild, only_wild: 1}
node:
  ros__parameters:
    shared: node
    a: {b: {c: '7'}}
/other:
  ros__parameters: {d: [1, 2]}
"""


@pytest.fixture
def parameter_file(tmp_path):
    path = tmp_path / "f.yaml"
    path.write_text(FILE)
    return str(path)


def as_python(messages):
    assert all(name == message.name for name, message in messages.items())
    return {name: parameter_value_to_python(message.value) for name, message in messages.items()}


def test_a_parameter_file(parameter_file):
    assert as_python(parameter_dict_from_yaml_file(parameter_file, target_nodes=["node"])) == {
        "shared": "node",
        "a.b.c": "7",
    }
    assert as_python(parameter_dict_from_yaml_file(parameter_file, True, ["node"], "ns.")) == {
        "ns.shared": "node",
        "ns.only_wild": 1,
        "ns.a.b.c": "7",
    }
    assert sorted(parameter_dict_from_yaml_file(parameter_file)) == ["a.b.c", "d", "shared"]


def test_bad_parameter_files(parameter_file, tmp_path):
    with pytest.raises(
        RuntimeError, match=r"^Param file does not contain parameters for nope,only for nodes: "
    ):
        parameter_dict_from_yaml_file(parameter_file, target_nodes=["nope"])
    for text, error in (
        ("/**: {ros__parameters: {}}", "Param file does not contain selected parameters"),
        ("node: {a: 1}", "YAML file is not a valid ROS parameter file for node node"),
        ("[1]", "YAML file is not a valid ROS parameter file"),
        ("", "YAML file is not a valid ROS parameter file"),
        ("[" * 50_000, r"YAML file is not a valid ROS parameter file: '.*' is nested too deeply$"),
        ("a: 2026-13-01", r"YAML file is not a valid ROS .* file: '.*': month must be in 1\.\.12"),
    ):
        path = tmp_path / "bad.yaml"
        path.write_text(text)
        with pytest.raises(RuntimeError, match=error):
            parameter_dict_from_yaml_file(str(path))
