"""The start of comments: the engine's parser, `rosidl_adapter` and `interface show` agree."""

import pytest

from ros2cli.main import main
from rosidl_adapter.parser import parse_message_string
from turtlewire.msg.parser import parse_message

VALUES = [
    ('"x # y"', "x # y", ""),
    ("'x # y'  # said", "x # y", "said"),
    ('"x" # "y"', "x", '"y"'),
    ("x # y", "x", "y"),
    ("don't # can't", "don't", "can't"),
    (r'"a \" # b" # c', 'a " # b', "c"),
]


@pytest.mark.parametrize(("text", "value", "comment"), VALUES)
def test_readers_agree_on_constants(text, value, comment):
    line = f"string NAME={text}"
    (constant,) = parse_message("p/msg/Said", line).constants
    (adapted,) = parse_message_string("p", "Said", line).constants
    assert constant.value == adapted.value == value
    assert " ".join(adapted.annotations["comment"]).strip() == comment


def test_readers_agree_on_defaults():
    line = "string[] names ['a # b', \"c\"]  # two"
    (field,) = parse_message("p/msg/Said", line).fields
    (adapted,) = parse_message_string("p", "Said", line).fields
    assert list(field.default) == list(adapted.default_value) == ["a # b", "c"]


def test_show_keeps_what_is_quoted(tmp_path, monkeypatch, capsys):
    folder = tmp_path / "share" / "p_quoted" / "msg"
    folder.mkdir(parents=True)
    (folder / "Said.msg").write_text('string NAME="x # y"  # said\n')
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    assert main(["interface", "show", "--no-comments", "p_quoted/msg/Said"]) == 0
    assert capsys.readouterr().out == 'string NAME="x # y"\n'
