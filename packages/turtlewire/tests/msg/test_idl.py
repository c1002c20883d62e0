"""Interfaces that are given as .idl files."""

from __future__ import annotations

import pytest
from rosbags.typesys import get_types_from_idl, get_types_from_msg

from turtlewire.errors import InterfaceError
from turtlewire.msg.idl import idl_to_text
from turtlewire.msg.parser import parse_action, parse_message, parse_service

SHAPE = """
#include "geometry_msgs/msg/Point.idl"
module shapes { module msg {
    typedef geometry_msgs::msg::Point corners__2[2];
    module Shape_Constants {
      const long MANY = -3;
      const string LABEL = "round";
    };
    @verbatim (language="comment", text="A shape\\n" "of two lines")
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
        "# of two lines\n"
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
