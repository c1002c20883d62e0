"""Conditions of actions."""

from __future__ import annotations

import pytest

from launch.actions import LogInfo, SetLaunchConfiguration
from launch.conditions import (
    IfCondition,
    InvalidConditionExpressionError,
    LaunchConfigurationEquals,
    LaunchConfigurationNotEquals,
    UnlessCondition,
)
from launch.substitutions import LaunchConfiguration


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
