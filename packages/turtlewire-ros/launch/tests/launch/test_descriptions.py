"""Descriptions and properties of entities and substitutions that do not run."""

import pytest

from launch import LaunchContext, LaunchDescription, LaunchIntrospector, Substitution
from launch.actions import (
    DeclareLaunchArgument,
    EmitEvent,
    ExecuteProcess,
    GroupAction,
    IncludeLaunchDescription,
    LogInfo,
    RegisterEventHandler,
    SetEnvironmentVariable,
    SetLaunchConfiguration,
    TimerAction,
    UnregisterEventHandler,
    UnsetEnvironmentVariable,
    UnsetLaunchConfiguration,
)
from launch.conditions import IfCondition
from launch.event_handlers import OnProcessExit, OnShutdown
from launch.events import Shutdown
from launch.frontend.parse_substitution import parse_substitution
from launch.launch_description_source import LaunchDescriptionSource
from launch.substitutions import PathJoinSubstitution, PathSubstitution

SHOWN = {
    "text": "'text'",
    "$(var a)": "LaunchConfig('a')",
    "$(env A)": "EnvVar('A')",
    "$(anon a)": "AnonName('a')",
    "$(not true)": "NotSubstitution('true')",
    "$(and true false)": "AndSubstitution('true' 'false')",
    "$(or true $(var a))": "OrSubstitution('true' LaunchConfig('a'))",
    "$(any true false 1)": "AnySubstitution('true' 'false' '1')",
    "$(equals a b)": "EqualsSubstitution('a' 'b')",
    "$(not-equals a b)": "NotEqualsSubstitution('a' 'b')",
    "$(if true a b)": "IfElseSubstitution('true', 'a', 'b')",
    "$(eval 1+1)": "PythonExpr('1+1', ['math'])",
    "$(command 'ls -l')": "Command('ls -l')",
    "$(find-exec ls)": "FindExec('ls')",
    "$(file-content /a)": "FileContent('/a')",
    "$(log_dir)": "LaunchLogDir()",
    "$(filename)": "ThisLaunchFile()",
    "$(dirname)": "ThisLaunchFileDir()",
}


@pytest.mark.parametrize("text", SHOWN)
def test_substitutions_are_shown(text):
    (substitution,) = parse_substitution(text)
    assert substitution.describe() == SHOWN[text]


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("$(var)", "var substitution expects 1 or 2 arguments"),
        ("$(env a b c)", "env substitution expects 1 or 2 arguments"),
        ("$(anon)", "anon substitution expects 1 argument"),
        ("$(not true false)", "not substitution expects 1 argument"),
        ("$(and true)", "AndSubstitution expects 2 arguments"),
        ("$(equals a)", "EqualsSubstitution expects 2 arguments"),
        ("$(if true)", "if substitution expects 2 or 3 arguments"),
        ("$(eval)", "eval substitution expects 1 or 2 arguments"),
        ("$(file-content)", "file-content substitution expects 1 argument"),
        ("$(log_dir x)", "launch_log_dir substitution expects no arguments"),
        ("$(filename x)", "filename substitution expects no arguments"),
        ("$(dirname x)", "dirname substitution expects no arguments"),
    ],
)
def test_substitutions_with_the_wrong_number_of_arguments(text, error):
    with pytest.raises(TypeError, match=f"^{error}$"):
        parse_substitution(text)


def test_paths_grow():
    path = PathSubstitution("a") / "b" / ["c", "d"]
    assert path.perform(LaunchContext()) == "a/b/cd"
    assert path.describe() == "PathJoin('a', 'b', 'c' + 'd')"
    assert [len(part) for part in PathJoinSubstitution(["a", ["b", "c"]]).substitutions] == [1, 2]


def test_a_substitution_of_a_user_says_what_it_lacks():
    class Mine(Substitution):
        pass

    assert "Mine object at" in Mine().describe()
    with pytest.raises(NotImplementedError, match=r"^Mine does not define perform\(\)$"):
        Mine().perform(LaunchContext())


