"""The grammar of --ros-args, against the texts of a real ROS 2 and against its laws."""

import re
import shlex

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from tests.golden.cli.captures import captures, inputs
from tests.needs import needs_cyclone_dds
from tests.programs import run_python

from rclpy._rclpy_pybind11 import RCLError, RCLInvalidROSArgsError, UnknownROSArgsError
from rclpy.context import Context
from rclpy.impl import log_output
from rclpy.impl.arguments import Arguments
from rclpy.impl.rcl_lexer import Lexeme, Lexer, RuleError
from rclpy.impl.rcl_yaml_param_parser import parse_file, parse_value
from rclpy.node import Node
from turtlewire.wire import names

#: Runs of a whole node (it ends by Ctrl-C; a parameter of turtlesim has the wrong type):
#: tests/rclpy and tests/turtlesim play them.
NEEDS_A_NODE = {"160_rosargs_rclpy_param_range", "170_rosargs_rclcpp_wrong_param_type"}
CASES = {
    case.name: case
    for case in captures()
    if "_rosargs_" in case.name and case.name not in NEEDS_A_NODE
}
SOURCE_LOCATION = re.compile(r", at /\S+\.c:\d+")
STAMP = re.compile(r"\[\d+\.\d{9}\]")


def golden(name):
    """Words after `--ros-args`, log lines of rcl with masked stamps, and the error's text without
    places in C sources.
    """
    command = shlex.split(CASES[name].command)
    lines = CASES[name].stderr.splitlines()
    log = [STAMP.sub("[t]", line) for line in lines if "] [rcl]: " in line]
    prefixes = ("rclpy._rclpy_pybind11.", "  what():  ")
    (error,) = [line for line in lines if line.startswith(prefixes)]
    return (
        command[command.index("--ros-args") + 1 :],
        log,
        SOURCE_LOCATION.sub("", error.removeprefix("  what():  ")),
    )


def test_the_golden_cases_are_there():
    assert len(CASES) == 14


@pytest.mark.parametrize("name", CASES)
def test_golden_errors(name, capfd, monkeypatch):
    monkeypatch.chdir(inputs())
    words, log, error = golden(name)
    log_output.configure(file=False)
    with pytest.raises((RCLError, UnknownROSArgsError)) as caught:
        Arguments.parse_global(["program", "--ros-args", *words])
    shown = f"{type(caught.value).__module__}.{type(caught.value).__name__}: {caught.value}"
    assert shown == error or str(caught.value) == error  # a C++ program shows the text alone
    assert [STAMP.sub("[t]", line) for line in capfd.readouterr().err.splitlines()] == log


