"""The parameters of one node: declared, read, set, described, with callbacks and events.

``Node`` delegates to this module.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable, Sequence
from copy import copy
from typing import TYPE_CHECKING, Any

from rclpy._node.declarations import (
    WRONG_TYPE,
    default,
    new_descriptor,
    override,
    read_declaration,
    refusal,
    yaml_hint,
)
from rclpy._node.declared import DeclaredParameters
from rclpy.exceptions import (
    InvalidParameterTypeException,
    InvalidParameterValueException,
    ParameterAlreadyDeclaredException,
    ParameterImmutableException,
    ParameterNotDeclaredException,
)
from rclpy.impl.hints import described, with_hint
from rclpy.parameter import PARAMETER_SEPARATOR_STRING, Parameter
from rclpy.validate_parameter_name import validate_parameter_name

if TYPE_CHECKING:
    import rcl_interfaces.msg
    from rcl_interfaces.msg import (
        ParameterDescriptor,
        ParameterEvent,
        ParameterValue,
        SetParametersResult,
    )
    from rclpy.time import Time

_EMPTY_LIST = (
    "parameter list cannot be empty, this might be due to pre_set_parameters_callback modifying "
    "the original parameters list."
)


class NodeParameters(DeclaredParameters):
    """Holds the parameters of a node.

    A change goes through these steps, in ROS 2's order: callbacks before it, which may change the
    list; type, range and read-only; the deciding callbacks, newest first; the store; an event;
    callbacks after it. No lock is held over a callback. :class:`rclpy.node.Node` describes the
    methods that it has as well.

    Args:
        node_fqn: Fully qualified name of the node, for events.
        overrides: Values from the command line, which replace the declared values.
        constructor_overrides: Values that the program gave to the node; they win over the command
            line's.
        allow_undeclared: Whether parameters may be read and set without a declaration.
        now: Gives the stamp of events.
        publish_event: Takes the events.

    Attributes:
        callbacks: Of the program, which change and decide about what is set.
    """

    def __init__(
        self,
        *,
        node_fqn: str,
        overrides: dict[str, Any],
        constructor_overrides: Iterable[Parameter] | None,
        allow_undeclared: bool,
        now: Callable[[], Time],
        publish_event: Callable[[ParameterEvent], None],
    ) -> None:
        super().__init__(node_fqn, allow_undeclared=allow_undeclared)
        self._overrides = dict(overrides)
        # A wrong type in the constructor's overrides is the program's mistake, not the user's.
        self._of_command_line = self._overrides.keys() - {
            parameter.name for parameter in constructor_overrides or ()
        }
        self._overrides.update(
            (parameter.name, parameter.value) for parameter in constructor_overrides or ()
        )
        self._now = now
        self._publish_event = publish_event
        self.callbacks = _ParameterCallbacks()

    # -- declaring

    def declare_parameter(
        self,
        name: str,
        value: Any = None,
        descriptor: ParameterDescriptor | None = None,
        ignore_override: bool = False,
    ) -> Parameter:
        # ROS 2 warns of a name alone, but not of a name with an empty descriptor.
        declaration = (
            (name,)
            if value is None and descriptor is None
            else (name, value, descriptor or new_descriptor())
        )
        return self.declare_parameters("", [declaration], ignore_override)[0]

    def declare_parameters(
        self, namespace: str, parameters: Sequence[tuple[Any, ...]], ignore_override: bool = False
    ) -> list[Parameter]:
        declared: dict[str, tuple[Parameter, ParameterDescriptor]] = {}
        for index, declaration in enumerate(parameters):
            name, value, descriptor = read_declaration(index, declaration)
            name = f"{namespace}{PARAMETER_SEPARATOR_STRING}{name}" if namespace else name
            validate_parameter_name(name)
            if not ignore_override and name in self._overrides:
                parameter = override(name, self._overrides[name], descriptor)
            else:
                parameter = default(name, value)
            declared[name] = (parameter, descriptor)
        repeated = [name for name in declared if name in self._parameters]
        if repeated:
            raise ParameterAlreadyDeclaredException(repeated)
        for parameter, descriptor in declared.values():
            # One at a time, as in ROS 2: the parameters before a rejected one stay declared.
            reason = self._set_atomically([parameter], {parameter.name: descriptor})
            # ROS 2 also recognizes this case by its text.
            if reason.startswith(WRONG_TYPE):
                expected = Parameter.Type(descriptor.type)
                error = InvalidParameterTypeException(parameter, expected.name)
                error.is_of_command_line = (
                    not ignore_override and parameter.name in self._of_command_line
                )
                raise error.with_hint(yaml_hint(parameter, expected))
            if reason:
                raise InvalidParameterValueException(parameter.name, parameter.value, reason)
        return [self._parameters[name] for name in declared]

    def has_override(self, name: str) -> bool:
        """Return True if the command line or the constructor gives a value for a parameter."""
        return name in self._overrides

    def declare_overrides(self) -> None:
        """Declare every parameter of the command line and the constructor; types may change."""
        for name, value in self._overrides.items():
            descriptor = new_descriptor()
            descriptor.dynamic_typing = True
            self.declare_parameter(name, value, descriptor, ignore_override=True)

    def undeclare_parameter(self, name: str) -> None:
        if name not in self._parameters:
            raise ParameterNotDeclaredException(name)
        if self._descriptors[name].read_only:
            raise ParameterImmutableException(name)
        del self._parameters[name]
        del self._descriptors[name]

    # -- setting

    def set_parameters(self, parameter_list: list[Parameter]) -> list[SetParametersResult]:
        return [self.set_parameters_atomically([parameter]) for parameter in parameter_list]

    def set_parameters_atomically(self, parameter_list: list[Parameter]) -> SetParametersResult:
        from rcl_interfaces.msg import SetParametersResult

        self._check_declared(parameter_list)
        parameter_list = self.callbacks.changed_list(parameter_list)
        if self.callbacks.before and not parameter_list:
            return SetParametersResult(successful=False, reason=_EMPTY_LIST)
        # Again, because the callbacks may have added names.
        self._check_declared(parameter_list)
        reason = self._set_atomically(parameter_list)
        return SetParametersResult(successful=not reason, reason=reason)

    def _check_declared(self, parameter_list: list[Parameter]) -> None:
        for parameter in parameter_list:
            if not isinstance(parameter, Parameter):
                error = TypeError(f"parameter must be instance of type '{Parameter!r}'")
                raise with_hint(
                    error, f"Expected Parameter('name', value=…), not {described(parameter)}"
                )
        undeclared = [
            parameter.name for parameter in parameter_list if parameter.name not in self._parameters
        ]
        if undeclared and not self._allow_undeclared:
            # ROS 2 leaves the first name out of this text; the hint has all of them.
            hint = " ".join(self._hint(name) for name in undeclared)
            raise ParameterNotDeclaredException(undeclared[1:]).with_hint(hint)

    def _set_atomically(
        self,
        parameter_list: list[Parameter],
        declarations: dict[str, ParameterDescriptor] | None = None,
    ) -> str:
        """Check, store and announce parameters; return the reason for a rejection, if any."""
        descriptors = declarations or {
            parameter.name: self._descriptor(parameter.name) for parameter in parameter_list
        }
        for parameter in parameter_list:
            reason = refusal(
                parameter, descriptors[parameter.name], declaring=declarations is not None
            )
            if reason:
                return reason
        reason = self.callbacks.refusal(parameter_list)
        if reason:
            return reason
        event = self._store(parameter_list, descriptors, declaring=declarations is not None)
        self._publish_event(event)
        self.callbacks.tell(parameter_list)
        return ""

    def _store(
        self,
        parameter_list: list[Parameter],
        descriptors: dict[str, ParameterDescriptor],
        *,
        declaring: bool,
    ) -> ParameterEvent:
        from rcl_interfaces.msg import ParameterEvent

        event = ParameterEvent(node=self._node_fqn)
        for parameter in parameter_list:
            name = parameter.name
            # Setting a parameter to NOT_SET removes it; a declaration may leave it without a value.
            if parameter.type_ is Parameter.Type.NOT_SET and not declaring:
                event.deleted_parameters.append(parameter.to_parameter_msg())
                self._parameters.pop(name, None)
                self._descriptors.pop(name, None)
                continue
            # A parameter that was declared with a type alone counts as new at its first value.
            is_new = self.get_parameter_or(name).type_ is Parameter.Type.NOT_SET
            (event.new_parameters if is_new else event.changed_parameters).append(
                parameter.to_parameter_msg()
            )
            self._descriptors[name] = descriptors[name]
            self._parameters[name] = parameter
        event.stamp = self._now().to_msg()
        return event

    # -- describing

    def set_descriptor(
        self,
        name: str,
        descriptor: ParameterDescriptor,
        alternative_value: ParameterValue | None = None,
    ) -> rcl_interfaces.msg.ParameterValue:
        if name not in self._parameters:
            # Raises, unless undeclared parameters are allowed.
            return self.get_parameter(name).get_parameter_value()
        if self._descriptors[name].read_only:
            raise ParameterImmutableException(name)
        descriptor = copy(descriptor)  # the program may use it for several parameters
        if not descriptor.dynamic_typing and not descriptor.type:
            descriptor.type = self._parameters[name].type_.value
        # As in a declaration: a descriptor that is read-only does not reject the present value.
        if refusal(self._parameters[name], descriptor, declaring=True):
            alternative = self._parameters[name]
            if alternative_value is not None:
                from rcl_interfaces.msg import Parameter as ParameterMsg

                alternative = Parameter.from_parameter_msg(
                    ParameterMsg(name=name, value=alternative_value)
                )
            reason = self._set_atomically([alternative], {name: descriptor})
            if reason:
                raise InvalidParameterValueException(name, alternative.value, reason)
        self._descriptors[name] = descriptor
        return self.get_parameter(name).get_parameter_value()

    # -- helpers

    def _descriptor(self, name: str) -> ParameterDescriptor:
        descriptor = self._descriptors.get(name)
        if descriptor is None:
            # As in ROS 2, an undeclared parameter may change its type.
            descriptor = new_descriptor()
            descriptor.dynamic_typing = True
        return descriptor


class _ParameterCallbacks:
    """Three lists of callbacks, each called newest first.

    Attributes:
        before: Each gets the list of parameters, and returns what is set instead.
        deciding: Each gets the list and accepts or refuses it.
        after: Each gets what was set.
    """

    def __init__(self) -> None:
        self.before: list[Callable[[list[Parameter]], list[Parameter]]] = []
        self.deciding: list[Callable[[list[Parameter]], SetParametersResult]] = []
        self.after: list[Callable[[list[Parameter]], None]] = []

    def changed_list(self, parameters: list[Parameter]) -> list[Parameter]:
        """Return the parameters that callbacks put in place of ``parameters``."""
        # A copy, here and below: a callback may add or remove callbacks.
        for callback in list(self.before):
            parameters = callback(parameters)
            if not parameters:
                return []
        return parameters

    def refusal(self, parameters: list[Parameter]) -> str:
        """Return why a callback rejects ``parameters``, or an empty string.

        A callback that returns no decision refuses, with a warning, as in ROS 2.
        """
        from rcl_interfaces.msg import SetParametersResult

        for callback in list(self.deciding):
            result = callback(parameters)
            if not isinstance(result, SetParametersResult):
                text = "Callback returned an invalid type"
                warnings.warn(
                    f"{text}, it should return SetParameterResult. {callback!r} returned "
                    f"{result!r}",
                    stacklevel=2,
                )
                return text
            if not result.successful:
                return result.reason or "rejected by a callback that gave no reason"
        return ""

    def tell(self, parameters: list[Parameter]) -> None:
        """Report that ``parameters`` were set or declared."""
        for callback in list(self.after):
            callback(parameters)
