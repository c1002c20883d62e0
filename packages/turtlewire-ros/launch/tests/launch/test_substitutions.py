"""The result, the description and the error of each substitution."""

import operator
import os
import sys
import sysconfig

import pytest
from lark import Lark, Transformer

from launch import LaunchContext, logging
from launch.frontend.parse_substitution import (
    ExtractSubstitution,
    get_grammar_path,
    parse_substitution,
)
from launch.substitutions import (
    AllSubstitution,
    AndSubstitution,
    AnonName,
    AnySubstitution,
    Command,
    EnvironmentVariable,
    EqualsSubstitution,
    FileContent,
    FindExecutable,
    IfElseSubstitution,
    LaunchConfiguration,
    LaunchLogDir,
    LocalSubstitution,
    NotEqualsSubstitution,
    NotSubstitution,
    OrSubstitution,
    PathJoinSubstitution,
    PythonExpression,
    SubstitutionFailure,
    TextSubstitution,
    ThisLaunchFile,
    ThisLaunchFileDir,
)
from launch.substitutions.boolean_substitution import (
    ContainerSubstitution,
    LeftRightLogicalSubstitution,
)
from launch.utilities import perform_substitutions


def test_launch_configuration(context):
    context.launch_configurations["colour"] = "green"
    assert LaunchConfiguration("colour").perform(context) == "green"
    assert LaunchConfiguration(["col", TextSubstitution(text="our")]).perform(context) == "green"
    assert (
        LaunchConfiguration("none", default=["a", LaunchConfiguration("colour")]).perform(context)
        == "agreen"
    )
    assert LaunchConfiguration("none", default=5).perform(context) == "5"
    assert LaunchConfiguration("colour").describe() == "LaunchConfig('colour')"
    with pytest.raises(SubstitutionFailure, match=r"^launch configuration 'none' does not exist$"):
        LaunchConfiguration("none").perform(context)


def test_environment_variable(context, monkeypatch):
    monkeypatch.setenv("TURTLE_COLOUR", "red")
    assert EnvironmentVariable("TURTLE_COLOUR").perform(context) == "red"
    monkeypatch.delenv("TURTLE_COLOUR")
    assert EnvironmentVariable("TURTLE_COLOUR", default_value="").perform(context) == ""
    with pytest.raises(
        SubstitutionFailure, match=r"^environment variable 'TURTLE_COLOUR' does not exist$"
    ):
        EnvironmentVariable("TURTLE_COLOUR").perform(context)


def test_paths(context):
    path = PathJoinSubstitution(["share", ["turtle", TextSubstitution(text="sim")], "launch"])
    assert path.perform(context) == os.path.join("share", "turtlesim", "launch")
    assert PathJoinSubstitution("share").perform(context) == "share"
    with pytest.raises(SubstitutionFailure, match="outside of a launch file"):
        ThisLaunchFile().perform(context)
    with pytest.raises(SubstitutionFailure, match="outside of a launch file"):
        ThisLaunchFileDir().perform(context)


@pytest.mark.parametrize(
    ("left", "right", "equal"),
    [
        ("a", "a", True),
        ("a", "b", False),
        ("1", "1.0", True),
        (1, "1", True),
        (0.1 + 0.2, 0.3, True),
        (True, "1", True),
        (True, "true", True),
        (False, "0", True),
        ("true", "0", False),
        (None, "", True),
        ("a", 1, False),
    ],
)
def test_equality(context, left, right, equal):
    assert EqualsSubstitution(left, right).perform(context) == str(equal).lower()
    assert NotEqualsSubstitution(left, right).perform(context) == str(not equal).lower()


