"""Syntax trees of IDL: they give the same content as the engine's reader."""

import sys
from pathlib import Path, PurePath

import pytest
from lark import Lark, UnexpectedInput

from rosidl_adapter.idl import interface_to_idl
from rosidl_parser import syntax_tree
from rosidl_parser.definition import (
    Array,
    BasicType,
    BoundedSequence,
    BoundedString,
    BoundedWString,
    Message,
    NamedType,
    NamespacedType,
    Structure,
    UnboundedString,
)
from rosidl_parser.parser import (
    BASE_TYPE_SPEC_TO_IDL_TYPE,
    add_message_members,
    extract_content_from_ast,
    get_abstract_type,
    get_abstract_type_from_const_expr,
    get_abstract_type_from_type_spec,
    get_abstract_type_optionally_as_array,
    get_annotations,
    get_ast_from_idl_string,
    get_child_identifier_value,
    get_const_expr_value,
    get_decimal_literal_value,
    get_first_identifier_value,
    get_fixed_pt_literal_value,
    get_floating_pt_literal_value,
    get_module_identifier_values,
    get_positive_int_const,
    get_string_literal_value,
    get_string_literals_value,
    grammar,
    grammar_file,
    parse_idl_string,
)
from turtlewire.errors import InterfaceError
from turtlewire.msg import interfaces
from turtlewire.msg.registry import interface_text

from .test_parser import SHAPE


def described(thing):
    """What an object of the parser holds, as nested tuples."""
    if isinstance(thing, (list, tuple)):
        return [described(each) for each in thing]
    if isinstance(thing, dict):
        return {name: described(value) for name, value in thing.items()}
    slots = [slot for kind in type(thing).__mro__ for slot in getattr(kind, "__slots__", ())]
    if not slots:
        return type(thing).__name__, thing
    return type(thing).__name__, {slot: described(getattr(thing, slot)) for slot in slots}


def definitions(text, rule):
    tree = get_ast_from_idl_string(f"module a {{ module msg {{ {text} }}; }};")
    return list(tree.find_data(rule))


def constant(kind, value):
    (found,) = definitions(f"const {kind} C = {value};", "const_dcl")
    return found


def value_of(text, rule="const_expr"):
    return next(constant("string", text).find_data(rule))


def test_the_content_of_each_interface():
    count = 0
    for package, kinds in interfaces().items():
        for kind, names in kinds.items():
            for name in names:
                source = PurePath(kind, f"{name}.{kind}")
                full_name = f"{package}/{kind}/{name}"
                text = interface_to_idl(package, source, interface_text(full_name))
                made = extract_content_from_ast(get_ast_from_idl_string(text))
                assert described(made) == described(parse_idl_string(text)), full_name
                count += 1
    assert count >= 363


def test_the_content_of_a_text_with_all_constructs():
    made = extract_content_from_ast(get_ast_from_idl_string(SHAPE))
    assert described(made) == described(parse_idl_string(SHAPE))


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("module a { union U switch (long) {}; };", UnexpectedInput),
        ("module a { struct S { long x } };", UnexpectedInput),
        ("module a { struct S { long x; }; struct T { long x; }; };", InterfaceError),
        ("module a { struct S { nothing x; }; };", InterfaceError),
    ],
)
def test_texts_that_are_no_interface(text, error):
    with pytest.raises(error):
        extract_content_from_ast(get_ast_from_idl_string(text))


def test_the_grammar_works_in_a_parser_of_lark():
    assert Path(grammar_file).read_text(encoding="utf-8") == grammar
    tree = Lark(grammar, start="specification", parser="lalr").parse("const long A = 1;")
    assert get_child_identifier_value(next(tree.find_data("const_dcl"))) == "A"


def test_without_lark_the_error_names_the_extra(monkeypatch):
    syntax_tree._parser.cache_clear()
    monkeypatch.setitem(sys.modules, "lark", None)
    with pytest.raises(ImportError, match=r"pip install 'turtlewire-ros\[grammars\]'"):
        get_ast_from_idl_string("const long A = 1;")
    assert parse_idl_string("module a { struct S { long x; }; };").elements


def test_names():
    tree = get_ast_from_idl_string(SHAPE)
    (structure,) = tree.find_data("struct_def")
    assert get_module_identifier_values(tree, structure) == ["shapes", "msg"]
    assert get_child_identifier_value(structure) == "Shape"
    # An annotation stands before the name.
    assert get_first_identifier_value(structure) == "verbatim"
    constants = [
        get_module_identifier_values(tree, each)[-1] for each in tree.find_data("const_dcl")
    ]
    assert set(constants) == {"Shape_Constants"}


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("7", 7),
        ("-7", -7),
        ("+7", 7),
        ("0x1F", 31),
        ("017", 15),
        ("1.5", 1.5),
        ("-.5e1", -5.0),
        ("2.5d", 2.5),
        ("TRUE", True),
        ("FALSE", False),
        ("'x'", "x"),
        (r"'\n'", "\n"),
        ('"a" "b\\t"', "ab\t"),
        ("Other::NAME", "Other::NAME"),
    ],
)
def test_values(text, value):
    found = get_const_expr_value(value_of(text))
    assert (found, type(found)) == (value, type(value))


