"""The severities of log messages."""

from enum import IntEnum


class LoggingSeverity(IntEnum):
    """The severity of a message; UNSET means that the parent logger's level applies."""

    UNSET = 0
    DEBUG = 10
    INFO = 20
    WARN = 30
    ERROR = 40
    FATAL = 50