@pytest.mark.parametrize("name", ["151_rosargs_rclpy_bad_remap2", "154_rosargs_rclpy_unknown_flag"])
def test_golden_exit_codes(name):
    """A program that lets the error through.

    The exit code and the traceback's last line are ROS 2's.
    """
    words, _, error = golden(name)
    program = "import sys, rclpy; rclpy.init(args=sys.argv)"
    run = run_python(program, "--ros-args", *words, check=False, timeout=300, cwd=inputs())
    assert (run.returncode, run.stderr.splitlines()[-1]) == (CASES[name].exit_code, error)


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (["-r"], "Couldn't parse trailing -r flag. No remap rule found."),
        (["--param"], "Couldn't parse trailing --param flag. No parameter override rule found."),
        (["--params-file"], "Couldn't parse trailing --params-file flag. No file path provided."),
        (
            ["--log-level"],
            "Couldn't parse trailing log level flag: '--log-level'. No log level provided.",
        ),
        (["-e"], "Couldn't parse trailing -e flag. No enclave path provided."),
        (
            ["-r", "a:=b:"],
            (
                "Couldn't parse remap rule: '-r a:=b:'. Error: Expected lexeme type 19, got 5 at "
                "index 4"
            ),
        ),
        (
            ["-r", "a*:=b"],
            (
                "Couldn't parse remap rule: '-r a*:=b'. Error: Expected lexeme type 19, got 20 at "
                "index 1"
            ),
        ),
        (
            ["-r", "*:=b"],
            "Couldn't parse remap rule: '-r *:=b'. Error: Wildcard '*' is not implemented",
        ),
        (
            ["-r", "/**:=b"],
            "Couldn't parse remap rule: '-r /**:=b'. Error: Wildcard '**' is not implemented",
        ),
        (
            ["-r", r"a:=/\1"],
            r"Couldn't parse remap rule: '-r a:=/\1'. Error: Backreferences are not implemented",
        ),
        (
            ["-r", "a:="],
            (
                "Couldn't parse remap rule: '-r a:='. Error: Expected lexeme type (18) not found, "
                "search ended at index 3"
            ),
        ),
        (
            ["-p", "n:=[1, 2.0]"],
            "Sequence should be of same type. Value type 'double' do not belong at line_num 1",
        ),
        (
            ["-p", "n:=[true, 1]"],
            "Sequence should be of same type. Value type 'integer' do not belong at line_num 1",
        ),
        (
            ["-p", "n:=[1, yes]"],
            (
                "Sequence should be of same type. Value type 'bool' do not belong at line_num 1\n"
                "YAML reads yes as a bool: for the text, write 'yes'"
            ),
        ),
        (
            ["-p", "n:=[y, x]"],
            (
                "Sequence should be of same type. Value type 'string' do not belong at line_num 1\n"
                "YAML reads y as a bool: for the text, write 'y'"
            ),
        ),
        (
            ["-p", "n:="],
            "Couldn't parse parameter override rule: '-p n:='. Error: No value at line 1",
        ),
        (
            ["-p", "n:={a: 1}"],
            "Couldn't parse parameter override rule: '-p n:={a: 1}'. Error: Unknown YAML event",
        ),
        (["-p", "n:=[[1]]"], "Sequences can only hold plain values. Error at line 1"),
        (["-p", 'n:="a'], "Error parsing an event"),
        (["-p", "a.*:=1"], "Wildcard '*' is not implemented"),
        (["--log-level", ":=info"], "Argument has an invalid logger item that name is empty"),
        (["--log-level", "rcl:=loud"], "Argument does not use a valid severity level"),
        (
            ["-e", "x"],
            (
                "Enclave name is not valid: 'context name must be absolute, it must lead with a "
                "'/''. Invalid index: 0"
            ),
        ),
    ],
)
def test_malformed_rules(words, text):
    with pytest.raises(RCLInvalidROSArgsError) as caught:
        Arguments.parse_local(["--ros-args", *words])
    assert str(caught.value).startswith("Failed to parse ROS arguments: Couldn't parse ")
    assert str(caught.value).endswith(text)


def parsed(line):
    return Arguments.parse(line.split())


def test_everything_unknown_is_listed():
    with pytest.raises(UnknownROSArgsError) as caught:
        parsed("a --ros-args --nope -r a:=b b -- c --ros-args d")
    assert str(caught.value) == "['--nope', 'b', 'd']"


def test_blocks_and_user_arguments():
    arguments = parsed(
        "program -r --ros-args -r a:=b -- user -- "
        "--ros-args --log-level WARN --log-level rcl.x:=debug"
    )
    assert arguments.user_args == ["program", "-r", "user", "--"]
    assert arguments.remap_topic("/a", "n", "/") == "/b"
    assert arguments.log_levels == {"": 30, "rcl.x": 10}


def test_switches_and_the_rest():
    arguments = parsed(
        "--ros-args --disable-stdout-logs --disable-rosout-logs --enable-rosout-logs "
        "--disable-external-lib-logs --log-file-name robot --enclave /a/b --log-config-file x"
    )
    switches = arguments.stdout_logs, arguments.rosout_logs, arguments.external_lib_logs
    assert switches == (False, True, False)
    names = arguments.log_file_name, arguments.enclave, arguments.log_config_file
    assert names == ("robot", "/a/b", "x")
    with pytest.raises(RCLInvalidROSArgsError):
        parsed("--ros-args --log-file-name ../x")


def rules(*texts):
    return Arguments.parse(["--ros-args", *(word for text in texts for word in ("-r", text))])


