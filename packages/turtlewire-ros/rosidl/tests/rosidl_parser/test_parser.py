"""Files in IDL as objects, as generators and documentation tools of others read them."""

from pathlib import Path

import pytest

from rosidl_adapter.idl import interface_to_idl
from rosidl_parser.definition import (
    Action,
    Array,
    BasicType,
    BoundedSequence,
    BoundedString,
    BoundedWString,
    IdlLocator,
    Include,
    Message,
    NamespacedType,
    Service,
    UnboundedSequence,
    UnboundedString,
)
from rosidl_parser.parser import parse_idl_file, parse_idl_string
from rosidl_runtime_py.utilities import get_interface
from turtlewire.errors import InterfaceError
from turtlewire.msg import interfaces
from turtlewire.msg.registry import interface_text

SHAPE = r"""
// a comment
#include "geometry_msgs/msg/Point.idl"
#include <std_msgs/msg/Header.idl>
module shapes {
  module msg {
    typedef string name_t;
    typedef name_t names_t[3];
    module Shape_Constants {
      @verbatim (language="comment", text="how" "\n" "round")
      const octet ROUND = 0x1f;
      const string NAME = "a \"b\"\t\x41\101";
      const wstring WIDE = L"\u00e9";
      const long long LOW = -5;
      const boolean YES = TRUE;
      const double HALF = .5e0;
      const char LETTER = 'x';
    };
    @verbatim (language="comment", text="A shape.\nTwo lines.")
    @verbatim (language="rosidl_array_init", text="no comment")
    @transfer_mode(SHMEM_REF) @final
    struct Shape {
      @default (value=TRUE)
      @key
      boolean big;
      @unit (value="m")
      unsigned long long width, height;
      names_t names;
      sequence<geometry_msgs::msg::Point, 4> points;
      sequence<string<8>> words;
      wstring<5> wide;
      long double much;
    };
  };
};
"""


def test_a_message_with_all_that_there_is():
    content = parse_idl_string(SHAPE)
    includes = [include.locator for include in content.get_elements_of_type(Include)]
    assert includes == ["geometry_msgs/msg/Point.idl", "std_msgs/msg/Header.idl"]
    (message,) = content.get_elements_of_type(Message)
    shape = message.structure
    assert shape.namespaced_type == NamespacedType(("shapes", "msg"), "Shape")
    assert shape.get_comment_lines() == ["A shape.", "Two lines."]
    assert shape.get_annotation_value("final") is None
    assert shape.get_annotation_value("transfer_mode") == "SHMEM_REF"
    members = {member.name: member for member in shape.members}
    assert {name: member.type for name, member in members.items()} == {
        "big": BasicType("boolean"),
        "width": BasicType("uint64"),
        "height": BasicType("uint64"),
        "names": Array(UnboundedString(), 3),
        "points": BoundedSequence(NamespacedType(("geometry_msgs", "msg"), "Point"), 4),
        "words": UnboundedSequence(BoundedString(8)),
        "wide": BoundedWString(5),
        "much": BasicType("long double"),
    }
    assert members["big"].get_annotation_value("default") == {"value": True}
    assert members["big"].has_annotation("key")
    assert members["height"].get_annotation_value("unit") == {"value": "m"}
    constants = {each.name: (each.type, each.value) for each in message.constants}
    assert constants == {
        "ROUND": (BasicType("octet"), 31),
        "NAME": (BoundedString(8), 'a "b"\tAA'),
        "WIDE": (BoundedWString(1), "é"),
        "LOW": (BasicType("int64"), -5),
        "YES": (BasicType("boolean"), True),
        "HALF": (BasicType("double"), 0.5),
        "LETTER": (BasicType("char"), "x"),
    }
    assert message.constants[0].get_comment_lines() == ["how", "round"]


def parsed(name):
    """The interface of a name, by way of its IDL."""
    package, kind, stem = name.split("/")
    text = interface_to_idl(package, Path(kind, f"{stem}.{kind}"), interface_text(name))
    return parse_idl_string(text).elements[-1]


