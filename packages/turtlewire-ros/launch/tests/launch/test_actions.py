"""The effect of each action on the launch."""

import asyncio
import os

import pytest

from launch import LaunchDescription, LaunchDescriptionSource
from launch.actions import (
    AppendEnvironmentVariable,
    DeclareLaunchArgument,
    EmitEvent,
    ExecuteProcess,
    GroupAction,
    IncludeLaunchDescription,
    LogInfo,
    OpaqueCoroutine,
    OpaqueFunction,
    PopEnvironment,
    PopLaunchConfigurations,
    PushEnvironment,
    PushLaunchConfigurations,
    RegisterEventHandler,
    ResetEnvironment,
    ResetLaunchConfigurations,
    SetEnvironmentVariable,
    SetLaunchConfiguration,
    Shutdown,
    TimerAction,
    UnregisterEventHandler,
    UnsetEnvironmentVariable,
    UnsetLaunchConfiguration,
)
from launch.conditions import (
    IfCondition,
    InvalidConditionExpressionError,
    LaunchConfigurationEquals,
    LaunchConfigurationNotEquals,
    UnlessCondition,
)
from launch.event_handlers import OnShutdown
from launch.events import Shutdown as ShutdownEvent
from launch.events import TimerEvent
from launch.substitutions import (
    EnvironmentVariable,
    LaunchConfiguration,
    LocalSubstitution,
    PythonExpression,
)

COLOUR = LaunchConfiguration("colour", default="none")


def show(substitution=COLOUR):
    return LogInfo(msg=["it is ", substitution])


def test_configurations_are_global(launch):
    outcome = launch(
        SetLaunchConfiguration("colour", "green"),
        show(),
        UnsetLaunchConfiguration("colour"),
        show(),
    )
    assert outcome.messages == ["it is green", "it is none"]
    assert outcome.status == 0


def test_configurations_can_be_pushed(launch):
    change = [
        PushLaunchConfigurations(),
        SetLaunchConfiguration("colour", "red"),
        show(),
        PopLaunchConfigurations(),
        show(),
    ]
    assert launch(SetLaunchConfiguration("colour", "green"), *change).messages == [
        "it is red",
        "it is green",
    ]
    assert (
        launch(PopLaunchConfigurations()).error == "launch configurations stack unexpectedly empty"
    )


def test_configurations_can_be_reset(launch):
    kept = ResetLaunchConfigurations({"colour": [COLOUR, "ish"]})
    outcome = launch(
        SetLaunchConfiguration("colour", "green"),
        SetLaunchConfiguration("other", "1"),
        kept,
        show(),
    )
    assert outcome.messages == ["it is greenish"]
    assert "other" not in outcome.context.launch_configurations


def test_a_group_confines_what_is_set_in_it(launch, monkeypatch):
    monkeypatch.setenv("TURTLE", "outside")
    turtle = EnvironmentVariable("TURTLE")
    inside = [
        SetLaunchConfiguration("colour", "red"),
        SetEnvironmentVariable("TURTLE", "inside"),
        show(),
        show(turtle),
    ]
    outcome = launch(
        SetLaunchConfiguration("colour", "green"), GroupAction(inside), show(), show(turtle)
    )
    assert outcome.messages == ["it is red", "it is inside", "it is green", "it is outside"]


def test_a_group_without_scope_confines_nothing(launch):
    assert launch(
        GroupAction([SetLaunchConfiguration("colour", "red")], scoped=False), show()
    ).messages == ["it is red"]


def test_a_group_can_begin_with_its_own_configurations_alone(launch):
    group = GroupAction(
        [show(), show(LaunchConfiguration("other", default="gone"))],
        forwarding=False,
        launch_configurations={"colour": COLOUR},
    )
    outcome = launch(
        SetLaunchConfiguration("colour", "green"), SetLaunchConfiguration("other", "1"), group
    )
    assert outcome.messages == ["it is green", "it is gone"]