def test_literals():
    assert get_decimal_literal_value(value_of("42", "decimal_literal")) == 42
    assert get_floating_pt_literal_value(value_of("4.5", "floating_pt_literal")) == 4.5
    assert get_fixed_pt_literal_value(value_of("4.5D", "fixed_pt_literal")) == 4.5
    literal = value_of(r'"\"\\u\u00e9"', "string_literal")
    assert get_string_literal_value(literal) == '"\\u\\u00e9'
    assert get_string_literal_value(literal, allow_unicode=True) == '"\\u\u00e9'
    literals = value_of(r'"a\x41" "\u00e9"', "string_literals")
    assert get_string_literals_value(literals) == "aA\\u00e9"
    assert get_string_literals_value(literals, allow_unicode=True) == "aA\u00e9"


def test_annotations():
    text = '@key @unit(value="m") @default (5) @range(min=1, max=2.5) struct S { long x; };'
    (structure,) = definitions(text, "struct_def")
    found = {each.name: each.value for each in get_annotations(structure)}
    assert found == {
        "key": None,
        "unit": {"value": "m"},
        "default": 5,
        "range": {"min": 1, "max": 2.5},
    }
    assert get_annotations(next(structure.find_data("member"))) == []


@pytest.mark.parametrize(
    ("text", "type_"),
    [
        ("unsigned long", BasicType("uint32")),
        ("long long", BasicType("int64")),
        ("long double", BasicType("long double")),
        ("wchar", BasicType("wchar")),
        ("string", UnboundedString()),
        ("wstring<3>", BoundedWString(3)),
        ("name_t", NamedType("name_t")),
        ("::std_msgs::msg::Header", NamespacedType(("std_msgs", "msg"), "Header")),
        ("sequence<string<3>, 5>", BoundedSequence(BoundedString(3), 5)),
    ],
)
def test_types(text, type_):
    (member,) = definitions(f"struct S {{ {text} x[4]; }};", "member")
    (spec, declarators) = member.children
    assert described(get_abstract_type(spec)) == described(type_)
    assert described(get_abstract_type(spec.children[0])) == described(type_)
    assert described(get_abstract_type_from_type_spec(spec)) == described(type_)
    declarator = declarators.children[0]
    array = get_abstract_type_optionally_as_array(type_, declarator)
    assert described(array) == described(Array(type_, 4))
    (size,) = declarator.find_data("positive_int_const")
    assert get_positive_int_const(size) == 4


def test_types_without_a_size_and_with_wrong_ones():
    members = definitions("struct S { long x, y[0], z[2][3]; };", "declarator")
    plain, empty, nested = members
    long = BasicType("int32")
    assert get_abstract_type_optionally_as_array(long, plain) is long
    with pytest.raises(ValueError, match="'0' is not a size"):
        get_abstract_type_optionally_as_array(long, empty)
    with pytest.raises(ValueError, match="an array of arrays"):
        get_abstract_type_optionally_as_array(long, nested)
    with pytest.raises(ValueError, match="'declarator' is not a type"):
        get_abstract_type(plain)


def test_the_type_of_a_constant_text_is_bounded_by_its_value():
    kind = next(constant("string", '"abc"').find_data("const_type"))
    assert described(get_abstract_type_from_const_expr(kind, "abc")) == described(BoundedString(3))
    kind = next(constant("octet", "1").find_data("const_type"))
    assert described(get_abstract_type_from_const_expr(kind, 1)) == described(BasicType("octet"))


def test_every_rule_of_a_basic_type_is_a_type():
    assert set(BASE_TYPE_SPEC_TO_IDL_TYPE.values()) >= {"int8", "uint64", "float", "octet", "wchar"}
    assert BASE_TYPE_SPEC_TO_IDL_TYPE["unsigned_longlong_int"] == "uint64"


def test_members_of_a_message():
    (structure,) = definitions('struct S { @unit(value="m") long x, y; string z; };', "struct_def")
    message = Message(Structure(NamespacedType(("a", "msg"), "S")))
    add_message_members(message, structure)
    found = [(each.name, each.has_annotation("unit")) for each in message.structure.members]
    assert found == [("x", True), ("y", True), ("z", False)]
