"""The services through which other nodes read and set the levels of this process's loggers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import logging
from .qos import qos_profile_services_default
from .validate_topic_name import TOPIC_SEPARATOR_STRING

if TYPE_CHECKING:
    from ._node.views import ServiceOwner

__all__ = ["TOPIC_SEPARATOR_STRING", "LoggingService"]


class LoggingService:
    """Serves ``~/get_logger_levels`` and ``~/set_logger_levels`` of ``node``."""

    def __init__(self, node: ServiceOwner) -> None:
        from rcl_interfaces.srv import GetLoggerLevels, SetLoggerLevels

        for service_type, name, callback in (
            (GetLoggerLevels, "get_logger_levels", self._get_logger_levels),
            (SetLoggerLevels, "set_logger_levels", self._set_logger_levels),
        ):
            node.create_service(
                service_type,
                TOPIC_SEPARATOR_STRING.join((node.get_name(), name)),
                callback,
                qos_profile=qos_profile_services_default,
            )

    def _get_logger_levels(self, request: Any, response: Any) -> Any:
        from rcl_interfaces.msg import LoggerLevel

        for name in request.names:
            response.levels.append(
                LoggerLevel(name=name, level=logging.get_logger_level(name).value)
            )
        return response

    def _set_logger_levels(self, request: Any, response: Any) -> Any:
        from rcl_interfaces.msg import SetLoggerLevelsResult

        for level in request.levels:
            result = SetLoggerLevelsResult(successful=True)
            try:
                logging.set_logger_level(level.name, level.level)
            except ValueError:
                reason = "Failed reason: Invalid logger level."
                result = SetLoggerLevelsResult(successful=False, reason=reason)
            response.results.append(result)
        return response