def test_logic(context):
    assert NotSubstitution("true").perform(context) == "false"
    assert NotSubstitution("0").perform(context) == "true"
    assert AndSubstitution("true", "1").perform(context) == "true"
    assert AndSubstitution("true", "False").perform(context) == "false"
    assert OrSubstitution("0", "TRUE").perform(context) == "true"
    assert OrSubstitution("0", "false").perform(context) == "false"
    assert AnySubstitution("0", "0", "1").perform(context) == "true"
    assert AnySubstitution().perform(context) == "false"
    assert AllSubstitution("1", "true").perform(context) == "true"
    assert AllSubstitution("1", "0").perform(context) == "false"
    assert AllSubstitution("yes", "on", "True").perform(context) == "true"
    assert AnySubstitution("no", "off").perform(context) == "false"
    assert AllSubstitution("1", container=["true", "0"]).perform(context) == "false"
    assert AnySubstitution(container=["no", ["o", "n"]]).perform(context) == "true"
    exactly_two = ContainerSubstitution(lambda values: sum(values) == 2, "1", "1", "0")
    assert exactly_two.perform(context) == "true"
    either = LeftRightLogicalSubstitution(operator.xor, "1", "1")
    assert either.perform(context) == "false"
    assert (either.func, AndSubstitution("1", "1").func) == (operator.xor, operator.and_)
    with pytest.raises(SubstitutionFailure, match="Failed to convert 'perhaps' to 'bool'"):
        NotSubstitution("perhaps").perform(context)


def test_if_else(context):
    assert IfElseSubstitution("true", "yes", "no").perform(context) == "yes"
    assert IfElseSubstitution("false", if_value="yes").perform(context) == ""
    with pytest.raises(RuntimeError, match="One of if_value and else_value must be specified"):
        IfElseSubstitution("true")


def test_the_modules_of_an_expression_in_a_launch_file(context):
    (several,) = parse_substitution("$(eval 'math.sqrt(4) + len(sys.path) * 0' 'math, sys')")
    assert several.perform(context) == "2.0"
    (none,) = parse_substitution("$(eval '1 + 1' '')")
    assert none.perform(context) == "2"


def test_the_default_of_a_configuration_is_text(context):
    for default, text in (([["0", "0"]], "['0', '0']"), ([1, "a"], "1a"), (2.5, "2.5")):
        assert LaunchConfiguration("none", default=default).perform(context) == text


def test_folders_are_extended_by_a_slash(context):
    context.extend_locals({"current_launch_file_directory": "/here"})
    assert (ThisLaunchFileDir() / "a" / "b").perform(context) == os.path.join("/here", "a", "b")
    assert (LaunchLogDir() / "a").perform(context).endswith(f"{os.sep}a")
    assert ThisLaunchFileDir().perform(context) == "/here"
    assert (ThisLaunchFileDir() / "a").describe() == "PathJoin(ThisLaunchFileDir(), 'a')"


def test_python_expression(context):
    context.launch_configurations["count"] = "3"
    assert (
        PythonExpression([LaunchConfiguration("count"), " * 2 + int(sqrt(4))"]).perform(context)
        == "8"
    )
    assert PythonExpression(["os.sep.join(['a'])"], python_modules=["os"]).perform(context) == "a"
    assert PythonExpression("1 +").describe() == "PythonExpr('1 +', ['math'])"
    with pytest.raises(ZeroDivisionError):
        PythonExpression("1 / 0").perform(context)
    with pytest.raises(NameError, match="name 'missing' is not defined") as caught:
        PythonExpression("missing + 1").perform(context)
    assert caught.value.hint == "It was raised by the Python expression 'missing + 1'."


def test_command(context, capsys):
    logging.reset()
    python = sys.executable
    assert Command([python, " -c 'print(1)'"]).perform(context) == "1\n"
    noisy = [python, " -c \"import sys; sys.stderr.write('oh'); print(1)\""]
    assert Command(noisy, on_stderr="ignore").perform(context) == "1\n"
    assert "oh" in Command(noisy, on_stderr="capture").perform(context)
    assert capsys.readouterr().out == ""
    assert Command(noisy, on_stderr="warn").perform(context) == "1\n"
    assert "executed command showed stderr output" in capsys.readouterr().out
    with pytest.raises(SubstitutionFailure, match="executed command showed stderr output"):
        Command(noisy).perform(context)
    with pytest.raises(SubstitutionFailure, match="executed command failed"):
        Command([python, " -c 'raise SystemExit(3)'"]).perform(context)
    with pytest.raises(SubstitutionFailure, match="file not found"):
        Command("no_such_program").perform(context)
    for line, problem in (
        ("/", r"^command '/': .*Permission denied"),
        ("echo 'x", r"^command 'echo 'x': No closing quotation"),
        (" ", "^the command is empty$"),
        (rf"{python} -c 'import sys; sys.stdout.buffer.write(bytes([255]))'", "can't decode"),
    ):
        with pytest.raises(SubstitutionFailure, match=problem):
            Command(line).perform(context)
    with pytest.raises(
        SubstitutionFailure, match="expected one of: 'fail', 'ignore', 'warn' or 'capture'"
    ):
        Command("true", on_stderr="perhaps").perform(context)


