"""A node that runs in the process of a container."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from launch.conditions import IfCondition, UnlessCondition
from launch.frontend import Entity
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros._node.arguments import NodeArguments
from launch_ros._node.elements import parse_parameters, parse_remappings, parse_value
from launch_ros.utilities.evaluate_parameters import evaluate_parameter_dict
from launch_ros.utilities.normalize_parameters import normalize_parameters
from launch_ros.utilities.to_parameters_list import to_parameters_list

if TYPE_CHECKING:
    from launch.condition import Condition
    from launch.frontend import Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution
    from launch_ros.parameters_type import SomeParameters
    from launch_ros.remap_rule_type import SomeRemapRules


class ComposableNode:
    """A node that runs in the process of a container.

    Args:
        package: The package.
        plugin: The class: ``package.module.Class`` for a container of ours, ``package::Class`` for
            a C++ one.
        name: Remaps the node's name.
        namespace: The node's namespace, within that of the scope.
        parameters: Files and mappings of parameters.
        remappings: ``(from, to)`` pairs.
        extra_arguments: For the container: a list of mappings.
        condition: Load it only when it holds.
    """

    def __init__(
        self,
        *,
        package: SomeSubstitutionsType,
        plugin: SomeSubstitutionsType,
        name: SomeSubstitutionsType | None = None,
        namespace: SomeSubstitutionsType | None = None,
        parameters: SomeParameters | None = None,
        remappings: SomeRemapRules | None = None,
        extra_arguments: list[Mapping[Any, Any]] | None = None,
        condition: Condition | None = None,
    ) -> None:
        self._package = normalize_to_list_of_substitutions(package)
        self._plugin = normalize_to_list_of_substitutions(plugin)
        self._ros = NodeArguments(name, namespace, parameters, remappings)
        self._extra_arguments = list(extra_arguments or ())
        self._condition = condition

    @classmethod
    def parse(cls, parser: Parser, entity: Entity) -> ComposableNode:
        """Read a ``composable_node`` element."""
        kwargs = cls.parse_attributes(parser, entity)
        entity.assert_entity_completely_parsed()
        return cls(**kwargs)

    @classmethod
    def parse_attributes(cls, parser: Parser, entity: Entity) -> dict[str, Any]:
        """Return the constructor's arguments of an element."""
        kwargs: dict[str, Any] = {"package": parser.parse_substitution(entity.get_attr("pkg"))}
        kwargs["plugin"] = parser.parse_substitution(entity.get_attr("plugin"))
        for attribute in ("name", "namespace"):
            text = entity.get_attr(attribute, optional=True)
            if text is not None:
                kwargs[attribute] = parser.parse_substitution(text)
        for attribute, condition in (("if", IfCondition), ("unless", UnlessCondition)):
            text = entity.get_attr(attribute, optional=True)
            if text is not None:
                kwargs["condition"] = condition(parser.parse_substitution(text))
        kwargs["parameters"] = parse_parameters(entity, parser)
        kwargs["remappings"] = parse_remappings(entity, parser)
        extra = entity.get_attr("extra_arg", data_type=list[Entity], optional=True) or ()
        kwargs["extra_arguments"] = [
            {tuple(parser.parse_substitution(item.get_attr("name"))): parse_value(item, parser)}
            for item in extra
        ]
        return kwargs

    @property
    def package(self) -> list[Substitution]:
        """The package."""
        return self._package

    @property
    def node_plugin(self) -> list[Substitution]:
        """The class."""
        return self._plugin

    @property
    def node_name(self) -> list[Substitution] | None:
        """The node's name, or None."""
        return self._ros.given_name

    @property
    def node_namespace(self) -> list[Substitution] | None:
        """The node's namespace, or None."""
        return self._ros.given_namespace

    @property
    def parameters(self) -> list[Any] | None:
        """Files and mappings of parameters, normalized; None without any."""
        return self._ros.parameters or None

    @property
    def remappings(self) -> list[Any] | None:
        """Pairs of tuples of substitutions; None without any."""
        return self._ros.remappings or None

    @property
    def extra_arguments(self) -> list[Any] | None:
        """Arguments for the container alone, normalized; None without any."""
        return normalize_parameters(self._extra_arguments) if self._extra_arguments else None

    # A method and not a property, as in ROS 2.
    def condition(self) -> Condition | None:
        """Decides whether it is loaded; None always loads it."""
        return self._condition

    def is_wanted(self, context: LaunchContext) -> bool:
        """Return True if its condition holds."""
        return self._condition is None or self._condition.evaluate(context)

    def load_request(self, context: LaunchContext) -> Any:
        """Return the ``composition_interfaces/srv/LoadNode`` request, with what the scope adds.

        Raises:
            SubstitutionFailure: A substitution has no text.
            RCLInvalidROSArgsError: A parameter file is malformed.
        """
        from composition_interfaces.srv import LoadNode
        from rclpy.parameter import Parameter

        request = LoadNode.Request()
        request.package_name = perform_substitutions(context, self._package)
        request.plugin_name = perform_substitutions(context, self._plugin)
        self._ros.expand_names(context)
        request.node_name = self._ros.name or ""
        request.node_namespace = self._ros.namespace or ""
        request.remap_rules = [
            f"{source}:={target}" for source, target in self._ros.expand_remappings(context)
        ]
        try:
            request.parameters = to_parameters_list(
                context,
                request.node_name,
                request.node_namespace,
                self._ros.evaluated_parameters(context),
            )
        # The request holds the values, so the temporary files have served their purpose.
        finally:
            self._ros.clean_up()
        extra: dict[str, Any] = {}
        for mapping in self._extra_arguments:
            extra |= evaluate_parameter_dict(context, mapping)
        request.extra_arguments = [
            Parameter(name, value=value).to_parameter_msg() for name, value in extra.items()
        ]
        return request