@pytest.mark.parametrize(
    ("rule", "name", "topic", "service"),
    [
        ("a:=b", "/ns/a", "/ns/b", "/ns/b"),
        ("a:=/b", "/ns/a", "/b", "/b"),
        ("/a:=b", "/a", "/ns/b", "/ns/b"),
        ("a:=b", "/a", "/a", "/a"),
        ("~/a:=b", "/ns/node/a", "/ns/b", "/ns/b"),
        ("a/b:=~/c/d", "/ns/a/b", "/ns/node/c/d", "/ns/node/c/d"),
        ("rostopic://a:=b", "/ns/a", "/ns/b", "/ns/a"),
        ("rosservice://a:=b", "/ns/a", "/ns/a", "/ns/b"),
        ("node:a:=b", "/ns/a", "/ns/b", "/ns/b"),
        ("other:a:=b", "/ns/a", "/ns/a", "/ns/a"),
        ("node:rosservice:///a:=b", "/a", "/a", "/ns/b"),
    ],
)
def test_remap_rules(rule, name, topic, service):
    arguments = rules(rule)
    assert arguments.remap_topic(name, "node", "/ns") == topic
    assert arguments.remap_service(name, "node", "/ns") == service


def test_node_name_and_namespace():
    arguments = rules(
        "other:__node:=x",
        "__node:=renamed",
        "__name:=late",
        "old:__ns:=/wrong",
        "renamed:__ns:=/right",
    )
    assert arguments.remap_node_name("old") == "renamed"
    assert arguments.remap_node_name("other") == "x"
    assert arguments.remap_namespace("renamed", "/") == "/right"
    assert rules("__ns:=/").remap_namespace("n", "/given") == "/"
    assert rules().remap_namespace("n", "/given") == "/given"


def test_local_rules_come_before_global_ones():
    both = rules("a:=local").followed_by(rules("a:=global", "b:=global_b"))
    assert both.remap_topic("/a", "n", "/") == "/local"
    assert both.remap_topic("/b", "n", "/") == "/global_b"


tokens = st.from_regex(r"[a-z][a-z0-9]{0,5}", fullmatch=True)
relative_names = st.lists(tokens, min_size=1, max_size=3).map("/".join)
typed_names = st.one_of(
    relative_names, relative_names.map("/{}".format), relative_names.map("~/{}".format)
)
namespaces = st.one_of(st.just("/"), relative_names.map("/{}".format))


@given(
    st.lists(st.tuples(typed_names, typed_names), min_size=1, max_size=5),
    typed_names,
    tokens,
    namespaces,
)
def test_the_first_rule_whose_expansion_is_the_name_wins(pairs, asked, node, namespace):
    def expand(name):
        return names.expand_topic_name(name, node, namespace)

    arguments = rules(*(f"{match}:={replacement}" for match, replacement in pairs))
    replacements = [replacement for match, replacement in pairs if expand(match) == expand(asked)]
    expected = expand(replacements[0]) if replacements else expand(asked)
    assert (
        arguments.remap_topic(expand(asked), node, namespace)
        == arguments.remap_service(expand(asked), node, namespace)
        == expected
    )


@given(st.lists(tokens, min_size=1, max_size=4), st.data())
def test_wildcards_of_parameter_files(node_tokens, data):
    """`*` stands for one token, `**` for any number of whole tokens, each after a slash."""
    pattern, index = [], 0
    while index < len(node_tokens):
        choice = data.draw(st.sampled_from(["itself", "*", "**"]))
        pattern.append(node_tokens[index] if choice == "itself" else choice)
        index += data.draw(st.integers(0, len(node_tokens) - index)) if choice == "**" else 1
    node = "/" + "/".join(node_tokens)
    assert overrides("/" + "/".join(pattern), node) == {"x": 1}
    assert overrides("/".join(pattern), node) == {"x": 1}
    if "**" not in pattern:
        assert overrides("/" + "/".join([*pattern, "*"]), node) == {}
        other = data.draw(tokens)
        assume(other not in pattern and other not in node_tokens)
        assert overrides("/" + "/".join([*pattern[:-1], other]), node) == {}


def overrides(pattern, node):
    arguments = Arguments()
    arguments.parameter_maps = [{pattern: {"x": 1}}]
    return arguments.parameter_overrides(node)


@given(st.text(alphabet="ab_0/:=~*.\\1-", max_size=20))
def test_the_lexer_reads_everything_or_says_where_it_stops(text):
    lexer = Lexer(text)
    read = ""
    while lexer.peek() not in (Lexeme.EOF, Lexeme.NONE):
        read += lexer.accept()
    assert read == text[: lexer.index]
    assert (lexer.peek() is Lexeme.EOF) == (lexer.rest == "")


