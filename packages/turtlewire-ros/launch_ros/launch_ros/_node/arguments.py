"""The ``--ros-args`` of one node, from its launch file and scope."""

from __future__ import annotations

import contextlib
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from launch import logging
from launch.substitutions import LocalSubstitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.parameter_descriptions import Parameter, ParameterFile
from launch_ros.utilities.evaluate_parameters import evaluate_parameter_dict, evaluate_parameters
from launch_ros.utilities.namespace_utils import make_namespace_absolute, prefix_namespace
from launch_ros.utilities.normalize_parameters import normalize_parameters
from launch_ros.utilities.normalize_remap_rule import normalize_remap_rules
from launch_ros.utilities.scope import global_parameters, remaps
from turtlewire_ros.workspace_hints import path_hint

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch_ros.parameters_type import SomeParameters
    from launch_ros.remap_rule_type import SomeRemapRules


class NodeArguments:
    """Name, namespace, parameters and remappings of one node.

    Args:
        name: Remaps the node's name.
        namespace: The node's namespace, within that of the scope.
        parameters: Files and mappings of parameters.
        remappings: ``(from, to)`` pairs.

    Raises:
        TypeError: The parameters are not a list, or a parameter or remapping has another form.
    """

    def __init__(
        self,
        name: SomeSubstitutionsType | None,
        namespace: SomeSubstitutionsType | None,
        parameters: SomeParameters | None,
        remappings: SomeRemapRules | None,
    ) -> None:
        self.given_name = None if name is None else normalize_to_list_of_substitutions(name)
        self.given_namespace = (
            None if namespace is None else normalize_to_list_of_substitutions(namespace)
        )
        self.parameters = [] if parameters is None else normalize_parameters(parameters)
        self.remappings = list(normalize_remap_rules(remappings or ()))
        self._made_files: list[str] = []
        self._parameter_files: list[ParameterFile] = []
        #: Known once :meth:`expand_names` ran; None when the launch file leaves it to the program.
        self.name: str | None = None
        #: Known once :meth:`expand_names` ran; None when neither the launch file nor the scope has
        #: one.
        self.namespace: str | None = None

    @property
    def full_name(self) -> str:
        """Namespace and name; ``<node_name_unspecified>`` if the program chooses the name."""
        return f"{(self.namespace or '').rstrip('/')}/{self.name or '<node_name_unspecified>'}"

    def name_words(self) -> list[SomeSubstitutionsType]:
        """Return the words for the name, which a substitution supplies when the node starts."""
        if self.given_name is None:
            return []
        # ROS 2's name of the local variable. `Node.prepare` sets it, because the name is known only
        # then.
        return ["-r", LocalSubstitution("ros_specific_arguments['name']", "node name")]

    def expand_names(self, context: LaunchContext) -> None:
        """Find name and namespace."""
        if self.given_name is not None:
            self.name = perform_substitutions(context, self.given_name)
        own = (
            None
            if self.given_namespace is None
            else perform_substitutions(context, self.given_namespace)
        )
        joined = prefix_namespace(context.launch_configurations.get("ros_namespace"), own)
        if joined is not None:
            self.namespace = make_namespace_absolute(joined)

    def name_rules(self) -> dict[str, str]:
        """Return the rules for name and namespace, as ROS 2 calls them."""
        rules = {"name": f"__node:={self.name}"} if self.name is not None else {}
        return rules | ({"ns": f"__ns:={self.namespace}"} if self.namespace else {})

    def expand_parameters(self, context: LaunchContext) -> list[str]:
        """Return the words for the parameters; writes files that :meth:`clean_up` removes."""
        words: list[str] = []
        for entry in global_parameters(context):
            if isinstance(entry, tuple):
                words += ["-p", f"{entry[0]}:={_yaml_text(entry[1])}"]
            else:
                words += ["--params-file", str(entry)]
        for parameter in self.parameters:
            words += self._words_for(parameter, context)
        return words

    def evaluated_parameters(self, context: LaunchContext) -> list[Any]:
        """Return all parameters in their order: the scope's, then the node's own."""
        evaluated: list[Any] = [
            dict([entry]) if isinstance(entry, tuple) else Path(str(entry))
            for entry in global_parameters(context)
        ]
        for parameter in self.parameters:
            # A copy, because several nodes may be given the same file.
            own = parameter.copy() if isinstance(parameter, ParameterFile) else parameter
            if isinstance(own, ParameterFile):
                self._parameter_files.append(own)
            evaluated += evaluate_parameters(context, [own])
        return evaluated

    def expand_remappings(self, context: LaunchContext) -> list[tuple[str, str]]:
        """Return ``(from, to)`` pairs: the scope's, then the node's own."""
        own = [
            (perform_substitutions(context, source), perform_substitutions(context, target))
            for source, target in self.remappings
        ]
        return remaps(context) + own

    def clean_up(self) -> None:
        """Remove the files that were made for the node."""
        for path in self._made_files:
            with contextlib.suppress(FileNotFoundError):
                os.unlink(path)
        self._made_files.clear()
        for file in self._parameter_files:
            file.cleanup()

    def _words_for(self, parameter: Any, context: LaunchContext) -> list[str]:
        if isinstance(parameter, Parameter):
            name, value = parameter.evaluate(context)
            return ["-p", f"{name}:={_yaml_text(value)}"]
        if hasattr(parameter, "items"):
            return ["--params-file", self._file_of(evaluate_parameter_dict(context, parameter))]
        # A file of our own: several nodes may be given the same one, and each removes its copy at
        # its end.
        file = (
            parameter.copy() if isinstance(parameter, ParameterFile) else ParameterFile(parameter)
        )
        self._parameter_files.append(file)
        path = file.evaluate(context)
        if not path.is_file():
            hint = path_hint(str(path))
            logging.get_logger("launch_ros.actions.node").warning(
                "Parameter file path is not a file: %s%s", path, f"\n{hint}" if hint else ""
            )
            return []
        return ["--params-file", str(path)]

    def _file_of(self, values: dict[str, Any]) -> str:
        import tempfile

        import yaml

        # Without a name in the launch file, the values must apply to whatever name the program
        # chooses.
        key = "/**" if self.name is None else self.full_name
        with tempfile.NamedTemporaryFile(
            "w", prefix="launch_params_", delete=False, encoding="utf-8"
        ) as file:
            yaml.safe_dump(
                {key: {"ros__parameters": values}},
                file,
                default_flow_style=False,
                allow_unicode=True,
            )
        self._made_files.append(file.name)
        return file.name


def _yaml_text(value: Any) -> str:
    """Return a value as YAML on one line, as it stands after ``:=``."""
    import yaml

    # The width keeps long values on one line; PyYAML appends a document end to plain scalars.
    return (
        yaml.safe_dump(value, default_flow_style=True, width=10**6, allow_unicode=True)
        .removesuffix("...\n")
        .strip()
    )
