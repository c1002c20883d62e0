"""Parameters: a name, a type and a value; their message form and their YAML form."""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum, IntEnum
from types import GenericAlias
from typing import TYPE_CHECKING, Any

from turtlewire.distro import KILTED, since

from .impl.reexports import reexports

if TYPE_CHECKING:
    import rcl_interfaces.msg

__getattr__ = reexports(__name__, {"rcl_interfaces.msg": ("ParameterType", "ParameterValue")})

if TYPE_CHECKING or not since(KILTED):  # noqa: SIM108 - mypy needs an alias
    _TypeBase = Enum
else:
    _TypeBase = IntEnum

PARAMETER_SEPARATOR_STRING = "."

#: What a parameter can hold, for annotations.
AllowableParameterValue = (
    bool | int | float | str | list[bytes] | list[bool] | list[int] | list[float] | list[str] | None
)


class Parameter:
    """A named value. Not changed after construction.

    Args:
        name: Its name, with dots between the levels.
        type_: Its type; found from the value when None.
        value: A bool, int, float, str, a list of one of them, a list of single bytes, or None.

    Raises:
        TypeError: The value has no type that a parameter can have, or ``type_`` is something else.
        ValueError: Type and value do not agree.
    """

    if not TYPE_CHECKING:
        __class_getitem__ = classmethod(GenericAlias)

    class Type(_TypeBase):
        """The types, with the numbers of ``rcl_interfaces/msg/ParameterType``."""

        NOT_SET = 0
        BOOL = 1
        INTEGER = 2
        DOUBLE = 3
        STRING = 4
        BYTE_ARRAY = 5
        BOOL_ARRAY = 6
        INTEGER_ARRAY = 7
        DOUBLE_ARRAY = 8
        STRING_ARRAY = 9

        def __str__(self) -> str:
            return str(self.value) if since(KILTED) else f"Type.{self.name}"

        def __format__(self, format_spec: str) -> str:
            return format(str(self), format_spec)

        @classmethod
        def from_parameter_value(cls, parameter_value: Any) -> Parameter.Type:
            """Return the type of a Python value; an empty list counts as a BYTE_ARRAY, as in ROS 2.

            Raises:
                TypeError: No parameter can have this value.
            """
            if parameter_value is None:
                return cls.NOT_SET
            for python_type, scalar in _SCALARS:
                if isinstance(parameter_value, python_type):
                    return cls[scalar]
            if not _is_array(parameter_value):
                raise TypeError(
                    f"The given value is not one of the allowed types '{parameter_value}'."
                )
            for python_type, item in _ITEMS:
                if all(isinstance(each, python_type) for each in parameter_value):
                    return cls[f"{item}_ARRAY"]
            raise TypeError(
                f"The given value is not a list of one of the allowed types '{parameter_value}'."
            )

        def check(self, parameter_value: Any) -> bool:
            """Return True if a Python value agrees with this type."""
            if self is Parameter.Type.NOT_SET:
                return parameter_value is None
            if not self.name.endswith("_ARRAY"):
                return isinstance(parameter_value, _PYTHON_TYPES[self.name])
            item_type = _PYTHON_TYPES[self.name.removesuffix("_ARRAY")]
            return _is_array(parameter_value) and all(
                isinstance(each, item_type) for each in parameter_value
            )

    def __init__(self, name: str, type_: Parameter.Type | None = None, value: Any = None) -> None:
        if type_ is None:
            type_ = Parameter.Type.from_parameter_value(value)
        if not isinstance(type_, Parameter.Type):
            raise TypeError(f"type must be an instance of '{Parameter.Type!r}'")
        if not type_.check(value):
            raise ValueError(f"Type '{type_}' and value '{value}' do not agree")
        self._type_ = type_
        self._name = name
        self._value = value

    @classmethod
    def from_parameter_msg(cls, param_msg: rcl_interfaces.msg.Parameter) -> Parameter:
        """Convert from the message type.

        Raises:
            ValueError: The message has an unknown type number.
        """
        type_ = Parameter.Type(param_msg.value.type)
        return cls(param_msg.name, type_, parameter_value_to_python(param_msg.value))

    @property
    def name(self) -> str:
        """The name of the parameter."""
        return self._name

    @property
    def type_(self) -> Parameter.Type:
        """The type of the parameter."""
        return self._type_

    @property
    def value(self) -> Any:
        """The value of the parameter; None if it is not set."""
        return self._value

    def get_parameter_value(self) -> rcl_interfaces.msg.ParameterValue:
        """Convert the value to the message type."""
        from rcl_interfaces.msg import ParameterValue

        message = ParameterValue(type=self._type_.value)
        if self._type_ is not Parameter.Type.NOT_SET:
            setattr(message, _value_field(self._type_), self._value)
        return message

    def to_parameter_msg(self) -> rcl_interfaces.msg.Parameter:
        """Convert to the message type."""
        from rcl_interfaces.msg import Parameter as ParameterMsg

        return ParameterMsg(name=self._name, value=self.get_parameter_value())

    def __repr__(self) -> str:
        type_ = f"Type.{self._type_.name}"
        return f"Parameter(name={self._name!r}, type_={type_}, value={self._value!r})"