def test_environment_variables(launch, monkeypatch):
    monkeypatch.setenv("TURTLE", "a")
    monkeypatch.delenv("TURTLE_PATH", raising=False)
    turtle, path = (
        EnvironmentVariable("TURTLE", default_value="unset"),
        EnvironmentVariable("TURTLE_PATH"),
    )
    outcome = launch(
        PushEnvironment(),
        SetEnvironmentVariable("TURTLE", "b"),
        show(turtle),
        UnsetEnvironmentVariable("TURTLE"),
        show(turtle),
        PopEnvironment(),
        show(turtle),
        AppendEnvironmentVariable("TURTLE_PATH", "x"),
        AppendEnvironmentVariable("TURTLE_PATH", "y"),
        AppendEnvironmentVariable("TURTLE_PATH", "z", prepend=True, separator=";"),
        AppendEnvironmentVariable("TURTLE_PATH", "w", prepend="yes", separator=";"),
        AppendEnvironmentVariable("TURTLE_PATH", "v", prepend="no", separator=";"),
        show(path),
        SetEnvironmentVariable("TURTLE", "c"),
        ResetEnvironment(),
        show(turtle),
    )
    assert outcome.messages == [
        f"it is {value}" for value in ("b", "unset", "a", f"w;z;x{os.pathsep}y;v", "a")
    ]
    assert launch(PopEnvironment()).error == "environment stack unexpectedly empty"


def test_declared_arguments(launch):
    assert launch(DeclareLaunchArgument("colour", default_value="green"), show()).messages == [
        "it is green"
    ]
    assert launch(
        SetLaunchConfiguration("colour", "red"),
        DeclareLaunchArgument("colour", default_value="x"),
        show(),
    ).messages == ["it is red"]


def test_a_required_argument_that_is_missing(launch):
    outcome = launch(DeclareLaunchArgument("colour", description="Of the turtle."))
    said = 'Required launch argument "colour" (description: "Of the turtle.") was not provided'
    assert f"[ERROR] [launch.actions.declare_launch_argument]: {said}" in outcome.lines
    assert outcome.error == 'Required launch argument "colour" was not provided.'
    assert outcome.status == 1


def test_choices(launch):
    colours = ["red", "green"]
    with pytest.raises(ValueError, match='default_value "blue" is not in provided choices'):
        DeclareLaunchArgument("colour", choices=colours, default_value="blue")
    blue = PythonExpression("'blue'")
    argument = DeclareLaunchArgument("colour", choices=colours, default_value=blue)
    assert argument.description == "One of: ['red', 'green']"
    assert (
        launch(argument).error
        == 'Argument "colour" provided value "blue" is not valid. Valid options are: [\'red\', '
        "'green']"
    )
    with pytest.raises(ValueError, match="Provided choices are empty"):
        DeclareLaunchArgument("colour", choices=[])


def included(*entities):
    return LaunchDescriptionSource(LaunchDescription(entities), "inner.launch.py")


def test_an_include_sets_arguments_before(launch):
    inner = included(DeclareLaunchArgument("colour", default_value="x"), show())
    outcome = launch(
        IncludeLaunchDescription(inner, launch_arguments=[("colour", "green")]), show()
    )
    assert outcome.messages == ["it is green", "it is green"]


def test_an_include_asks_for_required_arguments(launch):
    inner = included(DeclareLaunchArgument("colour", description="Of the turtle."))
    outcome = launch(IncludeLaunchDescription(inner, launch_arguments=[("a", "1"), ("b", "2")]))
    expected = (
        "Included launch description missing required argument 'colour' (description: 'Of the "
        "turtle.'), given: [a, b]"
    )
    assert outcome.error == expected


def test_an_included_file_knows_its_path(launch, tmp_path):
    inner = tmp_path / "inner.launch.xml"
    inner.write_text('<launch><log message="$(filename) in $(dirname)"/></launch>')
    outer = tmp_path / "outer.launch.yaml"
    outer.write_text(
        "launch:\n- include: {file: $(dirname)/inner.launch.xml}\n- log: {message: back in "
        "$(filename)}\n"
    )
    outcome = launch(IncludeLaunchDescription(str(outer)))
    assert outcome.messages == [f"{inner} in {tmp_path}", f"back in {outer}"]