@pytest.mark.parametrize(
    "text",
    [
        "__node",
        "__name",
        "__ns",
        "rostopic://",
        "rosservice://",
        ":=",
        ":",
        "~/",
        "**",
        "*",
        "/",
        ".",
        "a_b",
        "_",
    ],
)
def test_each_lexeme_is_one(text):
    lexer = Lexer(text)
    assert lexer.accept() == text
    assert lexer.peek() is Lexeme.EOF


def test_no_lexeme():
    for text in ("", "~", "__x", "-", "é"):
        lexer = Lexer(text)
        assert lexer.peek() in (Lexeme.NONE, Lexeme.EOF)
        with pytest.raises(RuleError):
            lexer.expect(Lexeme.TOKEN)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1", 1),
        ("-0x1F", -31),
        ("010", 8),
        ("+7", 7),
        ("08", 8.0),
        ("9223372036854775807", 2**63 - 1),
        ("9223372036854775808", 2.0**63),
        ("1.", 1.0),
        (".5", 0.5),
        ("1e3", 1000.0),
        ("0x1.8p1", 3.0),
        ("1e400", "1e400"),
        (".inf", float("inf")),
        ("-.INF", float("-inf")),
        ("y", True),
        ("Off", False),
        ("oN", "oN"),
        ("'1'", "1"),
        ('"yes"', "yes"),
        ("!!str 1", "1"),
        ("1_000", "1_000"),
        ("null", "null"),
        ("~", "~"),
        ("1.2.3", "1.2.3"),
        ("2026-01-01", "2026-01-01"),
        ("''", ""),
        ("[1, 2]", [1, 2]),
        ("[]", []),
        ("['1', a]", ["1", "a"]),
        ("[on, no]", [True, False]),
        ("- 1.0\n- .5", [1.0, 0.5]),
    ],
)
def test_values(text, value):
    read = parse_value(text)
    assert read == value
    assert type(read) is type(value)


def test_not_a_number():
    read = parse_value("[.nan, nan, .NaN]")
    assert [each != each for each in read] == [True, True, True]


@given(
    st.one_of(
        st.booleans(),
        st.integers(-(2**63), 2**63 - 1),
        st.floats(allow_nan=False, allow_infinity=False),
        st.text("abcxyz _-"),
    )
)
def test_python_values_survive_yaml(value):
    text = (
        {True: "true", False: "false"}[value]
        if isinstance(value, bool)
        else f"'{value}'"
        if isinstance(value, str)
        else repr(value)
    )
    read = parse_value(text)
    assert read == value
    assert type(read) is type(value)


def test_rules_with_a_node_and_slashes():
    arguments = parsed(
        "--ros-args -p n:a.b:=1 -p qos_overrides./chatter.publisher.depth:=5 -p c:=x"
    )
    of_all = {"qos_overrides./chatter.publisher.depth": 5, "c": "x"}
    assert arguments.parameter_overrides("/n") == {"a.b": 1, **of_all}
    assert arguments.parameter_overrides("/m") == of_all
    assert arguments.parameter_overrides("/ns/n") == of_all


FILE = """\
/**:
  ros__parameters:
    everywhere: 1
    shared: all
ns:
  node:
    ros__parameters:
      shared: node
      group:
        inner: [1.5, 2.5]
        deep: {er: 'x'}
/ns/*:
  ros__parameters: {shared: late}
"""


def test_a_parameter_file(tmp_path):
    path = tmp_path / "f.yaml"
    path.write_text(FILE)
    assert parse_file(str(path)) == {
        "/**": {"everywhere": 1, "shared": "all"},
        "ns/node": {"shared": "node", "group.inner": [1.5, 2.5], "group.deep.er": "x"},
        "/ns/*": {"shared": "late"},
    }
    arguments = Arguments.parse(["--ros-args", "--params-file", str(path), "-p", "everywhere:=2"])
    assert arguments.parameter_overrides("/other") == {"everywhere": 2, "shared": "all"}
    assert arguments.parameter_overrides("/ns/node") == {
        "everywhere": 2,
        "shared": "late",
        "group.inner": [1.5, 2.5],
        "group.deep.er": "x",
    }


