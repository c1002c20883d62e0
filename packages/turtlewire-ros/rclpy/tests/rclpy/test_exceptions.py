from __future__ import annotations

import pytest

from rclpy import exceptions
from rclpy.parameter import Parameter


@pytest.mark.parametrize(
    ("error", "text"),
    [
        (exceptions.NotInitializedException(), "rclpy.init() has not been called"),
        (
            exceptions.NotInitializedException("cannot create node"),
            "rclpy.init() has not been called. msg:cannot create node",
        ),
        (exceptions.NoTypeSupportImportedException(), "no type_support imported"),
        (exceptions.ROSInterruptException(), "rclpy.shutdown() has been called"),
        (
            exceptions.ParameterNotDeclaredException(["a"]),
            "Invalid access to undeclared parameter(s): ['a']",
        ),
        (
            exceptions.ParameterAlreadyDeclaredException(["a"]),
            "Parameter(s) already declared: ['a']",
        ),
        (exceptions.InvalidParameterException(""), "Invalid parameter name: "),
        (exceptions.ParameterImmutableException("a"), "Attempted to modify read-only parameter: a"),
        (exceptions.ParameterUninitializedException("a"), "The parameter is not initialized: a"),
        (
            exceptions.InvalidParameterTypeException(Parameter("a", value=2), "STRING"),
            "Trying to set parameter 'a' to '2' of type 'INTEGER', expecting type 'STRING'",
        ),
    ],
)
def test_texts(error, text):
    assert str(error) == text


def test_hints_are_notes():
    error = exceptions.ParameterNotDeclaredException("a").with_hint("declared are ['b'].")
    assert error.hint == "declared are ['b']."
    assert getattr(error, "__notes__", [error.hint]) == [error.hint]
