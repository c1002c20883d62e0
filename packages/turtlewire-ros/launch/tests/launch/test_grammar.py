"""The grammar of substitutions for lark, and the class that reads its trees."""

from __future__ import annotations

import pytest
from lark import Lark, Transformer

from launch import LaunchContext
from launch.frontend.parse_substitution import (
    ExtractSubstitution,
    get_grammar_path,
    parse_substitution,
)
from launch.utilities import perform_substitutions

TEXTS = [
    "",
    "plain text, 5 $ of it, and a \\ backslash",
    r"escaped \$(var x) \' \" \\",
    "$(var x)",
    "a $(var x) b$(var y)$(var x)",
    "$(  var   x  )",
    "$(var 'x')",
    '$(var "x")',
    "$(var unset 'two words')",
    "$(var unset '')",
    """$(var unset "it's")""",
    r"$(var unset 'it\'s')",
    "$(var unset $(var y)'s)",
    "$(var $(var z))",
    "$(var unset 'a $(var y) b')",
    "$(var unset \"a $(var unset '$(var x)') b\")",
    "$(eval '1 + 1')",
    "$(env HOME)/$(var x)",
]


@pytest.fixture(scope="module")
def parser():
    with open(get_grammar_path(), encoding="utf-8") as grammar:
        return Lark(grammar, start="template")


@pytest.fixture
def context():
    context = LaunchContext()
    context.launch_configurations.update(x="1", y="2", z="x")
    return context


@pytest.mark.parametrize("text", TEXTS)
def test_a_tree_of_lark_becomes_the_same_substitutions(parser, context, text):
    made = ExtractSubstitution().transform(parser.parse(text))
    expected = parse_substitution(text)
    assert [type(each) for each in made] == [type(each) for each in expected]
    assert perform_substitutions(context, made) == perform_substitutions(context, expected)


def test_methods_work_in_a_transformer_of_lark(parser, context):
    class Extract(ExtractSubstitution, Transformer):
        transform = Transformer.transform

    made = Extract().transform(parser.parse("a $(var unset 'b $(var x)')"))
    assert perform_substitutions(context, made) == "a b 1"


def test_a_subclass_changes_one_rule(parser, context):
    class Loud(ExtractSubstitution):
        def fragment(self, content):
            return super().fragment([each.upper() for each in content])

    made = Loud().transform(parser.parse("say $(var x)"))
    assert perform_substitutions(context, made) == "SAY 1"


def test_an_unknown_substitution_is_an_error(parser):
    with pytest.raises(RuntimeError, match="Unknown substitution: nothing"):
        ExtractSubstitution().transform(parser.parse("$(nothing)"))
