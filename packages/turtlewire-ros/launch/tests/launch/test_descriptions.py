"""Descriptions of entities and substitutions; parts of the API used outside launch files."""

import asyncio
import sys
from typing import List  # noqa: UP035  as ROS 2's callers write it

import pytest

from launch import LaunchContext, LaunchDescription, LaunchIntrospector, LaunchService, Substitution
from launch.action import Action
from launch.actions import (
    AppendEnvironmentVariable,
    DeclareLaunchArgument,
    EmitEvent,
    ExecuteProcess,
    GroupAction,
    IncludeLaunchDescription,
    LogInfo,
    OpaqueFunction,
    RegisterEventHandler,
    SetEnvironmentVariable,
    SetLaunchConfiguration,
    TimerAction,
    UnregisterEventHandler,
    UnsetEnvironmentVariable,
    UnsetLaunchConfiguration,
)
from launch.conditions import IfCondition, UnlessCondition
from launch.descriptions import Executable
from launch.event import Event
from launch.event_handlers import OnProcessExit, OnProcessStart, OnShutdown, event_named
from launch.events import Shutdown, matches_action
from launch.events.process import ShutdownProcess
from launch.frontend import Parser
from launch.frontend.expose import action_parse_methods
from launch.frontend.parse_substitution import parse_if_substitutions, parse_substitution
from launch.launch_description_source import LaunchDescriptionSource
from launch.substitutions import (
    AnonName,
    LaunchConfiguration,
    PathJoinSubstitution,
    PathSubstitution,
    TextSubstitution,
)
from launch.utilities import (
    isclassinstance,
    normalize_to_list_of_entities,
    visit_all_entities_and_collect_futures,
)
from launch.utilities.type_utils import (
    coerce_list,
    extract_type,
    get_typed_value,
    is_instance_of,
    is_normalized_substitution,
    is_substitution,
    normalize_typed_substitution,
    perform_typed_substitution,
)

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
        ("$(var a b c)", "var substitution expects 1 or 2 arguments"),
        ("$(env a b c)", "env substitution expects 1 or 2 arguments"),
        ("$(anon)", "anon substitution expects 1 argument"),
        ("$(not true false)", "not substitution expects 1 argument"),
        ("$(and true)", "AndSubstitution expects 2 arguments"),
        ("$(equals a)", "EqualsSubstitution expects 2 arguments"),
        ("$(if true)", "if substitution expects 2 or 3 arguments"),
        ("$(if true a b c)", "if substitution expects 2 or 3 arguments"),
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


# Parts of launch's API that programs use outside launch files.


def test_an_action_is_stopped_by_its_matcher(launch):
    process = ExecuteProcess(cmd=[sys.executable, "-c", "input()"], name="waits")
    assert process.name[0].text == "waits"
    stop = EmitEvent(event=ShutdownProcess(process_matcher=matches_action(process)))
    outcome = launch(process, RegisterEventHandler(OnProcessStart(on_start=stop)))
    assert outcome.status == 0
    assert process.name.startswith("waits-")
    assert process.return_code not in (None, 0, 255)


def test_a_launch_knows_its_task():
    service = LaunchService()
    assert service.task is None
    seen = []
    look = OpaqueFunction(function=lambda _: seen.append(service.task))
    service.include_launch_description(LaunchDescription([look]))

    async def run():
        task = asyncio.ensure_future(service.run_async())
        await task
        return task

    assert asyncio.run(run()) is seen[0] is service.task


def test_more_descriptions():
    assert IfCondition(LaunchConfiguration("x")).describe() == "IfCondition(LaunchConfig('x'))"
    assert UnlessCondition("true").describe() == "UnlessCondition('true')"
    assert "LaunchDescription" in LaunchDescription().describe()
    inner = LogInfo(msg="x")
    assert GroupAction([inner], scoped=False).get_sub_entities() == [inner]
    assert inner.get_sub_entities() == inner.describe_sub_entities() == []
    appended = AppendEnvironmentVariable("PATH", "x", prepend=True, separator=";")
    assert [appended.prepend[0].text, appended.separator[0].text] == ["True", ";"]
    described = Executable(cmd=["a"], arguments=["b"])
    assert [described.arguments[0][0].text, described.cmd[1][0].text] == ["b", "b"]


def test_event_handlers():
    assert event_named("launch.Event")(Event())
    assert not event_named("launch.events.Shutdown")(Event())
    timer = TimerAction(period=1.0, actions=[LogInfo(msg="x")])
    assert timer.handle(LaunchContext()) == timer.actions