# bool comes before int, because it is a subclass of int.
_SCALARS: tuple[tuple[type, str], ...] = (
    (bool, "BOOL"),
    (int, "INTEGER"),
    (float, "DOUBLE"),
    (str, "STRING"),
)
_ITEMS: tuple[tuple[type, str], ...] = ((bytes, "BYTE"), *_SCALARS)
_PYTHON_TYPES = {name: python_type for python_type, name in _ITEMS}


def _is_array(value: Any) -> bool:
    from array import array

    return isinstance(value, (list, tuple, array))


def _value_field(type_: Parameter.Type) -> str:
    """Return the field of ``ParameterValue`` that holds a value of this type."""
    return f"{type_.name.lower()}_value"


def parameter_value_to_python(parameter_value: rcl_interfaces.msg.ParameterValue) -> Any:
    """Return the Python value of a message.

    Raises:
        RuntimeError: The message has an unknown type number.
    """
    try:
        type_ = Parameter.Type(parameter_value.type)
    except ValueError:
        raise RuntimeError(f"unexpected parameter type {parameter_value.type}") from None
    if type_ is Parameter.Type.NOT_SET:
        return None
    value = getattr(parameter_value, _value_field(type_))
    return list(value) if _is_array(value) else value


def get_parameter_value(string_value: str) -> rcl_interfaces.msg.ParameterValue:
    """Return the value of a YAML string.

    Values that a parameter cannot have become strings.
    """
    import yaml

    try:
        value = yaml.safe_load(string_value)
    except (yaml.YAMLError, ValueError, RecursionError):  # also impossible dates, deep nesting
        value = string_value
    return _value_from_yaml(value, string_value)


def _value_from_yaml(value: Any, text: str) -> rcl_interfaces.msg.ParameterValue:
    """Return a loaded YAML value.

    ``text`` stands in for what no parameter can hold (null, dates, mixed lists).
    """
    try:
        # An empty list has values of each type; as in ROS 2, the first one that is tried.
        type_ = Parameter.Type.BOOL_ARRAY if value == [] else None
        parameter = Parameter("", type_, value)
    except TypeError:
        parameter = Parameter("", value=text)
    if parameter.type_ is Parameter.Type.NOT_SET:
        parameter = Parameter("", value=text)
    return parameter.get_parameter_value()


def parameter_dict_from_yaml_file(
    parameter_file: str,
    use_wildcard: bool = False,
    target_nodes: Sequence[str] | None = None,
    namespace: str = "",
) -> dict[str, rcl_interfaces.msg.Parameter]:
    """Read parameters from a YAML file.

    Args:
        parameter_file: Path of the file.
        use_wildcard: Whether the parameters below ``/**`` belong to the result.
        target_nodes: Names of nodes in the file; all if None.
        namespace: Put before each name.

    Returns:
        Full name to message.

    Raises:
        RuntimeError: The file is not a parameter file, or has no parameters of the nodes.
    """
    import yaml

    invalid = "YAML file is not a valid ROS parameter file"
    with open(parameter_file, encoding="utf-8") as file:
        try:
            content = yaml.safe_load(file)
        except RecursionError:
            raise RuntimeError(f"{invalid}: '{parameter_file}' is nested too deeply") from None
        except ValueError as error:  # a date that is in no calendar
            raise RuntimeError(f"{invalid}: '{parameter_file}': {error}") from None
    if not isinstance(content, dict):
        raise RuntimeError(  # noqa: TRY004 - what ROS 2 raises
            f"{invalid}: '{parameter_file}' holds no nodes"
        )
    nodes = (
        [name for name in content if name != "/**"] if target_nodes is None else list(target_nodes)
    )
    for node in nodes:
        if node not in content:
            # ROS 2's text, blanks included.
            raise RuntimeError(
                f"Param file does not contain parameters for {node},only for nodes: "
                f"{list(content)} "
            )
    # First, so that the nodes' own values replace the wildcard's.
    if use_wildcard and "/**" in content:
        nodes.insert(0, "/**")
    if not nodes:
        raise RuntimeError("Param file does not contain selected parameters")
    parameters: dict[str, rcl_interfaces.msg.Parameter] = {}
    for node in nodes:
        section = content[node]
        if not isinstance(section, dict) or not isinstance(section.get("ros__parameters"), dict):
            raise RuntimeError(  # noqa: TRY004 - as above
                f"{invalid} for node {node}"
            )
        _flatten(section["ros__parameters"], namespace, parameters)
    return parameters


def _flatten(
    tree: dict[Any, Any], prefix: str, parameters: dict[str, rcl_interfaces.msg.Parameter]
) -> None:
    from rcl_interfaces.msg import Parameter as ParameterMsg

    for key, value in tree.items():
        name = f"{prefix}{key}"
        if isinstance(value, dict):
            _flatten(value, f"{name}{PARAMETER_SEPARATOR_STRING}", parameters)
        else:
            parameters[name] = ParameterMsg(name=name, value=_value_from_yaml(value, str(value)))