def of_service(found, real):
    return [
        (found.request_message, real.Request),
        (found.response_message, real.Response),
        (found.event_message, real.Event),
    ]


def test_all_fields_have_the_types_that_classes_have():
    names = [
        f"{package}/{kind}/{name}"
        for package, kinds in interfaces().items()
        for kind in kinds
        for name in kinds[kind]
    ]
    assert len(names) >= 363
    checked = 0
    for name in names:
        found, real = parsed(name), get_interface(name)
        pairs = [(found, real)]
        if isinstance(found, Service):
            pairs = of_service(found, real)
        elif isinstance(found, Action):
            pairs = [
                (found.goal, real.Goal),
                (found.result, real.Result),
                (found.feedback, real.Feedback),
                (found.feedback_message, real.Impl.FeedbackMessage),
                *of_service(found.send_goal_service, real.Impl.SendGoalService),
                *of_service(found.get_result_service, real.Impl.GetResultService),
            ]
        for message, class_ in pairs:
            members = message.structure.members
            fields = {member.name: member.type for member in members}
            fields.pop("structure_needs_at_least_one_member", None)
            assert [*fields.values()] == [*class_.SLOT_TYPES], name
            assert [*fields] == [*class_.get_fields_and_field_types()]
            checked += 1
    assert checked >= 450


def test_an_action_brings_the_includes_that_it_needs():
    text = interface_to_idl("p", Path("action/Go.action"), "wstring a 'é'\n---\n---\n")
    content = parse_idl_string(text)
    assert [include.locator for include in content.get_elements_of_type(Include)] == [
        "builtin_interfaces/msg/Time.idl",
        "unique_identifier_msgs/msg/UUID.idl",
    ]
    (action,) = content.get_elements_of_type(Action)
    assert action.namespaced_type == NamespacedType(("p", "action"), "Go")
    (member,) = action.goal.structure.members
    assert (member.name, member.get_annotation_value("default")) == ("a", {"value": "é"})


def test_a_file_and_its_place(tmp_path, capsys):
    (tmp_path / "p/msg").mkdir(parents=True)
    path = tmp_path / "p/msg/A.idl"
    locator = IdlLocator(tmp_path, Path("p/msg/A.idl"))
    path.write_text(interface_to_idl("p", Path("msg/A.msg"), "bool b\n"))
    file = parse_idl_file(locator)
    assert file.locator is locator
    assert file.content.elements[0].structure.members[0].name == "b"
    path.write_text("module p {\n  struct A {\n    long a\n  };\n};\n")
    with pytest.raises(InterfaceError):
        parse_idl_file(locator)
    assert capsys.readouterr().err == f"idl, line 4: expected ';', got '}}' {path}\n"


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("", "expected the structures of one message, service or action, got none"),
        ("struct A { B b; };", "Unknown named type: B"),
        ("struct A { long b[0]; };", "'0' is not a size (a positive integer)"),
        ("struct A { sequence<long, 2.5> b; };", "'2.5' is not a size (a positive integer)"),
        ("enum A { B };", "'enum' is not read here"),
        ("const long A = 0x;", "expected a value, got '0x'"),
        ("struct A { long b; }; struct B { long b; };", "got A, B"),
        (
            "module p { struct A_Request { long b; }; }; struct A_Response { long b; };",
            "got A_Request, A_Response",
        ),
        ("struct A { long ; };", "expected a name, got ';'"),
        ("typedef long a[2]; struct A { a b[3]; };", "an array of arrays is not a valid field"),
        ("struct A { long b; ", "expected a name, got 'the end of the file'"),
        (
            "module A_Constants { const string B = 5; }; struct A { long a; };",
            "the value of 'B' is no text: 5",
        ),
        ("struct A { long $; };", "cannot read '$; };'"),
    ],
)
def test_errors_are_reported(text, error):
    with pytest.raises(InterfaceError) as caught:
        parse_idl_string(text)
    assert str(caught.value).endswith(error)