def test_entities(context):
    inner, outer = LogInfo(msg="x"), OnShutdown(on_shutdown=[])
    assert normalize_to_list_of_entities([inner, [[inner], LaunchDescription()]])[:2] == [inner] * 2
    with pytest.raises(TypeError, match="expected launch entities"):
        normalize_to_list_of_entities([outer])
    loop = asyncio.new_event_loop()
    done = loop.create_future()
    loop.close()

    class Slow(Action):
        def get_asyncio_future(self):
            return done

    nested = LaunchDescription([GroupAction([Slow(), inner], scoped=False), Slow()])
    assert visit_all_entities_and_collect_futures(nested, context) == [done, done]
    assert [isclassinstance(each) for each in (inner, LogInfo, print, sys)] == [
        True,
        False,
        False,
        False,
    ]


def test_every_exposed_action_is_read_as_itself():
    Parser.load_launch_extensions()
    assert [name for name, parse in action_parse_methods.items() if parse is Action.parse] == []


def test_parsers():
    assert Parser.get_parser_from_extension(".xml").__module__ == "launch_xml.parser"
    assert [each.__module__ for each in Parser.get_parsers_from_filename("a.launch.yml")] == [
        "launch_yaml.parser"
    ]
    assert [Parser.is_filename_valid(name) for name in ("a.xml", "a.py")] == [True, False]
    with pytest.raises(RuntimeError, match="no parser of 'py', only of xml"):
        Parser.get_parser_from_extension("py")
    parts = parse_if_substitutions(["$(var x)", 3])
    assert [type(parts[0][0]).__name__, parts[1]] == ["LaunchConfiguration", 3]


def test_a_deprecated_file_and_kept_configurations(launch, tmp_path):
    from launch.actions import IncludeLaunchDescription
    from launch.launch_description_sources import AnyLaunchDescriptionSource

    xml = tmp_path / "a.launch.xml"
    xml.write_text('<launch deprecated="use b"><log message="in it"/></launch>')
    yaml = tmp_path / "b.launch.yaml"
    yaml.write_text(
        "launch:\n- group:\n    forwarding: false\n    keep:\n    - {name: who, value: kept}\n"
        "    children:\n    - log: {message: $(var who)}\n- reset: {}\n"
    )
    found = AnyLaunchDescriptionSource(str(xml)).try_get_launch_description_without_context()
    assert (found.deprecated, found.deprecated_reason) == (True, "use b")
    outcome = launch(IncludeLaunchDescription(AnyLaunchDescriptionSource(str(yaml))))
    assert (outcome.status, outcome.messages) == (0, ["kept"])


def test_typed_values(context):
    assert [get_typed_value(text, bool) for text in ("yes", "on", "off")] == [True, True, False]
    assert get_typed_value("[1, 2]", List[int]) == [1, 2]  # noqa: UP006
    assert get_typed_value(["1.5", "2"], list[float]) == [1.5, 2.0]
    assert coerce_list(["1", "a"], int, can_be_str=True) == [1, "a"]
    assert coerce_list(["1", "2.5"]) == [1.0, 2.5]
    assert coerce_list(["1", "a"], can_be_str=True) == [1, "a"]
    for mixed in (["1", "a"], ["1", "true"], ["2.5", "a"]):
        with pytest.raises(ValueError, match="it is not uniform"):
            coerce_list(mixed)
    assert [extract_type(kind) for kind in (None, bool, list, list[str])] == [
        (None, False),
        (bool, False),
        (None, True),
        (str, True),
    ]
    assert [is_instance_of(1, float), is_instance_of([1, 2], list[int])] == [False, True]
    with pytest.raises(ValueError, match="Failed to convert 'x' to 'int' using yaml rules"):
        get_typed_value("x", int)
    assert is_substitution(["a", TextSubstitution(text="b")])
    assert not is_substitution(["a"])
    normalized = normalize_typed_substitution(LaunchConfiguration("n"), int)
    assert is_normalized_substitution(normalized)
    context.launch_configurations["n"] = "3"
    assert perform_typed_substitution(context, normalized, int) == 3
    assert normalize_typed_substitution(3, float) == 3.0
    with pytest.raises(TypeError, match="value='3' is not an instance of"):
        normalize_typed_substitution(3, bool)
    assert AnonName("base").compute_name("x").startswith("x_")