def test_local_parameters_win_over_global_ones():
    local, process = (Arguments.parse(["--ros-args", "-p", rule]) for rule in ("a:=1", "n:a:=2"))
    assert local.followed_by(process).parameter_overrides("/n") == {"a": 1}


@pytest.mark.parametrize(
    "middleware",
    ["local", pytest.param("rmw_cyclonedds_cpp", marks=needs_cyclone_dds), "rmw_zenoh_cpp"],
)
def test_nodes_are_in_the_enclave_of_the_process(monkeypatch, middleware):
    monkeypatch.setenv("RMW_IMPLEMENTATION", middleware)
    context = Context()
    context.init(args=["--ros-args", "--enclave", "/robots/one"])
    node = Node("a", context=context, cli_args=["--ros-args", "--enclave", "/of/the/node"])
    other = Node("b", context=context, use_global_arguments=False)
    assert sorted(node.get_node_names_and_namespaces_with_enclaves()) == [
        ("a", "/", "/robots/one"),
        ("b", "/", "/robots/one"),
    ]
    node.destroy_node()
    other.destroy_node()
    context.try_shutdown()


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("n: 1", "Cannot have a value before ros__parameters at line 1"),
        ("1", "Cannot have a value before ros__parameters at line 1"),
        ("n: [1]", "Sequences can only be values and not keys in params. Error at line 1\n"),
        ("ros__parameters: {a: 1}", "There are no node names before ros__parameters at line 1"),
        ("n:\n  ros__parameters: 1", "Cannot have a value before ros__parameters at line 2"),
        ("n:\n  ros__parameters:\n    [1]: 2", "Sequences cannot be key at line 3"),
        (
            "n:\n  ros__parameters:\n    a: [1, [2]]",
            "Sequences can only hold plain values. Error at line 3",
        ),
        ("n:\n  ros__parameters:\n    a: &x 1\n    b: *x", "Will not support aliasing at line 4\n"),
        ("n:\n  ros__parameters:\n    a:", "No value at line 3"),
        ("n:\n\tros__parameters: 1", "Error parsing a event near line 1"),
        ("n: {", "Error parsing a event near line 1"),
        ("n:\n  ros__parameters:\n    a: \x00", "Error parsing a event near line 1"),
    ],
)
def test_bad_parameter_files(tmp_path, text, error):
    path = tmp_path / "f.yaml"
    path.write_text(text)
    with pytest.raises(RuleError) as caught:
        parse_file(str(path))
    assert str(caught.value) == error


def test_empty_and_unreadable_parameter_files(tmp_path):
    path = tmp_path / "f.yaml"
    path.write_text("")
    assert parse_file(str(path)) == {}
    path.write_bytes(b"\xff\xfe\x00")
    for bad in (path, tmp_path, tmp_path / "none.yaml"):
        with pytest.raises(RuleError, match=r"^Error opening YAML file$"):
            parse_file(str(bad))


yaml_like = st.text(alphabet="ab_1.:=~/*&!|>%@`'\"[]{},- #\n\t\\\x00é", max_size=40)


@given(
    st.sampled_from(
        ["-r", "-p", "--log-level", "-e", "--log-file-name", "--params-file", "--nope"]
    ),
    yaml_like,
)
def test_nonsense_is_answered_with_the_right_error(flag, text):
    try:
        arguments = Arguments.parse(["--ros-args", flag, text])
    except (RCLInvalidROSArgsError, UnknownROSArgsError):
        return
    assert isinstance(arguments.parameter_overrides("/n"), dict)
    assert arguments.remap_topic("/a", "n", "/").startswith("/")


@given(st.one_of(yaml_like.map(str.encode), st.binary(max_size=40)))
def test_a_file_of_nonsense_is_answered_with_the_right_error(tmp_path_factory, data):
    path = tmp_path_factory.getbasetemp() / "nonsense.yaml"
    path.write_bytes(data)
    try:
        nodes = parse_file(str(path))
    except RuleError:
        return
    assert all(isinstance(parameters, dict) for parameters in nodes.values())


def test_a_number_of_ten_thousand_digits():
    assert parse_value("9" * 10_000) == "9" * 10_000
    assert parse_value("0" * 10_000) == 0.0
