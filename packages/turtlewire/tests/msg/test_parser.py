"""The grammar of interface files.

Interfaces that are given as .idl files.
"""

import pytest
from rosbags.typesys import get_types_from_idl, get_types_from_msg

from turtlewire.errors import InterfaceError
from turtlewire.msg.idl import idl_to_text
from turtlewire.msg.parser import parse_action, parse_message, parse_service
from turtlewire.msg.types import (
    Array,
    BasicType,
    BoundedSequence,
    BoundedString,
    BoundedWString,
    NamespacedType,
    UnboundedSequence,
    UnboundedString,
    UnboundedWString,
)


def _field(line, name="X"):
    (field,) = parse_message(f"demo_interfaces/msg/{name}", line).fields
    return field


@pytest.mark.parametrize(
    ("text", "type_"),
    [
        ("bool", BasicType("boolean")),
        ("byte", BasicType("octet")),
        ("char", BasicType("uint8")),
        ("float32", BasicType("float")),
        ("float64", BasicType("double")),
        *[
            (f"{sign}int{bits}", BasicType(f"{sign}int{bits}"))
            for sign in ("", "u")
            for bits in (8, 16, 32, 64)
        ],
        ("string", UnboundedString()),
        ("wstring", UnboundedWString()),
        ("string<=10", BoundedString(10)),
        ("wstring<=10", BoundedWString(10)),
        ("int32[]", UnboundedSequence(BasicType("int32"))),
        ("int32[5]", Array(BasicType("int32"), 5)),
        ("int32[<=5]", BoundedSequence(BasicType("int32"), 5)),
        ("string<=4[<=3]", BoundedSequence(BoundedString(4), 3)),
        ("string<=4[]", UnboundedSequence(BoundedString(4))),
        ("wstring<=4[<=3]", BoundedSequence(BoundedWString(4), 3)),
        ("wstring<=4[]", BoundedSequence(BoundedWString(4), 4)),  # as in ROS 2
        ("Sphere", NamespacedType(("demo_interfaces", "msg"), "Sphere")),
        ("geometry_msgs/Point[2]", Array(NamespacedType(("geometry_msgs", "msg"), "Point"), 2)),
        ("geometry_msgs/msg/Point", NamespacedType(("geometry_msgs", "msg"), "Point")),
    ],
)
def test_types(text, type_):
    assert _field(f"{text} value").type == type_


@pytest.mark.parametrize(
    ("line", "default"),
    [
        ("int32 x", None),
        ("int32 x -5  # a comment", -5),
        ("uint8 x 0xff", 255),
        ("float64 x 1", 1.0),
        ("bool x true", True),
        ("bool x False", False),
        ("byte x 7", b"\x07"),
        ("char x 65", 65),
        ("string x plain words", "plain words"),
        ('string x "with # and \\" and \\n"', 'with # and " and \n'),
        (r'string x "C:\dir"', r"C:\dir"),
        ("int32 x 010", 10),
        ("int32 x -007", -7),
        ("string x 'it\"s'", 'it"s'),
        ("wstring x 'ä'", "ä"),
        ("int32[] x [1, 2, 3]", [1, 2, 3]),
        ("int32[] x []", []),
        ('string[2] x ["a, b", "c"]', ["a, b", "c"]),
        ("float32[<=3] x [1.5]", [1.5]),
        ("int32[<=2] x [1, 2]", [1, 2]),
        ("string<=3 x 'abc'", "abc"),
        ("wstring<=1 x 'ä'", "ä"),
        ("string<=2 x 'ä'", "ä"),
        ("\tint32\tx\t3", 3),
        ("int32   x   3", 3),
    ],
)
def test_defaults(line, default):
    field = _field(line)
    assert field.name == "x"
    assert field.default == default
    assert type(field.default) is type(default)


@pytest.mark.parametrize("bits", [8, 16, 32, 64])
def test_integers_reach_from_their_least_to_their_greatest_value(bits):
    half = 2 ** (bits - 1)
    for type_, least, greatest in (
        (f"int{bits}", -half, half - 1),
        (f"uint{bits}", 0, 2**bits - 1),
    ):
        for value in (least, greatest):
            assert _field(f"{type_} x {value}").default == value
        for value in (least - 1, greatest + 1):
            with pytest.raises(InterfaceError, match=f"{value} is outside of {type_} "):
                _field(f"{type_} x {value}")


