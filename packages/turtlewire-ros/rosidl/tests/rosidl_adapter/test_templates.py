"""Templates of EmPy, and the steps of reading values."""

from pathlib import PurePath

import pytest
from mcap_ros2._vendor.rosidl_adapter import parser as upstream

from rosidl_adapter import action, msg, resource, srv
from rosidl_adapter.idl import interface_to_idl
from rosidl_adapter.parser import (
    find_matching_end_quote,
    parse_action_string,
    parse_message_string,
    parse_service_string,
    parse_string_array_value_string,
)
from rosidl_adapter.resource import evaluate_template, expand_template

TEXTS = {
    "msg": "# A comment.\nstring<=5 name\nint32[3] values\nint8 LOW=-1\n",
    "srv": "int64 a\n---\nint64 sum  # [m]\n",
    "action": "int32 order\n---\nint32[] sequence\n---\nfloat32 done\n",
}
PARSERS = {"msg": parse_message_string, "srv": parse_service_string, "action": parse_action_string}


@pytest.mark.parametrize("kind", TEXTS)
def test_the_templates_write_the_same_idl(kind, tmp_path):
    source = f"{kind}/Probe.{kind}"
    data = {
        "pkg_name": "probes",
        "relative_input_file": source,
        kind: PARSERS[kind]("probes", "Probe", TEXTS[kind]),
    }
    target = tmp_path / "new" / "Probe.idl"
    assert {"msg": msg, "srv": srv, "action": action}[kind].expand_template is expand_template
    expand_template(f"{kind}.idl.em", data, target)
    assert target.read_text() == interface_to_idl("probes", PurePath(source), TEXTS[kind])


def test_a_template_of_a_program(tmp_path):
    (tmp_path / "outer.em").write_text(
        "@[for name in names]@\nHello @name!@(TEMPLATE('inner.em', count=len(name)))\n@[end for]@\n"
    )
    (tmp_path / "inner.em").write_text(" @count letters: \u00e9, a@@b.")
    text = evaluate_template(str(tmp_path / "outer.em"), {"names": ["Ada", "Bo"]})
    assert text == "Hello Ada! 3 letters: \u00e9, a@b.\nHello Bo! 2 letters: \u00e9, a@b.\n"


def test_a_file_with_the_same_content_is_not_written(tmp_path):
    template, target = tmp_path / "t.em", tmp_path / "out.txt"
    template.write_text("@(1 + x)\n")
    expand_template(str(template), {"x": 1}, target)
    assert target.read_text() == "2\n"
    target.chmod(0o444)
    before = target.stat()
    expand_template(str(template), {"x": 1}, target)
    assert target.stat().st_mtime_ns == before.st_mtime_ns
    target.chmod(0o644)
    expand_template(str(template), {"x": 2}, target, encoding="utf-16")
    assert target.read_text(encoding="utf-16") == "3\n"


def test_an_error_in_a_template_is_raised(tmp_path, capsys):
    template = tmp_path / "wrong.em"
    template.write_text("@(nothing)")
    with pytest.raises(NameError, match="nothing"):
        evaluate_template(str(template), {})
    assert capsys.readouterr().out == ""


def test_without_empy_the_error_names_the_extra(monkeypatch):
    assert resource.em_has_configuration
    monkeypatch.setattr(resource, "em_has_configuration", False)
    with pytest.raises(ImportError, match=r"pip install 'turtlewire-ros\[grammars\]'"):
        evaluate_template("msg.idl.em", {})


@pytest.mark.parametrize(
    ("string", "quote"),
    [("'abc'", "'"), ('"a\'b"', '"'), (r"'it\'s' 'x'", "'"), ("''", "'"), ("'abc", "'")],
)
def test_the_end_of_a_quoted_text(string, quote):
    found = find_matching_end_quote(string, quote)
    assert found == upstream.find_matching_end_quote(string, quote)
    assert found == -1 or string[found + 1] == quote


@pytest.mark.parametrize(
    "string",
    [
        "",
        "a,b",
        "'a', \"b, c\", d",
        r"'it\'s'",
        "'a',",
        "'a' b",
        " a b , 'x'",
        "a,,b",
        ",a",
        "x, 'a",
    ],
)
def test_the_elements_of_a_list_of_strings(string):
    def outcome(function):
        try:
            return function(string, 2)
        except ValueError as error:
            return str(error)

    assert outcome(parse_string_array_value_string) == outcome(
        upstream.parse_string_array_value_string
    )
