"""The methods of a node for its parameters."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from rclpy._node.checks import check_callable

if TYPE_CHECKING:
    from rcl_interfaces.msg import ListParametersResult, ParameterDescriptor, SetParametersResult
    from rclpy._node.parameters import NodeParameters
    from rclpy.parameter import Parameter

_NOT_CALLABLE = "Callback must be callable, got {}"  # ROS 2 does not fill it in


class ParameterMethods:
    """The part of :class:`~rclpy._node.base.BaseNode` that has the parameters."""

    _parameters: NodeParameters

    def declare_parameter(
        self,
        name: str,
        value: Any = None,
        descriptor: ParameterDescriptor | None = None,
        ignore_override: bool = False,
    ) -> Parameter:
        """Declare a parameter.

        Args:
            name: Its name.
            value: Default value, or a :class:`Parameter.Type <rclpy.parameter.Parameter.Type>` for
                a parameter without one.
            descriptor: Description, ranges, whether it is read-only or may change its type.
            ignore_override: Whether ``value`` goes before what the command line says.

        Returns:
            The parameter, with the override as its value if there is one.

        Raises:
            ParameterAlreadyDeclaredException: The parameter is already declared.
            InvalidParameterException: The name is not valid.
            InvalidParameterTypeException: The override has another type.
            InvalidParameterValueException: A callback or the descriptor rejects the value.
        """
        return self._parameters.declare_parameter(name, value, descriptor, ignore_override)

    def declare_parameters(
        self, namespace: str, parameters: list[Any], ignore_override: bool = False
    ) -> list[Parameter]:
        """Declare several parameters, each as ``(name[, value or type[, descriptor]])``.

        Their names follow ``namespace`` and a dot.
        """
        return self._parameters.declare_parameters(namespace, parameters, ignore_override)

    def undeclare_parameter(self, name: str) -> None:
        """Forget a parameter.

        Raises:
            ParameterNotDeclaredException: The parameter is not declared.
            ParameterImmutableException: The parameter is read-only.
        """
        self._parameters.undeclare_parameter(name)

    def has_parameter(self, name: str) -> bool:
        """Return True if a parameter is declared."""
        return self._parameters.has_parameter(name)

    def get_parameter(self, name: str) -> Parameter:
        """Return a parameter.

        Raises:
            ParameterNotDeclaredException: The parameter is not declared, and undeclared parameters
                are not allowed.
            ParameterUninitializedException: The parameter was declared only with a type, and has no
                value yet.
        """
        return self._parameters.get_parameter(name)

    def get_parameters(self, names: list[str]) -> list[Parameter]:
        """Return several parameters; raises as :meth:`get_parameter`."""
        return self._parameters.get_parameters(names)

    def get_parameter_or(self, name: str, alternative_value: Parameter | None = None) -> Parameter:
        """Return a parameter, or ``alternative_value`` when it is not declared or not set."""
        return self._parameters.get_parameter_or(name, alternative_value)

    def get_parameters_by_prefix(self, prefix: str) -> dict[str, Parameter]:
        """Return the parameters below a prefix, by their names without it."""
        return self._parameters.get_parameters_by_prefix(prefix)

    def get_parameter_type(self, name: str) -> Any:
        """Return the number of a parameter's type; raise `ParameterNotDeclaredException`."""
        return self._parameters.get_parameter_type(name)

    def get_parameter_types(self, names: list[str]) -> list[Any]:
        """Return the types of several parameters, as :meth:`get_parameter_type` does."""
        return self._parameters.get_parameter_types(names)

    def set_parameters(self, parameter_list: list[Parameter]) -> list[SetParametersResult]:
        """Set parameters one by one; each result says whether it was accepted, and why not.

        Raises:
            ParameterNotDeclaredException: A parameter is not declared, and undeclared parameters
                are not allowed; the preceding parameters are set.
        """
        return self._parameters.set_parameters(parameter_list)

    def set_parameters_atomically(self, parameter_list: list[Parameter]) -> SetParametersResult:
        """Set all parameters, or none; raise `ParameterNotDeclaredException` for unknown ones."""
        return self._parameters.set_parameters_atomically(parameter_list)

    def list_parameters(self, prefixes: list[str], depth: int) -> ListParametersResult:
        """Return the names of parameters below prefixes, down to ``depth`` dots (0: all)."""
        return self._parameters.list_parameters(prefixes, depth)

    def describe_parameter(self, name: str) -> ParameterDescriptor:
        """Return a parameter's descriptor with its present type, empty if it is undeclared.

        Raises:
            ParameterNotDeclaredException: The parameter is not declared, and undeclared parameters
                are not allowed.
        """
        return self._parameters.describe_parameter(name)

    def describe_parameters(self, names: list[str]) -> list[ParameterDescriptor]:
        """Return several descriptors; raises as :meth:`describe_parameter`."""
        return self._parameters.describe_parameters(names)

    def set_descriptor(
        self, name: str, descriptor: ParameterDescriptor, alternative_value: Any = None
    ) -> Any:
        """Replace a descriptor, and the value by ``alternative_value`` if it does not fit.

        Returns:
            The value that the parameter has now.

        Raises:
            ParameterNotDeclaredException: The parameter is not declared, and undeclared parameters
                are not allowed.
            ParameterImmutableException: The parameter is read-only.
            InvalidParameterValueException: Neither value agrees with the descriptor.
        """
        return self._parameters.set_descriptor(name, descriptor, alternative_value)

    def add_pre_set_parameters_callback(
        self, callback: Callable[[list[Parameter]], list[Parameter]]
    ) -> None:
        """Let ``callback`` see and change the list of parameters before they are checked."""
        # As in ROS 2, the newest callback comes first.
        self._parameters.callbacks.before.insert(0, callback)

    def add_on_set_parameters_callback(
        self, callback: Callable[[list[Parameter]], SetParametersResult]
    ) -> None:
        """Let ``callback`` accept or reject new values; TypeError if it is not callable."""
        check_callable(callback, _NOT_CALLABLE, type(callback))
        self._parameters.callbacks.deciding.insert(0, callback)

    def add_post_set_parameters_callback(self, callback: Callable[[list[Parameter]], None]) -> None:
        """Call ``callback`` with parameters that were set; TypeError if it is not callable."""
        check_callable(callback, _NOT_CALLABLE, type(callback))
        self._parameters.callbacks.after.insert(0, callback)

    def remove_pre_set_parameters_callback(
        self, callback: Callable[[list[Parameter]], list[Parameter]]
    ) -> None:
        """Undo :meth:`add_pre_set_parameters_callback`; ValueError when it was not added."""
        self._parameters.callbacks.before.remove(callback)

    def remove_on_set_parameters_callback(
        self, callback: Callable[[list[Parameter]], SetParametersResult]
    ) -> None:
        """Undo :meth:`add_on_set_parameters_callback`; ValueError when it was not added."""
        self._parameters.callbacks.deciding.remove(callback)

    def remove_post_set_parameters_callback(
        self, callback: Callable[[list[Parameter]], None]
    ) -> None:
        """Undo :meth:`add_post_set_parameters_callback`; ValueError when it was not added."""
        self._parameters.callbacks.after.remove(callback)