def test_constants():
    text = (
        'int32 LIMIT=12\nstring NAME = "a=b" # why\nfloat32 A_1=-0.5\nbyte OK=0\n'
        "bool YES=true\nuint8 x\n"
    )
    definition = parse_message("demo_interfaces/msg/X", text)
    assert {constant.name: constant.value for constant in definition.constants} == {
        "LIMIT": 12,
        "NAME": "a=b",
        "A_1": -0.5,
        "OK": b"\x00",
        "YES": True,
    }
    assert [field.name for field in definition.fields] == ["x"]


def test_services_and_actions_have_parts():
    service = parse_service("demo_interfaces/srv/Add", "int64 a\n---\nint64 LIMIT=3\nint64 sum\n")
    assert [field.name for field in service.request.fields] == ["a"]
    assert [field.name for field in service.response.fields] == ["sum"]
    assert service.response.constants[0].value == 3
    action = parse_action("demo_interfaces/action/Go", "---\nbool done\n---\nPoint where")
    assert [len(part.fields) for part in (action.goal, action.result, action.feedback)] == [0, 1, 1]
    assert action.feedback.fields[0].type == NamespacedType(("demo_interfaces", "msg"), "Point")


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        ("int33 x", "'int33' is not a type"),
        ("int8<=5 x", "'int8<=5' is not a type"),
        ("Ärger x", "'Ärger' is not a type"),
        ("int32", "'' is not a valid field name"),
        ("int32 Name", "'Name' is not a valid field name"),
        ("int32 a__b", "'a__b' is not a valid field name"),
        ("int32 a_", "'a_' is not a valid field name"),
        ("int32 _a", "'_a' is not a valid field name"),
        ("int32 lower=3", "'lower' is not a valid constant name"),
        ("int32[-1] x", "'-1' is not a size"),
        ("int32[0] x", "'0' is not a size"),
        ("string<=x y", "'x' is not a size"),
        ("int8 x 200", "200 is outside of int8 (-128 to 127)"),
        ("int8 x abc", "invalid literal for int()"),
        ("float32 x abc", "could not convert string to float: 'abc'"),
        ("bool x maybe", "'maybe' is not a bool"),
        ("string<=2 x 'abc'", "'abc' is longer than string<2>"),
        ("string<=1 x 'ä'", "'ä' is longer than string<1>"),
        ("int32[] x 3", "'3' is not a list of values"),
        ("int32[2] x [1]", "1 values do not fit int32[2]"),
        ("int32[<=2] x [1, 2, 3]", "3 values do not fit sequence<int32, 2>"),
        ("int32 from", "'from' is a keyword of Python, and so cannot be a field name"),
        ("Point x 3", "demo_interfaces/Point cannot have a value"),
        ("a/b/c/D x", "'a/b/c/D' is not a type"),
        ("../Point x", "'../Point' is not a type"),
    ],
)
def test_mistakes_are_named_with_their_line(line, reason):
    with pytest.raises(InterfaceError) as caught:
        parse_message("demo_interfaces/msg/X", f"# first\n{line}")
    assert str(caught.value).startswith(f"demo_interfaces/msg/X, line 2: {reason}")


def test_lines_of_later_parts_are_counted_from_the_top():
    with pytest.raises(
        InterfaceError, match="demo_interfaces/action/Go_Feedback, line 6: 'oops' is not a type"
    ):
        parse_action("demo_interfaces/action/Go", "int32 a\n---\n\nint32 b\n---\noops x\n")


def test_names_and_parts_are_checked():
    with pytest.raises(InterfaceError, match="the name 'x' is used twice"):
        parse_message("demo_interfaces/msg/X", "int32 x\nint8 x")
    with pytest.raises(InterfaceError, match="the name 'X' is used twice"):
        parse_message("demo_interfaces/msg/X", "int32 X=1\nint32 X=2")
    with pytest.raises(InterfaceError, match="'point' is not a valid interface name"):
        parse_message("demo_interfaces/msg/point", "")
    with pytest.raises(InterfaceError, match="found 0 lines with '---', expected 1"):
        parse_service("demo_interfaces/srv/X", "int32 x")
    with pytest.raises(InterfaceError, match="found 3 lines with '---', expected 2"):
        parse_action("demo_interfaces/action/X", "---\n---\n---")


