"""Logs a message."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

from launch import logging
from launch.action import Action
from launch.frontend.expose import expose_action
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from turtlewire.distro import LYRICAL, since

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution

#: Names of Python's levels, in the order in which launch lists them.
_LEVELS = {
    "CRITICAL": 50,
    "FATAL": 50,
    "ERROR": 40,
    "WARN": 30,
    "WARNING": 30,
    "INFO": 20,
    "DEBUG": 10,
    "NOTSET": 0,
}
_NO_LEVEL = (
    "The action log now expects a log level. Either provide one or switch to using the log_info "
    "action"
)


class SharedLogSpecificParse(Action):
    """Reads the message of the actions that log one."""

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read the attribute ``message``, and what all actions have."""
        _, kwargs = super().parse(entity, parser)
        kwargs["msg"] = parser.parse_substitution(entity.get_attr("message"))
        return cls, kwargs


class LogInterface(SharedLogSpecificParse):
    """Logs a message with the logger ``launch.user``.

    Args:
        msg: The message.
        level: One of Python's names of levels, such as ``"info"``.
        **kwargs: See :class:`Action`.
    """

    def __init__(
        self, *, msg: SomeSubstitutionsType, level: SomeSubstitutionsType, **kwargs: Any
    ) -> None:
        super().__init__(**kwargs)
        self._msg = normalize_to_list_of_substitutions(msg)
        self._level = normalize_to_list_of_substitutions(level)

    @property
    def msg(self) -> list[Substitution]:
        """The message."""
        return self._msg

    @property
    def level(self) -> list[Substitution]:
        """The name of the level."""
        return self._level

    def execute(self, context: LaunchContext) -> None:
        """Log the message.

        Raises:
            KeyError: The level has no such name.
        """
        level = perform_substitutions(context, self._level).upper()
        if level not in _LEVELS:
            raise KeyError(f"Invalid log level '{level}', expected: {_LEVELS.keys()}")
        logger = logging.get_logger("launch.user")
        logger.log(_LEVELS[level], "%s", perform_substitutions(context, self._msg))


@expose_action("log")
class Log(LogInterface):
    """Logs a message with a level; in Jazzy and Kilted, ``<log>`` needs no level."""

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        _, kwargs = super().parse(entity, parser)
        level = entity.get_attr("level", optional=True)
        if level is None:
            if since(LYRICAL):
                warnings.warn(_NO_LEVEL, UserWarning, stacklevel=2)
            return LogInfo, kwargs
        return cls, {**kwargs, "level": parser.parse_substitution(level)}


@expose_action("log_debug")
class LogDebug(LogInterface):
    """Logs a message at DEBUG level; see :class:`LogInterface`."""

    def __init__(self, *, msg: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(msg=msg, level="DEBUG", **kwargs)


@expose_action("log_info")
class LogInfo(LogInterface):
    """Logs a message at INFO level; see :class:`LogInterface`."""

    def __init__(self, *, msg: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(msg=msg, level="INFO", **kwargs)


@expose_action("log_warning")
class LogWarning(LogInterface):
    """Logs a message at WARNING level; see :class:`LogInterface`."""

    def __init__(self, *, msg: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(msg=msg, level="WARNING", **kwargs)


@expose_action("log_error")
class LogError(LogInterface):
    """Logs a message at ERROR level; see :class:`LogInterface`."""

    def __init__(self, *, msg: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(msg=msg, level="ERROR", **kwargs)
