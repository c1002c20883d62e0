"""Runs a ROS node."""

from __future__ import annotations

import contextlib
import os
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

from launch import logging
from launch.actions import ExecuteProcess
from launch.actions.execute_process import split_command_line
from launch.frontend import Entity, expose_action
from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.parameter_descriptions import Parameter, ParameterFile
from launch_ros.substitutions import ExecutableInPackage
from launch_ros.utilities.elements import parse_parameters, parse_remappings
from launch_ros.utilities.namespace_utils import make_namespace_absolute, prefix_namespace
from launch_ros.utilities.node_names import add_node_name
from launch_ros.utilities.parameter_values import evaluate_parameter_dict
from launch_ros.utilities.scope import global_parameters, remaps
from turtlewire_ros.executables import argv_for

if TYPE_CHECKING:
    from collections.abc import Iterable

    from launch.frontend import Parser
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch_ros.parameters_type import SomeParameters
    from launch_ros.remap_rule_type import SomeRemapRules

__all__ = ["Node"]


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
        program: SomeSubstitutionsType = executable if package is None else ExecutableInPackage(package=package, executable=executable)
        cmd = [program, *(arguments or ()), "--ros-args", *(ros_arguments or ())]
        if exec_name is None and package is not None:
            exec_name = executable
        super().__init__(cmd=cmd, name=exec_name, **kwargs)
        if parameters is not None and (isinstance(parameters, (str, Path, Substitution)) or not hasattr(parameters, "__iter__")):
            raise TypeError("Expecting a list of parameter files or parameter dictionaries")
        self._package = package
        self._node_executable = executable
        self._node_name = None if name is None else normalize_to_list_of_substitutions(name)
        self._node_namespace = None if namespace is None else normalize_to_list_of_substitutions(namespace)
        self._parameters = [parameters] if hasattr(parameters, "items") else list(parameters or ())
        self._remappings = [
            (normalize_to_list_of_substitutions(source), normalize_to_list_of_substitutions(target)) for source, target in remappings or ()
        ]
        self._expanded_name: str | None = None
        self._expanded_namespace: str | None = None
        self._ros_arguments: list[str] = []
        self._made_files: list[str] = []
        self._parameter_files: list[ParameterFile] = []

    @classmethod
    def parse(cls, entity: Entity, parser: Parser, ignore: Iterable[str] = ()) -> tuple[type[Node], dict[str, Any]]:
        """Read a ``node`` element."""
        _, kwargs = super().parse(entity, parser, ignore=["cmd", "name", *ignore])
        arguments = entity.get_attr("args", optional=True)
        if arguments is not None:
            kwargs["arguments"] = split_command_line(parser.parse_substitution(arguments))
        ros_arguments = entity.get_attr("ros_args", optional=True)
        if ros_arguments is not None:
            kwargs["ros_arguments"] = split_command_line(parser.parse_substitution(ros_arguments))
        for attribute, keyword in (("exec", "executable"), ("pkg", "package"), ("name", "name"), ("namespace", "namespace")):
            text = None if attribute in ignore else entity.get_attr(attribute, optional=attribute != "exec")
            if text is not None:
                kwargs[keyword] = parser.parse_substitution(text)
        exec_name = entity.get_attr("exec_name", optional=True)
        if exec_name is not None:
            kwargs["exec_name"] = parser.parse_substitution(exec_name)
        kwargs["remappings"] = parse_remappings(entity, parser)
        kwargs["parameters"] = parse_parameters(entity, parser)
        return cls, kwargs

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
        """The full name of the node; ``<node_name_unspecified>`` stands for one that the program chooses."""
        name = self._expanded_name or "<node_name_unspecified>"
        return f"{(self._expanded_namespace or '').rstrip('/')}/{name}"

    @property
    def expanded_node_namespace(self) -> str:
        """The namespace within the scope, once executed."""
        return self._expanded_namespace or "<node_namespace_unspecified>"

    @property
    def expanded_remapping_rules(self) -> list[tuple[str, str]]:
        """The remappings, once executed."""
        return self._expanded_remappings

    def is_node_name_fully_specified(self) -> bool:
        """Whether the launch file says name and namespace."""
        return self._expanded_name is not None and self._expanded_namespace is not None

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Work out name, parameters and remappings, then run the process."""
        result = super().execute(context)
        if self._expanded_name is not None:
            count = add_node_name(context, self.node_name)
            if count > 1:
                self._logger.warning(
                    "there are now at least %s nodes with the name %s created within this launch context", count, self.node_name
                )
        return result

    def prepare(self, context: LaunchContext) -> None:
        """Perform the substitutions, and append the arguments that come of the scope."""
        super().prepare(context)
        final_cmd = self.process_description.final_cmd
        assert final_cmd is not None
        self._expand_names(context)
        final_cmd += self._name_arguments() + self._parameter_arguments(context) + self._remapping_arguments(context)

    def command(self) -> list[str]:
        """The command; a Python script is run by this interpreter."""
        cmd = super().command()
        at = self.process_description.prefix_length
        return [*cmd[:at], *argv_for(cmd[at]), *cmd[at + 1 :]]

    def clean_up(self) -> None:
        """Remove the parameter files that were made for the node."""
        for path in self._made_files:
            with contextlib.suppress(FileNotFoundError):
                os.unlink(path)
        self._made_files.clear()
        for file in self._parameter_files:
            file.cleanup()

    def _expand_names(self, context: LaunchContext) -> None:
        if self._node_name is not None:
            self._expanded_name = perform_substitutions(context, self._node_name)
        own = None if self._node_namespace is None else perform_substitutions(context, self._node_namespace)
        joined = prefix_namespace(context.launch_configurations.get("ros_namespace"), own)
        if joined is not None:
            self._expanded_namespace = make_namespace_absolute(joined)

    def _name_arguments(self) -> list[str]:
        name = [] if self._expanded_name is None else ["-r", f"__node:={self._expanded_name}"]
        return name + ([] if not self._expanded_namespace else ["-r", f"__ns:={self._expanded_namespace}"])

    def _parameter_arguments(self, context: LaunchContext) -> list[str]:
        arguments: list[str] = []
        for entry in global_parameters(context):
            if isinstance(entry, tuple):
                arguments += ["-p", f"{entry[0]}:={yaml_text(entry[1])}"]
            else:
                arguments += ["--params-file", str(entry)]
        for parameter in self._parameters:
            arguments += self._arguments_of(parameter, context)
        return arguments

    def _arguments_of(self, parameter: Any, context: LaunchContext) -> list[str]:
        if isinstance(parameter, Parameter):
            name, value = parameter.evaluate(context)
            return ["-p", f"{name}:={yaml_text(value)}"]
        if hasattr(parameter, "items"):
            return ["--params-file", self._parameter_file(evaluate_parameter_dict(context, parameter))]
        # A file of our own: several nodes may be given the same one, and each removes its copy at its end.
        file = parameter.copy() if isinstance(parameter, ParameterFile) else ParameterFile(parameter)
        self._parameter_files.append(file)
        path = file.evaluate(context)
        if not path.is_file():
            logging.get_logger("launch_ros.actions.node").warning("Parameter file path is not a file: %s", path)
            return []
        return ["--params-file", str(path)]

    def _parameter_file(self, values: dict[str, Any]) -> str:
        import yaml

        key = "/**" if self._expanded_name is None else self.node_name
        with tempfile.NamedTemporaryFile("w", prefix="launch_params_", delete=False, encoding="utf-8") as file:
            yaml.safe_dump({key: {"ros__parameters": values}}, file, default_flow_style=False, allow_unicode=True)
        self._made_files.append(file.name)
        return file.name

    def _remapping_arguments(self, context: LaunchContext) -> list[str]:
        own = [(perform_substitutions(context, source), perform_substitutions(context, target)) for source, target in self._remappings]
        self._expanded_remappings = remaps(context) + own
        return [argument for source, target in self._expanded_remappings for argument in ("-r", f"{source}:={target}")]


def yaml_text(value: Any) -> str:
    """A value as YAML on one line, as it stands after ``:=``."""
    import yaml

    return yaml.safe_dump(value, default_flow_style=True, width=10**6, allow_unicode=True).removesuffix("...\n").strip()