@pytest.mark.parametrize(
    "action",
    [
        SetLaunchConfiguration("a", "b"),
        SetEnvironmentVariable("a", "b"),
        UnsetLaunchConfiguration("a"),
        UnsetEnvironmentVariable("a"),
    ],
)
def test_actions_on_variables_know_name_and_value(action):
    assert [part.text for part in action.name] == ["a"]
    if hasattr(action, "value"):
        assert [part.text for part in action.value] == ["b"]


def test_actions_show_what_follows_them():
    log = LogInfo(msg="x")
    process = ExecuteProcess(cmd=["true"], on_exit=[log])
    (condition, entities), *more = process.describe_conditional_sub_entities()
    assert condition.endswith(" exits")
    assert (entities, more) == ([log], [])
    assert ExecuteProcess(cmd=["true"]).describe_conditional_sub_entities() == []
    timer = TimerAction(period=1.5, actions=[log])
    assert timer.describe() == "TimerAction(period='1.5', actions=<actions>)"
    assert timer.describe_conditional_sub_entities() == [("after '1.5' sec", [log])]
    handler = OnShutdown(on_shutdown=[log])
    register = RegisterEventHandler(handler)
    assert register.describe_conditional_sub_entities() == [("event is Shutdown", [log])]
    silent = RegisterEventHandler(OnProcessExit(target_action=process, on_exit=[]))
    assert silent.describe_conditional_sub_entities() == []
    assert UnregisterEventHandler(handler).event_handler is register.event_handler is handler


def test_the_tree_of_groups_and_events():
    description = LaunchDescription(
        [GroupAction([LogInfo(msg="x")], scoped=False), EmitEvent(event=Shutdown())]
    )
    first, group, *rest = LaunchIntrospector().format_launch_description(description).splitlines()
    assert first == str(description)
    assert group.startswith("├── Action('<launch.actions.group_action.GroupAction object at ")
    assert rest == ["│   └── LogInfo('x')", "└── EmitEvent(event='launch.events.Shutdown')"]


def test_arguments_are_found_once_and_conditions_are_remembered():
    plain, hidden = DeclareLaunchArgument("plain"), DeclareLaunchArgument("hidden", description="d")
    inner = LaunchDescription([hidden, DeclareLaunchArgument("plain")])
    include = IncludeLaunchDescription(LaunchDescriptionSource(inner))
    group = GroupAction([include], condition=IfCondition("false"))
    description = LaunchDescription([plain, group])
    assert description.get_launch_arguments() == [plain, hidden]
    assert (plain.conditionally_included, hidden.conditionally_included) == (False, True)
    found = description.get_launch_arguments_with_include_launch_description_actions()
    assert found == [(plain, []), (hidden, [include])]
    assert [argument.name for argument in description.get_launch_arguments(True)] == [
        "plain",
        "hidden",
    ]
    assert plain.conditionally_included


def test_a_deprecated_description_warns(launch):
    description = LaunchDescription([], deprecated_reason="use b.launch.py")
    assert description.deprecated
    assert description.deprecated_reason == "use b.launch.py"
    assert not LaunchDescription().deprecated
    description.add_action(LogInfo(msg="x"))
    outcome = launch(description)
    assert "This LaunchDescription is deprecated: use b.launch.py" in outcome.text
    assert outcome.messages == ["x"]


def test_sources_tell_what_they_would_read():
    source = LaunchDescriptionSource(location=["a/", "b"], method="a test")
    assert source.location == "'a/' + 'b'"
    assert source.method == "a test"
    with pytest.raises(NotImplementedError, match="was made without a launch description"):
        source.get_launch_description(LaunchContext())
    assert source.location == "a/b"
    unknown = LaunchDescriptionSource(location=parse_substitution("$(var x)"))
    assert unknown.try_get_launch_description_without_context() is None
