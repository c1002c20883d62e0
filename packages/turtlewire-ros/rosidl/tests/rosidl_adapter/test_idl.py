"""Interfaces as IDL: the text, and that another parser reads the same types out of it."""

import json
import math
import pathlib
import re

import pytest
from mcap_ros2._vendor.rosidl_adapter import parser as upstream
from rosbags.typesys import get_types_from_idl, get_types_from_msg

from ros2cli.main import main as ros2
from rosidl_adapter import convert_to_idl, idl, parser
from rosidl_adapter.cli import (
    TranslateActionToIDL,
    TranslateMsgToIDL,
    TranslateSrvToIDL,
    TranslateToIDL,
    convert_files_to_idl,
)
from rosidl_adapter.main import main
from rosidl_adapter.msg import convert_msg_to_idl
from turtlewire import msg
from turtlewire.msg.parser import parse_message
from turtlewire.msg.registry import interface_text

STAMPED = """# Where and when.
builtin_interfaces/Time stamp

# Of what.
string frame_id
"""

STAMPED_IDL = """// generated from rosidl_adapter/resource/msg.idl.em
// with input from probes/msg/Stamped.msg
// generated code does not contain a copyright notice

#include "builtin_interfaces/msg/Time.idl"

module probes {
  module msg {
    @verbatim (language="comment", text=
      "Where and when.")
    struct Stamped {
      builtin_interfaces::msg::Time stamp;

      @verbatim (language="comment", text=
        "Of what.")
      string frame_id;
    };
  };
};
"""

PROBE = """# What a probe measured.
#
# Twice.

# How far [m]
float64 distance 1.5
  # from the wall
byte OK=0  # all is well
string NAME="say \\"hi\\""
float32[3] gains [1.0, 2.0, 3.0]
geometry_msgs/Point[<=2] corners
string<=5 label
"""

PROBE_IDL = """// generated from rosidl_adapter/resource/msg.idl.em
// with input from probes/msg/Probe.msg
// generated code does not contain a copyright notice

#include "geometry_msgs/msg/Point.idl"

module probes {
  module msg {
    typedef float float__3[3];
    module Probe_Constants {
      @verbatim (language="comment", text=
        "all is well")
      const octet OK = 0;
      const string NAME = "say \\"hi\\"";
    };
    @verbatim (language="comment", text=
      "What a probe measured." "\\n"
      "" "\\n"
      "Twice.")
    struct Probe {
      @verbatim (language="comment", text=
        "How far" "\\n"
        "from the wall")
      @default (value=1.5)
      @unit (value="m")
      double distance;

      @default (value="(1.0, 2.0, 3.0)")
      float__3 gains;

      sequence<geometry_msgs::msg::Point, 2> corners;

      string<5> label;
    };
  };
};
"""


def converted(folder, package, path, text):
    file = folder / path
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text)
    return convert_to_idl(folder, package, pathlib.Path(path), folder / "idl").read_text()


def all_interfaces(*kinds):
    return [
        f"{package}/{kind}/{name}"
        for package, of in msg.interfaces().items()
        for kind in kinds
        for name in of[kind]
    ]


def source(name):
    return interface_text(name)


def read_by_rosbags(text):
    """What the parser of rosbags finds; it does not know `#include`."""
    lines = text.splitlines(keepends=True)
    return get_types_from_idl("".join(line for line in lines if not line.startswith("#include")))


def test_the_text_of_messages(tmp_path, capsys):
    assert converted(tmp_path, "probes", "msg/Stamped.msg", STAMPED) == STAMPED_IDL
    assert converted(tmp_path, "probes", "msg/Probe.msg", PROBE) == PROBE_IDL
    assert capsys.readouterr().out.startswith(f"Reading input file: {tmp_path}/msg/Stamped.msg\n")


def test_services_actions_and_nothing(tmp_path):
    service = converted(tmp_path, "p", "srv/Empty.srv", "---\n")
    assert service.count("uint8 structure_needs_at_least_one_member;") == 2
    assert "    struct Empty_Request {\n" in service
    action = converted(tmp_path, "p", "action/Go.action", "int8 a\n---\n---\nbool[2] b\n")
    for part in ("Goal", "Result", "Feedback"):
        assert f"    struct Go_{part} {{\n" in action
    assert "    typedef boolean boolean__2[2];\n" in action


