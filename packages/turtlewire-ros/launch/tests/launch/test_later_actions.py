"""Actions and substitutions that came with Kilted and Lyrical: loops, levels of logs, others."""

import re

import pytest

from launch.actions import (
    DeclareBooleanLaunchArgument,
    ForEach,
    ForLoop,
    IncludeLaunchDescription,
    Log,
    LogInfo,
    LogWarning,
    OpaqueFunction,
    ReplaceEnvironmentVariables,
)
from launch.substitutions import (
    ForEachVar,
    ForLoopIndex,
    LaunchConfiguration,
    StringJoinSubstitution,
)


@pytest.fixture
def launch_file(launch, tmp_path):
    def start(text):
        path = tmp_path / "file.launch.xml"
        path.write_text(f"<launch>{text}</launch>")
        return launch(IncludeLaunchDescription(str(path)))

    return start


def logged(outcome):
    """What launch.user has logged: levels and messages."""
    found = (re.match(r"\[(\w+)\] \[launch\.user\]: (.*)", line) for line in outcome.lines)
    return [match.groups() for match in found if match]


def test_each_mapping_is_an_iteration(launch):
    def greet(name, times=1):
        return [LogInfo(msg=f"{name} {times!r}")]

    values = "{name: 'a', times: 2};{name: b}"
    assert launch(ForEach(values, function=greet)).messages == ["a 2", "b 1"]
    again = launch(ForEach("{};{}", function=lambda: [LogInfo(msg="again")]))
    assert again.messages == ["again", "again"]
    assert launch(ForEach("{}", function=lambda: None)).status == 0


def test_no_mappings_are_a_warning(launch):
    outcome = launch(ForEach("", function=lambda: pytest.fail("called")))
    warning = "[WARNING] [launch.actions.for_loop]: no input values: will not iterate"
    assert (outcome.status, warning in outcome.lines) == (0, True)


@pytest.mark.parametrize(("length", "expected"), [("0", []), ("1", ["0"]), ("3", ["0", "1", "2"])])
def test_numbers_from_zero(launch, length, expected):
    loop = ForLoop(length, function=lambda number: [LogInfo(msg=str(number))])
    assert launch(loop).messages == expected


def test_a_length_that_is_no_number(launch):
    outcome = launch(ForLoop("x", function=lambda _: []))
    assert outcome.status == 1
    assert outcome.error == "invalid literal for int() with base 10: 'x'"


def test_loops_in_files(launch_file):
    outcome = launch_file("""
    <arg name="count" default="2"/>
    <for len="$(var count)" name="i">
      <for_each values="{name: 'a', id: 1};{id: 2}">
        <log_info message="$(index i) $(for-var id) $(for-var name nobody)"/>
        <executable cmd="true"/>
      </for_each>
      <for len="1" name="i"><log_info message="inner $(index i)"/></for>
      <log_info message="outer $(index i)"/>
    </for>
    <log_info message="$(for-var id gone)"/>""")
    assert outcome.status == 0
    assert outcome.messages == [
        "0 1 a", "0 2 nobody", "inner 0", "outer 0",
        "1 1 a", "1 2 nobody", "inner 0", "outer 1",
        "gone",
    ]  # fmt: skip


def test_values_outside_of_loops(context):
    assert ForEachVar("x", default_value="default").perform(context) == "default"
    for variable, kind in ((ForEachVar("x"), "ForEachVar"), (ForLoopIndex("x"), "ForLoopIndex")):
        with pytest.raises(
            RuntimeError, match=f"^No value available for {kind} 'x' and no default value provided$"
        ):
            variable.perform(context)


def test_logs_have_levels(launch, launch_file):
    outcome = launch(Log(msg="a", level="fatal"), LogWarning(msg="b"))
    assert logged(outcome) == [("CRITICAL", "a"), ("WARNING", "b")]
    outcome = launch_file("""
    <let name="how" value="error"/>
    <log level="$(var how)" message="c"/><log_debug message="d"/><log_info message="e"/>
    <log_warning message="f"/><log_error message="g"/>""")
    # DEBUG is below the level that is shown.
    assert logged(outcome) == [("ERROR", "c"), ("INFO", "e"), ("WARNING", "f"), ("ERROR", "g")]


def test_a_level_that_does_not_exist(context):
    with pytest.raises(KeyError, match="Invalid log level 'LOUD', expected: dict_keys"):
        Log(msg="x", level="loud").execute(context)


def test_a_log_without_a_level_is_warned_of_in_lyrical(launch_file, monkeypatch):
    assert launch_file('<log message="jazzy"/>').messages == ["jazzy"]
    monkeypatch.setenv("ROS_DISTRO", "lyrical")
    with pytest.warns(UserWarning, match="The action log now expects a log level"):
        outcome = launch_file('<log message="lyrical"/>')
    assert outcome.messages == ["lyrical"]


@pytest.mark.parametrize(
    ("default", "value"), [(True, "True"), (False, "False"), ("true", "true"), ("FALSE", "FALSE")]
)
def test_boolean_arguments(context, default, value):
    DeclareBooleanLaunchArgument("flag", default_value=default).execute(context)
    assert LaunchConfiguration("flag").perform(context) == value


def test_boolean_arguments_of_other_values(context):
    context.launch_configurations["flag"] = "maybe"
    with pytest.raises(RuntimeError) as refused:
        DeclareBooleanLaunchArgument("flag", default_value="true").execute(context)
    assert str(refused.value) == (
        'Argument "flag" provided value "maybe" is not valid. Valid options are: '
        "['true', 'false', 'True', 'False', 'TRUE', 'FALSE']"
    )
    with pytest.raises(ValueError, match=r"^Cannot specify choices for bool_arg$"):
        DeclareBooleanLaunchArgument("flag", choices=["true"])


def test_joined_texts_and_paths(launch_file, context):
    joined = StringJoinSubstitution(["a", ["b", LaunchConfiguration("x", default="c")]], "-")
    assert joined.perform(context) == "a-bc"
    assert StringJoinSubstitution(["a", "b"]).perform(context) == "ab"
    outcome = launch_file(
        "<log_info message=\"$(string-join , a 'b c') $(path-join /a 'b' c.txt)\"/>"
    )
    assert outcome.messages == ["a,b c /a/b/c.txt"]


def test_all_environment_variables_are_replaced(launch, launch_file, monkeypatch):
    monkeypatch.setenv("BEFORE", "1")
    seen = []
    look = OpaqueFunction(
        function=lambda context: seen.append(
            [context.environment.get(name) for name in ("BEFORE", "AFTER")]
        )
    )
    launch(ReplaceEnvironmentVariables({"AFTER": "2"}), look)
    outcome = launch_file("""
    <rep_env><env name="AFTER" value="3"/></rep_env>
    <log_info message="$(env BEFORE gone) $(env AFTER)"/>""")
    assert (seen, outcome.messages) == ([[None, "2"]], ["gone 3"])
