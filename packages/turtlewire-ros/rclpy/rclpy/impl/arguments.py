"""Parses ``--ros-args``: remap rules, parameters, log levels and the enclave.

::

    program user args --ros-args -r from:=to -p name:=value --params-file f.yaml --log-level debug
    -- more user args
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from rclpy._rclpy_pybind11 import RCLError, RCLInvalidROSArgsError, UnknownROSArgsError

if TYPE_CHECKING:
    from rclpy.impl.rcl_remap import RemapRule
    from rclpy.impl.rcl_yaml_param_parser import ParameterValue

_BEGIN = "--ros-args"
_END = "--"


class _Option(NamedTuple):
    """A flag that takes a value.

    It has the value's name and the reason for error texts, and the function that takes the value.
    """

    label: str
    missing: str
    method: str


_REMAP = _Option(
    "remap rule", "Couldn't parse trailing {} flag. No remap rule found.", "_add_remap_rule"
)
_PARAM = _Option(
    "parameter override rule",
    "Couldn't parse trailing {} flag. No parameter override rule found.",
    "_add_parameter",
)
_ENCLAVE = _Option(
    "enclave name", "Couldn't parse trailing {} flag. No enclave path provided.", "_set_enclave"
)
_OPTIONS = {
    "-r": _REMAP,
    "--remap": _REMAP,
    "-p": _PARAM,
    "--param": _PARAM,
    "-e": _ENCLAVE,
    "--enclave": _ENCLAVE,
    "--params-file": _Option(
        "params file",
        "Couldn't parse trailing {} flag. No file path provided.",
        "_add_parameter_file",
    ),
    "--log-level": _Option(
        "log level",
        "Couldn't parse trailing log level flag: '{}'. No log level provided.",
        "_set_log_level",
    ),
    "--log-file-name": _Option(
        "log file name prefix",
        "Couldn't parse trailing {} flag. No string prefix provided.",
        "_set_log_file_name",
    ),
    "--log-config-file": _Option(
        "log config file",
        "Couldn't parse trailing {} flag. No file path provided.",
        "_set_log_config_file",
    ),
}
_SWITCHES = {
    f"--{verb}-{attribute.replace('_', '-')}": (attribute, verb == "enable")
    for verb in ("enable", "disable")
    for attribute in ("stdout_logs", "rosout_logs", "external_lib_logs")
}


class Arguments:
    """The parsed ``--ros-args`` blocks of a command line. Not changed after :meth:`parse`.

    Attributes:
        user_args: What is not in the blocks, the program's name included.
        log_levels: Logger name to severity number; the empty name means all others.
        log_file_name: First part of the log file's name, None for the program's.
        log_config_file: Configuration file of a logging backend, or None.
        stdout_logs: Whether to log to the console.
        rosout_logs: Whether to log to ``/rosout``.
        external_lib_logs: Whether to log to a file.
        enclave: Security enclave, ``/`` by default.
    """

    def __init__(self) -> None:
        self.user_args: list[str] = []
        self.log_levels: dict[str, int] = {}
        self.log_file_name: str | None = None
        self.log_config_file: str | None = None
        self.stdout_logs = True
        self.rosout_logs = True
        self.external_lib_logs = True
        self.enclave = "/"
        self.rules: list[RemapRule] = []
        #: Per command line, later ones win: node name pattern to parameters.
        self.parameter_maps: list[dict[str, dict[str, ParameterValue]]] = [{}]

    @classmethod
    def parse(cls, argv: Sequence[str]) -> Arguments:
        """Read a command line.

        Raises:
            RCLInvalidROSArgsError: A rule is malformed, or a parameter file cannot be read; the
                text says which.
            UnknownROSArgsError: A block contains words that are not flags; the message lists all
                of them.
        """
        self = cls()
        unknown: list[str] = []
        words = iter(argv)
        in_block = False
        for word in words:
            if word == _BEGIN:
                in_block = True
            elif not in_block:
                self.user_args.append(word)
            elif word == _END:
                in_block = False
            elif word in _OPTIONS:
                self._take_option(word, next(words, None))
            elif word in _SWITCHES:
                setattr(self, *_SWITCHES[word])
            else:
                unknown.append(word)
        if unknown:
            raise UnknownROSArgsError(repr(unknown))
        return self

    @classmethod
    def parse_global(cls, argv: Sequence[str]) -> Arguments:
        """Read the command line of a process.

        As :meth:`parse`, with the log line and the error that ``rclpy.init`` shows.

        Raises:
            RCLError: A rule is malformed.
            UnknownROSArgsError: A block contains a word that is not a flag.
            UnicodeEncodeError: An argument holds bytes that are not UTF-8.
        """
        # Raises for arguments with bytes that are not UTF-8 before any of them takes effect.
        for argument in argv:
            argument.encode()
        try:
            return cls.parse(argv)
        except RCLInvalidROSArgsError as error:
            from rclpy.logging import get_logger

            get_logger("rcl").error("Failed to parse global arguments")
            raise RCLError(f"failed to initialize rcl: {error}") from None

    @classmethod
    def parse_local(cls, argv: Sequence[str]) -> Arguments:
        """Read the arguments of a single node.

        Raises:
            RCLInvalidROSArgsError: A rule is malformed.
            UnknownROSArgsError: A block contains a word that is not a flag.
        """
        try:
            return cls.parse(argv)
        except RCLInvalidROSArgsError as error:
            raise RCLInvalidROSArgsError(f"Failed to parse ROS arguments: {error}") from None

    def followed_by(self, other: Arguments) -> Arguments:
        """Return these arguments (of a node) before ``other`` (of the process).

        Remap rules and parameters of these win. As in ROS 2, all else is the process's.
        """
        both = Arguments()
        # The first rule that applies wins, but the last value of a parameter.
        both.rules = self.rules + other.rules
        both.parameter_maps = other.parameter_maps + self.parameter_maps
        return both

    def configure_logging(self) -> None:
        """Apply what the process's command line says of logging; ``rclpy.init`` does it."""
        from rclpy.impl import log_output
        from rclpy.logging import get_logger

        log_output.configure(
            levels=self.log_levels,
            console=self.stdout_logs,
            rosout=self.rosout_logs,
            file=self.external_lib_logs,
            file_prefix=self.log_file_name,
        )
        if self.log_config_file is not None:
            get_logger("rcl").warning(
                "Configuration files of logging are not supported: "
                f"'{self.log_config_file}' is ignored"
            )

    def remap_node_name(self, node_name: str) -> str:
        """Return the name that a node of this name gets."""
        return self._remap("NODE_NAME", node_name, node_name, "/")

    def remap_namespace(self, node_name: str, namespace: str) -> str:
        """Return the namespace that the node gets; ``node_name`` is its name after renaming."""
        return self._remap("NAMESPACE", namespace, node_name, namespace)

    def remap_topic(self, topic: str, node_name: str, namespace: str) -> str:
        """Return the topic that a node uses instead of ``topic``; both are fully qualified."""
        return self._remap("TOPIC", topic, node_name, namespace)

    def remap_service(self, service: str, node_name: str, namespace: str) -> str:
        """Return the service that a node uses instead of ``service``; both are fully qualified."""
        return self._remap("SERVICE", service, node_name, namespace)

    def _remap(self, kind: str, name: str, node_name: str, namespace: str) -> str:
        if not self.rules:
            return name
        from rclpy.impl.rcl_remap import RemapKind, remap

        return remap(self.rules, RemapKind[kind], name, node_name, namespace)

    def parameter_overrides(self, node_fqn: str) -> dict[str, Any]:
        """Return the values that the command line and its files give to a node's parameters.

        Args:
            node_fqn: Fully qualified name after renaming, for example ``/ns/listener``.

        Returns:
            Name to bool, int, float, str or a list of one of them.
        """
        overrides: dict[str, Any] = {}
        for nodes in self.parameter_maps:
            for pattern, parameters in nodes.items():
                if matches_node(pattern, node_fqn):
                    overrides.update(parameters)
        return overrides

    def _take_option(self, flag: str, value: str | None) -> None:
        option = _OPTIONS[flag]
        if value is None:
            raise RCLInvalidROSArgsError(option.missing.format(flag))
        try:
            getattr(self, option.method)(value)
        except ValueError as error:
            raise RCLInvalidROSArgsError(
                f"Couldn't parse {option.label}: '{flag} {value}'. Error: {error}"
            ) from None

    def _add_remap_rule(self, text: str) -> None:
        from rclpy.impl.rcl_remap import parse_remap_rule

        self.rules.append(parse_remap_rule(text))

    def _add_parameter(self, text: str) -> None:
        from rclpy.impl.rcl_yaml_param_parser import parse_parameter_rule

        node_name, parameter_name, value = parse_parameter_rule(text)
        self.parameter_maps[0].setdefault(node_name, {})[parameter_name] = value

    def _add_parameter_file(self, path: str) -> None:
        from rclpy.impl.rcl_yaml_param_parser import parse_file

        for node_name, parameters in parse_file(path).items():
            self.parameter_maps[0].setdefault(node_name, {}).update(parameters)

    def _set_log_level(self, text: str) -> None:
        from rclpy.logging import get_logging_severity_from_string

        name, separator, level = text.partition(":=")
        if not separator:
            name, level = "", text
        elif not name:
            raise ValueError("Argument has an invalid logger item that name is empty")
        try:
            self.log_levels[name] = get_logging_severity_from_string(level).value
        except RuntimeError:
            raise ValueError("Argument does not use a valid severity level") from None

    def _set_log_file_name(self, prefix: str) -> None:
        if not prefix or "/" in prefix or "\0" in prefix:
            raise ValueError("The prefix of a file name must not be empty or hold a slash")
        self.log_file_name = prefix

    def _set_log_config_file(self, path: str) -> None:
        self.log_config_file = path

    def _set_enclave(self, name: str) -> None:
        from turtlewire.wire import names

        fault = names.validate_namespace(name)
        if fault is not None:
            # ROS 2's texts for enclaves call them context names.
            message = fault.message.replace("namespace", "context name")
            raise ValueError(
                f"Enclave name is not valid: '{message}'. Invalid index: {fault.invalid_index}"
            )
        self.enclave = name


def matches_node(pattern: str, node_fqn: str) -> bool:
    """Return True if a node name of a parameter file means this node.

    ``/*`` is one token, ``/**`` any number of them.
    """
    if not pattern.startswith("/"):
        pattern = f"/{pattern}"
    if pattern in {"/**", node_fqn}:
        return True
    if "*" not in pattern:
        return False
    import re

    expression = re.escape(pattern).replace(r"/\*\*", r"(/\w+)*").replace(r"/\*", r"(/\w+)")
    return re.fullmatch(expression, node_fqn) is not None