@pytest.mark.parametrize("name", all_interfaces("msg"))
def test_rosbags_reads_the_same_types(tmp_path, name):
    package, _, short = name.split("/")
    text = source(name)
    made = read_by_rosbags(converted(tmp_path, package, f"msg/{short}.msg", text))
    wanted = get_types_from_msg(text, name)
    fields = made[name][1]
    if not wanted[name][1]:
        assert [field for field, _ in fields] == ["structure_needs_at_least_one_member"]
    else:  # `.msg` has two names for uint8, and rosbags takes wstring for a message there
        there = repr(wanted[name][1]).replace("'char'", "'uint8'")
        there = re.sub(r"<Nodetype.NAME: 2>, '\w+/msg/wstring'", "<wide>", there)
        assert repr(fields).replace("<Nodetype.BASE: 1>, ('wstring', 0)", "<wide>") == there
    assert [each[0] for each in made[name][0]] == [each[0] for each in wanted[name][0]]


@pytest.mark.parametrize("name", all_interfaces("msg"))
def test_the_parser_finds_what_upstreams_finds(name):
    package, _, short = name.split("/")
    ours = parser.parse_message_string(package, short, source(name))
    assert ours == parser.parse_message_string(package, short, source(name))
    theirs = upstream.parse_message_string(package, short, source(name))
    for mine, other in zip(
        (ours, *ours.fields, *ours.constants),
        (theirs, *theirs.fields, *theirs.constants),
        strict=True,
    ):
        assert mine.annotations.get("comment") == (other.annotations.get("comment") or [])
        assert mine.annotations.get("unit") == other.annotations.get("unit")
    for mine, other in zip(ours.fields, theirs.fields, strict=True):
        assert (mine.name, str(mine.type)) == (other.name, str(other.type))
        assert mine.default_value == other.default_value
    for mine, other in zip(ours.constants, theirs.constants, strict=True):
        assert (mine.name, mine.type) == (other.name, other.type)
        assert mine.value == other.value or math.isnan(mine.value)


def test_services_and_actions_of_all_packages(tmp_path):
    for name in all_interfaces("srv", "action"):
        package, kind, short = name.split("/")
        text = converted(tmp_path, package, f"{kind}/{short}.{kind}", source(name))
        assert read_by_rosbags(text)


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("int32", parser.InvalidFieldDefinition),
        ("int32 Upper", NameError),
        ("int32 a twelve", parser.InvalidValue),
        ("int8 A=300", parser.InvalidValue),
        ("nothing x", parser.InvalidResourceName),
        ("No-package/Part x", parser.InvalidResourceName),
        ("int32 a\nint32 a", ValueError),
        ("int32[0] a", TypeError),
    ],
)
def test_mistakes_raise_clear_errors(text, error):
    with pytest.raises(error):
        parser.parse_message_string("p", "Message", text)


def test_specifications_are_equal_if_their_names_types_and_values_are():
    texts = ["int8 a 1", "int8 a 2", "int8 a", "int8 b", "uint8 a", "int8 A=1", "int8 A=2"]
    specs = [parser.parse_message_string("p", "M", text) for text in texts]
    specs += [parser.parse_message_string(*name, "int8 a") for name in (("p", "N"), ("q", "M"))]
    assert all([one == other for other in specs].count(True) == 1 for one in specs)


def test_an_indented_comment_belongs_to_what_is_above():
    text = "# the message\n\n  # of nothing\nint8 a  # of a\n  # as well\n"
    (ours,) = parser.parse_message_string("p", "M", text).fields
    (theirs,) = upstream.parse_message_string("p", "M", text).fields
    assert ours.annotations["comment"] == theirs.annotations["comment"] == ["of a", "as well"]


def test_separators_count():
    with pytest.raises(parser.InvalidServiceSpecification, match="'---'"):
        parser.parse_service_string("p", "S", "int8 a\n")
    with pytest.raises(parser.InvalidActionSpecification, match="'---'"):
        parser.parse_action_string("p", "A", "int8 a\n---\n")


def test_unknown_messages_are_named():
    spec = parser.parse_service_string("p", "S", "Part a\n---\nother/Thing b\n")
    known = [parser.BaseType("p/Part"), parser.BaseType("other/Thing")]
    parser.validate_field_types(spec, known)
    with pytest.raises(parser.UnknownMessageType, match="other/Thing b"):
        parser.validate_field_types(spec, known[:1])


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("float64[9]", "double__9"),
        ("geometry_msgs/Point[2]", "geometry_msgs__msg__Point__2"),
        ("Part[]", "sequence<p::msg::Part>"),
        ("wstring<=7[<=3]", "sequence<wstring<7>, 3>"),
        ("char", "uint8"),
    ],
)
def test_types(text, expected):
    assert idl.get_idl_type(parser.Type(text, "p")) == expected


