"""The declared parameters of a node, to be read, listed and described."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING

from rclpy._node.declarations import new_descriptor
from rclpy.exceptions import ParameterNotDeclaredException, ParameterUninitializedException
from rclpy.parameter import PARAMETER_SEPARATOR_STRING, Parameter

if TYPE_CHECKING:
    from rcl_interfaces.msg import ListParametersResult, ParameterDescriptor


class DeclaredParameters(Mapping[str, Parameter]):
    """Values and descriptors by name; :class:`NodeParameters` changes them.

    :class:`rclpy.node.Node` has the same methods, and describes them.

    Programs read ``node._parameters`` as the dictionary that it is in ROS 2.

    Args:
        node_fqn: Fully qualified name of the node.
        allow_undeclared: Whether parameters may be read without a declaration.
    """

    def __init__(self, node_fqn: str, *, allow_undeclared: bool) -> None:
        self._node_fqn = node_fqn
        self._allow_undeclared = allow_undeclared
        self._parameters: dict[str, Parameter] = {}
        self._descriptors: dict[str, ParameterDescriptor] = {}

    def __getitem__(self, name: str) -> Parameter:
        return self._parameters[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._parameters)

    def __len__(self) -> int:
        return len(self._parameters)

    def has_parameter(self, name: str) -> bool:
        return name in self._parameters

    def get_parameter(self, name: str) -> Parameter:
        parameter = self._parameters.get(name)
        if parameter is None:
            if self._allow_undeclared:
                return Parameter(name, Parameter.Type.NOT_SET)
            raise ParameterNotDeclaredException(name).with_hint(self._hint(name))
        if parameter.type_ is Parameter.Type.NOT_SET and not self._descriptors[name].dynamic_typing:
            raise ParameterUninitializedException(name)
        return parameter

    def get_parameters(self, names: list[str]) -> list[Parameter]:
        if not all(isinstance(name, str) for name in names):
            raise TypeError("All names must be instances of type str")
        return [self.get_parameter(name) for name in names]

    def get_parameter_or(self, name: str, alternative_value: Parameter | None = None) -> Parameter:
        parameter = self._parameters.get(name)
        if parameter is not None and parameter.type_ is not Parameter.Type.NOT_SET:
            return parameter
        return (
            Parameter(name, Parameter.Type.NOT_SET)
            if alternative_value is None
            else alternative_value
        )

    def get_parameters_by_prefix(self, prefix: str) -> dict[str, Parameter]:
        start = f"{prefix}{PARAMETER_SEPARATOR_STRING}" if prefix else ""
        # Services of this node may declare or remove parameters in other threads: hence the copy.
        return {
            name[len(start) :]: parameter
            for name, parameter in list(self._parameters.items())
            if name.startswith(start)
        }

    def get_parameter_type(self, name: str) -> int:
        if name not in self._parameters and not self._allow_undeclared:
            raise ParameterNotDeclaredException(name).with_hint(self._hint(name))
        return int(self.get_parameter_or(name).type_.value)

    def get_parameter_types(self, names: list[str]) -> list[int]:
        if not all(isinstance(name, str) for name in names):
            raise TypeError("All names must be instances of type str")
        return [self.get_parameter_type(name) for name in names]

    def list_parameters(self, prefixes: list[str], depth: int) -> ListParametersResult:
        from rcl_interfaces.msg import ListParametersResult

        if not isinstance(prefixes, list):
            raise TypeError("The prefixes argument must be a list")
        if not all(isinstance(prefix, str) for prefix in prefixes):
            raise TypeError("All prefixes must be instances of type str")
        if not isinstance(depth, int):
            raise TypeError("The depth must be instance of type int")
        if depth < 0:
            raise ValueError("The depth must be greater than or equal to zero")
        names = [name for name in list(self._parameters) if _is_listed(name, prefixes, depth)]
        return ListParametersResult(names=names, prefixes=_prefixes_of(names))

    def describe_parameter(self, name: str) -> ParameterDescriptor:
        descriptor = self._descriptors.get(name)
        if descriptor is None:
            if not self._allow_undeclared:
                raise ParameterNotDeclaredException(name).with_hint(self._hint(name))
            return new_descriptor()
        if descriptor.dynamic_typing:
            descriptor.type = self._parameters[name].type_.value
        descriptor.name = name
        return descriptor

    def describe_parameters(self, names: list[str]) -> list[ParameterDescriptor]:
        return [self.describe_parameter(name) for name in names]

    def _hint(self, name: str) -> str:
        """Return a hint that names the most similar declared parameter."""
        import difflib

        near = difflib.get_close_matches(name, self._parameters, n=3)
        known = (
            f"did you mean {' or '.join(map(repr, near))}?"
            if near
            else f"declared are {sorted(self._parameters)}."
        )
        return f"Parameter {name!r} of {self._node_fqn} is not declared: {known}"


def _is_listed(name: str, prefixes: list[str], depth: int) -> bool:
    """Return True if a list of the names below ``prefixes`` has ``name``.

    Args:
        name: Of a parameter.
        prefixes: Names, or beginnings of names up to a dot; all names if empty.
        depth: How many levels below a prefix; 0 means all.
    """

    def is_near(rest: str) -> bool:
        return depth == 0 or rest.count(PARAMETER_SEPARATOR_STRING) < depth

    if not prefixes:
        return is_near(name)
    return any(
        name == prefix
        or (
            name.startswith(f"{prefix}{PARAMETER_SEPARATOR_STRING}")
            and is_near(name[len(prefix) + 1 :])
        )
        for prefix in prefixes
    )


def _prefixes_of(names: Iterable[str]) -> list[str]:
    """Return the longest prefix of each name that has one, each once, in their order."""
    parents = (name.rpartition(PARAMETER_SEPARATOR_STRING)[0] for name in names)
    return list(dict.fromkeys(parent for parent in parents if parent))