def test_functions(launch):
    seen = []

    def function(context, first, *, second):
        seen.append((first, second))
        return [show()] if "colour" in context.launch_configurations else None

    call = {"function": function, "args": [1], "kwargs": {"second": 2}}
    assert launch(
        OpaqueFunction(**call), SetLaunchConfiguration("colour", "red"), OpaqueFunction(**call)
    ).messages == ["it is red"]
    assert seen == [(1, 2), (1, 2)]
    with pytest.raises(TypeError, match="expected a callable"):
        OpaqueFunction(function=3)


def test_coroutines_run_until_the_launch_ends(launch):
    seen = []

    async def coroutine(name):
        seen.append(name)
        try:
            await asyncio.get_running_loop().create_future()
        except asyncio.CancelledError:
            seen.append("cancelled")
            raise

    endless = OpaqueCoroutine(coroutine=coroutine, args=["a"], ignore_context=True)
    again = TimerAction(period=0.0, actions=[endless, Shutdown()])
    assert launch(endless, again).status == 0
    assert seen == ["a", "a", "cancelled", "cancelled"]
    with pytest.raises(TypeError, match="expected a coroutine function"):
        OpaqueCoroutine(coroutine=print)


def test_a_coroutine_that_fails_ends_the_launch(launch):
    async def coroutine(_context):
        raise ValueError("boom")

    outcome = launch(OpaqueCoroutine(coroutine=coroutine), ExecuteProcess(cmd=["sleep", "100"]))
    assert (outcome.status, outcome.error) == (1, "boom")


def test_timers(launch):
    outcome = launch(
        TimerAction(period=0.02, actions=[LogInfo(msg="second")]),
        TimerAction(period="0.01", actions=[LogInfo(msg="first")]),
    )
    assert outcome.messages == ["first", "second"]


def test_a_timer_in_a_group_keeps_what_the_group_set(launch, monkeypatch):
    monkeypatch.delenv("TIMED", raising=False)
    outcome = launch(
        GroupAction(
            [
                SetLaunchConfiguration("colour", "green"),
                SetEnvironmentVariable("TIMED", "inside"),
                TimerAction(
                    period=0.01,
                    actions=[show(), show(EnvironmentVariable("TIMED", default_value="-"))],
                ),
            ]
        ),
        TimerAction(period=0.5, actions=[show(), SetLaunchConfiguration("colour", "red"), show()]),
        show(),
        TimerAction(
            period=1.0, actions=[show(), show(EnvironmentVariable("TIMED", default_value="-"))]
        ),
    )
    # Outside of a scope, a timer sees the values of its moment, and what it sets stays.
    assert outcome.messages == [
        f"it is {value}" for value in ("none", "green", "inside", "none", "red", "red", "-")
    ]


def test_each_visit_of_a_timer_has_its_own_time_and_values(launch):
    timer = TimerAction(period=0.01, actions=[show()])
    outcome = launch(
        GroupAction([SetLaunchConfiguration("colour", "red"), timer]),
        GroupAction([SetLaunchConfiguration("colour", "green"), timer]),
        TimerAction(period=0.5, actions=[timer]),
    )
    assert outcome.messages == ["it is red", "it is green", "it is none"]


def test_the_end_cancels_each_visit_of_a_timer(launch):
    timer = TimerAction(period=100.0, actions=[LogInfo(msg="never")])
    assert launch(timer, timer, TimerAction(period=0.0, actions=[Shutdown()])).messages == []


def test_a_program_may_emit_the_event_of_a_timer(launch):
    timer = TimerAction(period=100.0, actions=[LogInfo(msg="early"), Shutdown()])
    assert launch(timer, EmitEvent(event=TimerEvent(timer_action=timer))).messages == ["early"]


def test_the_end_cancels_timers_unless_told_otherwise(launch):
    late = TimerAction(period=100.0, actions=[LogInfo(msg="never")])
    still = TimerAction(period=0.01, actions=[LogInfo(msg="still")], cancel_on_shutdown=False)
    assert launch(late, still, Shutdown()).messages == ["still"]