SHAPE = """
#include "geometry_msgs/msg/Point.idl"
module shapes { module msg {
    typedef geometry_msgs::msg::Point corners__2[2];
    module Shape_Constants {
      const long MANY = -3;
      const string LABEL = "round";
    };
    @verbatim (language="comment", text="A shape\\n" "of C:\\\\new")
    struct Shape {
      @default (value="none")
      string name;
      @default (value=1.5) @unit (value="m")
      double size;
      @default (value="[1, 2]")
      sequence<short> counts;
      boolean solid, hollow;
      sequence<wstring<3>, 4> words;
      corners__2 ends;
      unsigned long long many;  /* a
                                   comment */
      octet raw;
      Shape_Other other;
    };
    struct Shape_Other { uint8 structure_needs_at_least_one_member; };
}; };
"""


def test_a_message():
    assert idl_to_text("shapes/msg/Shape", SHAPE) == (
        "# A shape\n"
        "# of C:\\new\n"
        "int32 MANY = -3\n"
        'string LABEL = "round"\n'
        'string name "none"\n'
        "float64 size 1.5\n"
        "int16[] counts [1, 2]\n"
        "bool solid\n"
        "bool hollow\n"
        "wstring<=3[<=4] words\n"
        "geometry_msgs/Point[2] ends\n"
        "uint64 many\n"
        "byte raw\n"
        "Shape_Other other\n"
    )


def test_services_and_actions():
    text = "module p { module srv { struct S_Request { float a; }; struct S_Response { %s }; }; };"
    dummy = "uint8 structure_needs_at_least_one_member;"
    assert idl_to_text("p/srv/S", text % dummy) == "float32 a\n---\n"
    parse_service("p/srv/S", idl_to_text("p/srv/S", text % dummy))
    action = (
        "module p { module action { module A_Goal_Constants { const octet X = 1; };"
        "struct A_Goal { long a; }; struct A_Result { long b; }; struct A_Feedback { long c; };"
        "}; };"
    )
    assert idl_to_text("p/action/A", action) == "byte X = 1\nint32 a\n---\nint32 b\n---\nint32 c\n"
    assert parse_action("p/action/A", idl_to_text("p/action/A", action)).goal.constants[0].value


def test_as_rosbags_reads_it():
    """An independent reader of IDL finds the same fields as a reader of our text."""
    text = SHAPE.partition("\n#include")[2].partition("\n")[2]
    for known_to_us_alone, known_to_both in {
        "      Shape_Other other;\n": "",
        "wstring<3>": "string<3>",
        "boolean solid, hollow": "boolean solid; boolean hollow",
        ' @unit (value="m")': "",
    }.items():
        text = text.replace(known_to_us_alone, known_to_both)
    ours = idl_to_text("shapes/msg/Shape", text)
    parse_message("shapes/msg/Shape", ours)
    without_defaults = "\n".join(" ".join(line.split()[:2]) for line in ours.splitlines()[4:])
    theirs = get_types_from_idl(text)["shapes/msg/Shape"][1]
    assert get_types_from_msg(without_defaults, "shapes/msg/Shape")["shapes/msg/Shape"][1] == theirs


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("module p {\nmodule msg { union A {}; }; };", "line 2: 'union' has no counterpart"),
        ("module p {\n\nenum A { B };};", "line 3: 'enum' has no counterpart"),
        ("struct A { long a };", "line 1: expected ';', got '}'"),
        ("struct A {\nlong a", "line 2: expected ';', got 'the end of the file'"),
        ("struct A { map<long, long> a; };", "line 1: 'map' has no counterpart"),
        ("struct A { char a; };", "line 1: 'char' has no counterpart"),
        ("struct A { sequence<sequence<long>> a; };", "a sequence of sequences has no"),
        ("struct A { long a[2][3]; };", "an array of arrays has no counterpart"),
        ("struct A {\n@default (value 1) long a; };", "line 2: expected ')', got '1'"),
        ("struct A {\nlong a[0]; };", "line 2: '0' is not a size (a positive integer)"),
        ("struct A { ? };", "line 1: cannot read '? };'"),
        ("struct B { long a; };", "p/msg/A.idl has no struct A"),
    ],
)
def test_idl_beyond_msg_is_rejected_with_its_line(text, message):
    with pytest.raises(InterfaceError) as raised:
        idl_to_text("p/msg/A", text)
    assert message in str(raised.value)
    assert "p/msg/A.idl" in str(raised.value)