def test_the_commands(tmp_path, monkeypatch, capsys):
    with pytest.raises(SystemExit):
        main([])
    required = "required: --package-name, --arguments-file, --output-dir, --output-file\n"
    assert capsys.readouterr().err.endswith(required)
    package = tmp_path / "src"
    (package / "msg").mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>probes</name></package>")
    (package / "msg" / "Probe.msg").write_text(PROBE)
    arguments = tmp_path / "arguments.json"
    arguments.write_text(json.dumps({"non_idl_tuples": [f"{package}:msg/Probe.msg"]}))
    words = ["--package-name", "probes", "--arguments-file", str(arguments)]
    main([*words, "--output-dir", str(tmp_path / "out"), "--output-file", str(tmp_path / "list")])
    assert (tmp_path / "list").read_text() == f"{tmp_path.as_posix()}/out:msg/Probe.idl\n"
    assert (tmp_path / "out" / "msg" / "Probe.idl").read_text() == PROBE_IDL
    monkeypatch.chdir(package)
    assert convert_files_to_idl(".msg", convert_msg_to_idl, ["msg/Probe.msg"]) is None
    assert (package / "msg" / "Probe.idl").read_text() == PROBE_IDL
    outside = tmp_path / "Lonely.msg"
    outside.write_text("")
    assert "no package.xml" in convert_files_to_idl(".msg", convert_msg_to_idl, [str(outside)])


def test_files_of_a_package_are_translated(tmp_path, monkeypatch, capsys):
    texts = {"msg/A": "bool x", "srv/B": "---", "action/C": "---\n---"}
    for path, text in texts.items():
        kind = path.partition("/")[0]
        file = tmp_path / "package" / f"{path}.{kind}"
        file.parent.mkdir(parents=True)
        file.write_text(text)
    monkeypatch.chdir(tmp_path / "package")
    (field,) = parser.parse_message_file("probe", "msg/A.msg").fields
    assert str(field) == "bool x"
    assert parser.parse_service_file("probe", "srv/B.srv").srv_name == "B"
    assert parser.parse_action_file("probe", "action/C.action").action_name == "C"
    out = tmp_path / "out"
    for cls, path in zip(
        (TranslateMsgToIDL, TranslateSrvToIDL, TranslateActionToIDL), texts, strict=True
    ):
        file = f"{path}.{cls.input_format}"
        for given in (file, f"{tmp_path / 'package'}:{file}"):
            assert cls("probe2idl").translate("probe", [given], [], out) == [f"{out}:{path}.idl"]
        assert (out / f"{path}.idl").read_text().count("struct")
        assert (cls.output_format, cls("msg2idl").name) == ("idl", "msg2idl")
    with pytest.raises(ValueError, match=r"does not end in '\.msg'"):
        TranslateMsgToIDL("probe2idl").translate("probe", ["srv/B.srv"], [], out)
    with pytest.raises(NotImplementedError):
        TranslateToIDL("probe2idl").translate("probe", ["srv/B.srv"], [], out)


# The start of comments: the engine's parser, `rosidl_adapter` and `interface show` agree.

COMMENTED = [
    ('"x # y"', "x # y", ""),
    ("'x # y'  # said", "x # y", "said"),
    ('"x" # "y"', "x", '"y"'),
    ("x # y", "x", "y"),
    ("don't # can't", "don't", "can't"),
    (r'"a \" # b" # c', 'a " # b', "c"),
]


@pytest.mark.parametrize(("text", "value", "comment"), COMMENTED)
def test_readers_agree_on_constants(text, value, comment):
    line = f"string NAME={text}"
    (constant,) = parse_message("p/msg/Said", line).constants
    (adapted,) = parser.parse_message_string("p", "Said", line).constants
    assert constant.value == adapted.value == value
    assert " ".join(adapted.annotations["comment"]).strip() == comment


def test_readers_agree_on_defaults():
    line = "string[] names ['a # b', \"c\"]  # two"
    (field,) = parse_message("p/msg/Said", line).fields
    (adapted,) = parser.parse_message_string("p", "Said", line).fields
    assert list(field.default) == list(adapted.default_value) == ["a # b", "c"]


def test_show_keeps_what_is_quoted(tmp_path, monkeypatch, capsys):
    folder = tmp_path / "share" / "p_quoted" / "msg"
    folder.mkdir(parents=True)
    (folder / "Said.msg").write_text('string NAME="x # y"  # said\n')
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    assert ros2(["interface", "show", "--no-comments", "p_quoted/msg/Said"]) == 0
    assert capsys.readouterr().out == 'string NAME="x # y"\n'