def test_files(context, tmp_path):
    (tmp_path / "x.txt").write_text("Grüße")
    assert FileContent(str(tmp_path / "x.txt")).perform(context) == "Grüße"
    with pytest.raises(SubstitutionFailure, match=r"Failed to read file 'nowhere'"):
        FileContent("nowhere").perform(context)
    (tmp_path / "latin-1").write_bytes(b"Gr\xfc\xdfe")
    with pytest.raises(SubstitutionFailure, match=r"Failed to read file '.*/latin-1': .*decode"):
        FileContent(str(tmp_path / "latin-1")).perform(context)
    assert os.path.basename(FindExecutable(name="sh").perform(context)) == "sh"
    with pytest.raises(
        SubstitutionFailure, match=r"^executable 'no_such_program' not found on the PATH$"
    ):
        FindExecutable(name="no_such_program").perform(context)


def test_anonymous_names_are_kept_within_a_launch(context):
    name = AnonName("my rviz").perform(context)
    assert name.startswith("my_rviz_")
    assert name.isidentifier()
    assert AnonName("my rviz").perform(context) == name
    assert AnonName("my rviz").perform(LaunchContext()) != name


def test_locals(context):
    context.extend_locals({"event": OSError(5, "broken")})
    assert LocalSubstitution("event.strerror").perform(context) == "broken"
    assert LocalSubstitution("event.args[0]").perform(context) == "5"
    assert LocalSubstitution("event.strerror", "why").describe() == "LocalVar('why')"
    assert LocalSubstitution("event.strerror").describe() == "LocalVar('event.strerror')"
    with pytest.raises(TypeError, match=r"expected Text object got '<class 'int'>'"):
        LocalSubstitution(5)
    with pytest.raises(SubstitutionFailure, match=r"no local 'event\.nothing'"):
        LocalSubstitution("event.nothing").perform(context)


def test_log_dir(context, tmp_path):
    logging.reset()
    logging.launch_config.log_dir = str(tmp_path / "here")
    assert LaunchLogDir().perform(context) == str(tmp_path / "here")
    logging.reset()


def test_text_is_text():
    with pytest.raises(TypeError, match="expected Text object got"):
        TextSubstitution(text=1)


def test_a_command_may_lie_beside_the_interpreter(monkeypatch):
    scripts = sysconfig.get_path("scripts")
    others = [path for path in os.environ["PATH"].split(os.pathsep) if path != scripts]
    monkeypatch.setenv("PATH", os.pathsep.join(others))
    assert Command("xacro --help").perform(LaunchContext()).startswith("Usage: xacro ")
    with pytest.raises(SubstitutionFailure, match=r"file not found: .*'no_such_program'"):
        Command("no_such_program").perform(LaunchContext())


# The grammar of substitutions for lark, and the class that reads its trees.


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
def configured():
    context = LaunchContext()
    context.launch_configurations.update(x="1", y="2", z="x")
    return context


@pytest.mark.parametrize("text", TEXTS)
def test_a_tree_of_lark_becomes_the_same_substitutions(parser, configured, text):
    made = ExtractSubstitution().transform(parser.parse(text))
    expected = parse_substitution(text)
    assert [type(each) for each in made] == [type(each) for each in expected]
    assert perform_substitutions(configured, made) == perform_substitutions(configured, expected)


def test_methods_work_in_a_transformer_of_lark(parser, configured):
    class Extract(ExtractSubstitution, Transformer):
        transform = Transformer.transform

    made = Extract().transform(parser.parse("a $(var unset 'b $(var x)')"))
    assert perform_substitutions(configured, made) == "a b 1"


def test_a_subclass_changes_one_rule(parser, configured):
    class Loud(ExtractSubstitution):
        def fragment(self, content):
            return super().fragment([each.upper() for each in content])

    made = Loud().transform(parser.parse("say $(var x)"))
    assert perform_substitutions(configured, made) == "SAY 1"


def test_an_unknown_substitution_is_an_error(parser):
    with pytest.raises(RuntimeError, match="Unknown substitution: nothing"):
        ExtractSubstitution().transform(parser.parse("$(nothing)"))
