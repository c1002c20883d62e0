"""Runs a ROS node."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from launch.actions import ExecuteProcess
from launch.actions.execute_process import split_command_line
from launch.frontend import expose_action
from launch.logging import get_logger
from launch_ros._node.arguments import NodeArguments
from launch_ros._node.elements import (
    parse_parameter_elements,
    parse_parameters,
    parse_remappings,
)
from launch_ros._node.extensions import (
    NodeActionExtension,
    get_extensions,
    instantiate_extension,
    prepared_by,
)
from launch_ros.substitutions import ExecutableInPackage
from launch_ros.utilities.track_node_names import add_node_name
from turtlewire_ros.executables import argv_for

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch_ros.parameters_type import SomeParameters
    from launch_ros.remap_rule_type import SomeRemapRules

__all__ = ["Node", "NodeActionExtension", "get_extensions", "instantiate_extension"]


@expose_action("node")
class Node(ExecuteProcess):
    """Runs an executable of a package as a ROS node.

    Args:
        executable: Name of the executable, or path when no package is given.
        package: The package.
        name: Remaps the node's name.
        namespace: The node's namespace, within that of the scope.
        exec_name: Names the process; by default the executable.
        parameters: Files and mappings of parameters.
        remappings: ``(from, to)`` pairs.
        ros_arguments: Further arguments after ``--ros-args``.
        arguments: Arguments before ``--ros-args``.
        **kwargs: See :class:`launch.actions.ExecuteProcess`.
    """

    UNSPECIFIED_NODE_NAME = "<node_name_unspecified>"
    UNSPECIFIED_NODE_NAMESPACE = "<node_namespace_unspecified>"

    def __init__(
        self,
        *,
        executable: SomeSubstitutionsType,
        package: SomeSubstitutionsType | None = None,
        name: SomeSubstitutionsType | None = None,
        namespace: SomeSubstitutionsType | None = None,
        exec_name: SomeSubstitutionsType | None = None,
        parameters: SomeParameters | None = None,
        remappings: SomeRemapRules | None = None,
        ros_arguments: Iterable[SomeSubstitutionsType] | None = None,
        arguments: Iterable[SomeSubstitutionsType] | None = None,
        **kwargs: Any,
    ) -> None:
        program: SomeSubstitutionsType = (
            executable
            if package is None
            else ExecutableInPackage(package=package, executable=executable)
        )
        self._ros = NodeArguments(name, namespace, parameters, remappings)
        cmd = [program, *(arguments or ()), "--ros-args", *(ros_arguments or ())]
        cmd += self._ros.name_words()
        # Otherwise the process would be named after the path of the executable in the package.
        if exec_name is None and package is not None:
            exec_name = executable
        super().__init__(cmd=cmd, name=exec_name, **kwargs)
        self._package = package
        self._node_executable = executable
        self._expanded_remappings: list[tuple[str, str]] = []

    @classmethod
    def parse(
        cls, entity: Entity, parser: Parser, ignore: Iterable[str] | None = None
    ) -> tuple[type[Node], dict[str, Any]]:
        _, kwargs = super().parse(entity, parser, ignore=["cmd", "name", *(ignore or ())])
        arguments = entity.get_attr("args", optional=True)
        if arguments is not None:
            kwargs["arguments"] = split_command_line(parser.parse_substitution(arguments))
        ros_arguments = entity.get_attr("ros_args", optional=True)
        if ros_arguments is not None:
            kwargs["ros_arguments"] = split_command_line(parser.parse_substitution(ros_arguments))
        for attribute, keyword in (
            ("exec", "executable"),
            ("pkg", "package"),
            ("name", "name"),
            ("namespace", "namespace"),
        ):
            text = (
                None
                if attribute in (ignore or ())
                else entity.get_attr(attribute, optional=attribute != "exec")
            )
            if text is not None:
                kwargs[keyword] = parser.parse_substitution(text)
        exec_name = entity.get_attr("exec_name", optional=True)
        if exec_name is not None:
            kwargs["exec_name"] = parser.parse_substitution(exec_name)
        kwargs["remappings"] = parse_remappings(entity, parser)
        kwargs["parameters"] = parse_parameters(entity, parser)
        return cls, kwargs

    @staticmethod
    def parse_nested_parameters(params: list[Entity], parser: Parser) -> list[Any]:
        """Read ``param`` elements: files, values, and mappings of nested elements."""
        return parse_parameter_elements(params, parser)

    @property
    def node_package(self) -> SomeSubstitutionsType | None:
        """The package."""
        return self._package

    @property
    def node_executable(self) -> SomeSubstitutionsType:
        """Name of the executable."""
        return self._node_executable

    @property
    def node_name(self) -> str:
        """Full name of the node; ``<node_name_unspecified>`` if the program chooses the name."""
        return self._ros.full_name

    @property
    def expanded_node_namespace(self) -> str:
        """The namespace within the scope, once executed."""
        return self._ros.namespace or self.UNSPECIFIED_NODE_NAMESPACE

    @property
    def expanded_remapping_rules(self) -> list[tuple[str, str]]:
        """The remappings, once executed."""
        return self._expanded_remappings

    def is_node_name_fully_specified(self) -> bool:
        """Return True if the launch file gives name and namespace."""
        return self._ros.name is not None and self._ros.namespace is not None

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        result = super().execute(context)
        if self._ros.name is not None and not context.is_shutdown:
            count = add_node_name(context, self.node_name)
            if count > 1:
                self._logger.warning(
                    "there are now at least %s nodes with the name %s "
                    "created within this launch context",
                    count,
                    self.node_name,
                )
        return result

    def prepare(self, context: LaunchContext) -> None:
        """Perform the substitutions, and append the arguments that the scope adds."""
        self._ros.expand_names(context)
        added, names = prepared_by(
            get_extensions(get_logger(__name__)), context, self._ros.name_rules(), self
        )
        # For the substitution of `NodeArguments.name_words`.
        context.extend_locals({"ros_specific_arguments": names})
        super().prepare(context)
        # Appended to the performed command, because the scope's arguments are known only now.
        final_cmd = self.process_description.final_cmd
        assert final_cmd is not None
        final_cmd += ["-r", names["ns"]] if "ns" in names else []
        final_cmd += self._ros.expand_parameters(context)
        self._expanded_remappings = self._ros.expand_remappings(context)
        final_cmd += [
            word
            for source, target in self._expanded_remappings
            for word in ("-r", f"{source}:={target}")
        ] + added

    def command(self) -> list[str]:
        """Return the command; a Python script is run by this interpreter."""
        cmd = super().command()
        # A prefix, such as a debugger, must come before the interpreter.
        at = self.process_description.prefix_length
        return [*cmd[:at], *argv_for(cmd[at]), *cmd[at + 1 :]]

    def clean_up(self) -> None:
        """Remove the parameter files that were made for the node."""
        self._ros.clean_up()