def test_a_timer_that_is_cancelled_before_its_start_does_not_start(launch):
    timer = TimerAction(period=0.0, actions=[LogInfo(msg="never")])
    timer.cancel()
    timer.cancel()
    assert launch(timer).messages == []
    assert timer.get_asyncio_future() is None


def test_a_timer_can_be_cancelled_twice_and_after_its_time(launch):
    late = TimerAction(period=100.0, actions=[LogInfo(msg="never")])

    def cancel(_context):
        late.cancel()
        late.cancel()

    outcome = launch(late, OpaqueFunction(function=cancel))
    assert (outcome.status, outcome.messages) == (0, [])
    over = TimerAction(period=0.0, actions=[LogInfo(msg="over")])
    assert launch(over).messages == ["over"]
    over.cancel()


def test_a_timer_can_be_cancelled_just_before_its_actions(launch):
    late = TimerAction(period=0.0, actions=[LogInfo(msg="never")])
    first = TimerAction(period=0.0, actions=[OpaqueFunction(function=lambda _: late.cancel())])
    assert launch(first, late).messages == []


@pytest.mark.parametrize(("period", "status"), [("abc", 1), (100.0, 0)])
def test_a_timer_that_never_expires_leaves_no_handler(launch, period, status):
    timer = TimerAction(period=period, actions=[LogInfo(msg="never")])
    outcome = launch(timer, OpaqueFunction(function=lambda _: timer.cancel()))
    assert (outcome.status, outcome.messages) == (status, [])
    assert not outcome.context.would_handle_event(TimerEvent(timer_action=timer))
    assert timer.get_asyncio_future() is None or timer.get_asyncio_future().done()


def test_shutdown_tells_why(launch):
    why = OnShutdown(on_shutdown=[LogInfo(msg=["why: ", LocalSubstitution("event.reason")])])
    assert launch(RegisterEventHandler(why), Shutdown(reason="enough")).messages == ["why: enough"]
    assert (
        launch(
            RegisterEventHandler(why), UnregisterEventHandler(why), EmitEvent(event=ShutdownEvent())
        ).messages
        == []
    )
    assert launch(RegisterEventHandler(why)).messages == ["why: idle"]
    assert "not in deque" in launch(UnregisterEventHandler(why)).error


def test_only_events_are_emitted():
    with pytest.raises(
        TypeError, match="Expected 'event' of EmitEvent to be of type 'Event', but got 'x'"
    ):
        EmitEvent(event="x")


# Conditions of actions.


@pytest.mark.parametrize(
    ("text", "holds"),
    [("true", True), ("True", True), ("1", True), (" 1 ", True), ("FALSE", False), ("0", False)],
)
def test_texts_that_are_true_or_false(context, text, holds):
    assert IfCondition(text).evaluate(context) is holds
    assert UnlessCondition(text).evaluate(context) is not holds


def test_other_texts_are_refused(context):
    expected = (
        r"invalid condition expression, expected one of 'true\|1' or 'false\|0' but got 'yes'"
    )
    with pytest.raises(InvalidConditionExpressionError, match=expected):
        IfCondition("yes").evaluate(context)


def test_values_of_configurations(context):
    context.launch_configurations["mode"] = "a"
    assert LaunchConfigurationEquals("mode", "a").evaluate(context)
    assert not LaunchConfigurationEquals("mode", "b").evaluate(context)
    assert LaunchConfigurationEquals("nothing", None).evaluate(context)
    assert LaunchConfigurationNotEquals("mode", "b").evaluate(context)


def test_a_condition_is_asked_at_each_visit(launch):
    condition = IfCondition(LaunchConfiguration("go"))
    outcome = launch(
        SetLaunchConfiguration("go", "false"),
        LogInfo(msg="first", condition=condition),
        SetLaunchConfiguration("go", "true"),
        LogInfo(msg="second", condition=condition),
    )
    assert outcome.messages == ["second"]
    assert condition.evaluated_value() is True


def test_a_wrong_condition_ends_the_launch(launch):
    outcome = launch(LogInfo(msg="x", condition=IfCondition("maybe")), LogInfo(msg="y"))
    assert outcome.status == 1
    assert outcome.error.endswith("but got 'maybe'")
    assert outcome.messages == []
