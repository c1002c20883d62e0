"""Formats and destinations of the log lines of a launch, and the folder of its files."""

from __future__ import annotations

import contextlib
import errno
import logging
import os
import signal
import socket
import sys
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal

_Style = Literal["%", "{", "$"]
#: Name of the main log file, unless a launch chooses another.
_MAIN_LOG_FILE = "launch.log"
_SCREEN_FORMAT = "[{levelname}] [{name}]: {message}"
_LOG_FORMAT = "{created:.7f} [{levelname}] [{name}]: {message}"
_NAMED_FORMATS = {
    "default": _SCREEN_FORMAT,
    "default_with_timestamp": "{created:.7f} [{levelname}] [{name}]: {message}",
}
_EXAMPLES = {"{": "{message}", "%": "%(message)s", "$": "${message}"}
# A pipe without reader, and a terminal that was closed.
_READER_GONE = (errno.EPIPE, errno.EIO)
_COLORS = {
    logging.DEBUG: "\033[32m",
    logging.WARNING: "\033[33m",
    logging.ERROR: "\033[31m",
    logging.CRITICAL: "\033[31m",
}

#: Where the two streams of a process go for each short form; ``both`` are the two in one.
_OUTPUTS: dict[str, dict[str, set[str]]] = {
    "screen": {"both": {"screen"}},
    "log": {"both": {"log"}, "stderr": {"screen"}},
    "both": {"both": {"log", "screen"}},
    "own_log": {"both": {"own_log"}, "stdout": {"own_log"}, "stderr": {"own_log"}},
    "full": {"both": {"log", "screen", "own_log"}, "stdout": {"own_log"}, "stderr": {"own_log"}},
}


class _Formatter(logging.Formatter):
    """Shows the output of processes unchanged, and other lines with their level and name."""

    def __init__(self, layout: str, style: _Style, *, colored: bool = False) -> None:
        super().__init__(layout, style=style)
        self._colored = colored

    def format(self, record: logging.LogRecord) -> str:
        if getattr(record, "from_process", False):
            return (
                f"{record.created:.7f} {record.getMessage()}"
                if self._has_time()
                else record.getMessage()
            )
        color = _COLORS.get(record.levelno) if self._colored else None
        if color is None:
            return super().format(record)
        level = record.levelname
        # Other handlers get the same record, without the colour.
        record.levelname = f"{color}{level}\033[0m"
        try:
            return super().format(record)
        finally:
            record.levelname = level

    def _has_time(self) -> bool:
        return self._fmt is not None and "created" in self._fmt


class _ScreenHandler(logging.StreamHandler):  # type: ignore[type-arg]  # not generic in 3.10
    """Writes to stdout. When that fails, the launch and its processes end as after SIGTERM."""

    def __init__(self) -> None:
        super().__init__(sys.stdout)
        if hasattr(self.stream, "reconfigure"):
            # Processes may write characters that the terminal's encoding does not have.
            self.stream.reconfigure(errors="backslashreplace")

    def emit(self, record: logging.LogRecord) -> None:
        """Write the line."""
        try:
            super().emit(record)
        except SystemExit:  # from the stdout of a command, which reports it after the launch
            signal.raise_signal(signal.SIGTERM)

    def handleError(self, record: logging.LogRecord) -> None:  # noqa: N802  logging's name
        error = sys.exc_info()[1]
        if isinstance(error, OSError) and error.errno in _READER_GONE:
            # So that later writes, such as Python's flush at its exit, do not fail again.
            os.dup2(os.open(os.devnull, os.O_WRONLY), self.stream.fileno())
            signal.raise_signal(signal.SIGTERM)
        else:
            super().handleError(record)


class _FileHandler(logging.FileHandler):
    """Writes to a log file. Says once that it cannot be written, for example on a full disk."""

    def __init__(self, path: str) -> None:
        super().__init__(path, encoding="utf-8", delay=True)
        self._failed = False

    def handleError(self, record: logging.LogRecord) -> None:  # noqa: N802  logging's name
        error = sys.exc_info()[1]
        if not isinstance(error, OSError):
            super().handleError(record)
        elif not self._failed:
            self._failed = True
            path = self.baseFilename
            sys.stderr.write(f"[WARNING] [launch]: cannot write {path}: {error.strerror}\n")

    def close(self) -> None:
        """Close the file, even when what is buffered cannot be written."""
        with contextlib.suppress(OSError):
            super().close()


def default_log_dir() -> str:
    """Return the parent of launch folders: ``ROS_LOG_DIR``, ``$ROS_HOME/log``, ``~/.ros/log``."""
    explicit = os.environ.get("ROS_LOG_DIR")
    if explicit:
        return str(Path(explicit).expanduser())
    return str(Path(os.environ.get("ROS_HOME") or Path("~") / ".ros").expanduser() / "log")


def make_launch_log_dir(parent: str) -> str:
    """Create a folder named after time, host and process; the link ``latest`` points to it.

    Raises:
        RuntimeError: The folder cannot be created.
    """
    seconds, microseconds = divmod(time.time_ns() // 1000, 1_000_000)
    moment = time.strftime("%Y-%m-%d-%H-%M-%S", time.localtime(seconds))
    name = f"{moment}-{microseconds:06}-{socket.gethostname()}-{os.getpid()}"
    base = Path(parent, name)
    try:
        base.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise RuntimeError(
            f"cannot make the log folder {base} ({error.strerror}); "
            "set ROS_LOG_DIR to another folder"
        ) from error
    # Not every file system has links, and another launch may make it at the same time: logging
    # works without.
    with contextlib.suppress(OSError):
        # A link cannot be changed in one step, but a new one can take its place.
        link = Path(parent) / f".latest-{os.getpid()}"
        link.symlink_to(base.name, target_is_directory=True)
        link.replace(Path(parent) / "latest")
    return str(base)


class LaunchConfig:
    """Level, folder and formats of the logging of launches in this process.

    Attributes:
        main_log_file_name: Name of the file with the lines of the launch itself.
    """

    def __init__(self) -> None:
        self._log_handlers: dict[str, logging.Handler] = {}
        self.main_log_file_name = _MAIN_LOG_FILE
        self.reset()

    def reset(self) -> None:
        """Go back to the defaults; the next line in a file creates a new folder."""
        for handler in self._log_handlers.values():
            handler.close()
        self._log_handlers.clear()
        self._log_dir: str | None = None
        self._screen_handler: logging.Handler | None = None
        self._screen_format = os.environ.get("OVERRIDE_LAUNCH_SCREEN_FORMAT") or _SCREEN_FORMAT
        self._log_format = os.environ.get("OVERRIDE_LAUNCH_LOG_FORMAT") or _LOG_FORMAT
        self._screen_style: _Style = "{"
        self._log_style: _Style = "{"

    @property
    def level(self) -> int:
        """Lines below it are dropped."""
        return logging.getLogger("launch").getEffectiveLevel()

    @level.setter
    def level(self, level: int | str) -> None:
        logging.getLogger("launch").setLevel(level)

    @property
    def log_dir(self) -> str:
        """Folder of the log files of this launch, created at its first use."""
        if self._log_dir is None:
            self._log_dir = make_launch_log_dir(default_log_dir())
        return self._log_dir

    @log_dir.setter
    def log_dir(self, path: str) -> None:
        if self._log_handlers:
            raise RuntimeError("Cannot change launch log directory. Directory is already in use.")
        path = os.path.abspath(os.path.expanduser(path))
        os.makedirs(path, exist_ok=True)
        self._log_dir = path

    def set_screen_format(self, screen_format: str, *, screen_style: str | None = None) -> None:
        """Set the format of the screen.

        Args:
            screen_format: ``default``, ``default_with_timestamp``, or a format of :mod:`logging`.
            screen_style: The style of that format: ``{``, ``%`` or ``$``; by default ``{``.

        Raises:
            ValueError: The style does not exist, the format has no field in this style, or a style
                is given for a named format, which has its own.
        """
        self._screen_style = _checked_style(screen_format, screen_style)
        self._screen_format = screen_format
        self._screen_handler = None

    def set_log_format(self, log_format: str, *, log_style: str | None = None) -> None:
        """Set the format of the log files, as for the screen."""
        self._log_style = _checked_style(log_format, log_style)
        self._log_format = log_format
        self._log_handlers.clear()

    def get_screen_handler(self) -> logging.Handler:
        """Return the handler that writes to stdout."""
        if self._screen_handler is None:
            self._screen_handler = _ScreenHandler()
            layout = _NAMED_FORMATS.get(self._screen_format, self._screen_format)
            self._screen_handler.setFormatter(
                _Formatter(
                    layout,
                    self._screen_style,
                    colored=sys.stdout.isatty() and not os.environ.get("NO_COLOR"),
                )
            )
        return self._screen_handler

    def get_log_file_path(self, file_name: str = _MAIN_LOG_FILE) -> str:
        """Return the path of a log file of this launch."""
        return os.path.join(self.log_dir, file_name)

    def get_log_file_handler(self, file_name: str = _MAIN_LOG_FILE) -> logging.Handler:
        """Return the handler of a log file of this launch, which its first line creates."""
        if file_name not in self._log_handlers:
            handler = _FileHandler(self.get_log_file_path(file_name))
            layout = _NAMED_FORMATS.get(self._log_format, self._log_format)
            handler.setFormatter(_Formatter(layout, self._log_style))
            self._log_handlers[file_name] = handler
        return self._log_handlers[file_name]


class _MainHandler(logging.Handler):
    """Sends the lines of the launch itself to the screen and the main log file."""

    def emit(self, record: logging.LogRecord) -> None:
        # Asked for at each line, because formats and folder may have changed.
        launch_config.get_screen_handler().handle(record)
        try:
            launch_config.get_log_file_handler(launch_config.main_log_file_name).handle(record)
        except OSError as error:
            raise RuntimeError(f"cannot write log files: {error}") from error


launch_config = LaunchConfig()


def get_logger(name: str | None = None) -> logging.Logger:
    """Return a logger whose lines go to the screen and to ``launch.log``."""
    logger = logging.getLogger(name if name is not None else "launch")
    owner = logging.getLogger("launch")
    if not owner.handlers:
        owner.addHandler(_MainHandler())
        owner.propagate = False
        if owner.level == logging.NOTSET:
            owner.setLevel(logging.INFO)
    # A logger with such a name does not inherit the handler of `launch`.
    if logger is not owner and not logger.name.startswith("launch.") and not logger.handlers:
        logger.addHandler(_MainHandler())
        logger.propagate = False
        logger.setLevel(logging.INFO)
    return logger


def get_output_loggers(
    process_name: str,
    output_config: str | Mapping[str, Any],
    main_log_file_name: str = _MAIN_LOG_FILE,
) -> tuple[logging.Logger, logging.Logger]:
    """Return the loggers of the two output streams of a process.

    Args:
        process_name: Names the process, and its own log files.
        output_config: ``screen``, ``log``, ``both``, ``own_log``, ``full``, or a mapping of
            ``stdout``, ``stderr``, ``both`` to a choice or a set of choices among ``screen``,
            ``log``, ``own_log``.
        main_log_file_name: The file that ``log`` means.

    Raises:
        ValueError: ``output_config`` is something else.
    """
    destinations = _normalized(output_config)
    loggers = []
    for stream in ("stdout", "stderr"):
        logger = logging.getLogger(f"launch_process.{process_name}-{stream}")
        logger.propagate = False
        logger.setLevel(logging.INFO)
        # An earlier launch of this program may have had a process of the same name.
        logger.handlers.clear()
        chosen = destinations.get("both", set()) | destinations.get(stream, set())
        if "screen" in chosen:
            logger.addHandler(launch_config.get_screen_handler())
        if "log" in chosen:
            logger.addHandler(launch_config.get_log_file_handler(main_log_file_name))
        for which in (stream, "both"):
            if "own_log" in destinations.get(which, ()):
                suffix = "" if which == "both" else f"-{stream}"
                logger.addHandler(launch_config.get_log_file_handler(f"{process_name}{suffix}.log"))
        loggers.append(logger)
    return loggers[0], loggers[1]


def log_launch_config(*, logger: logging.Logger | None = None) -> None:
    """Log the folder of the log files and the level."""
    logger = logger or logging.getLogger("launch")
    logger.info("All log files can be found below %s", launch_config.log_dir)
    logger.info("Default logging verbosity is set to %s", logging.getLevelName(launch_config.level))


def reset() -> None:
    """Reset folder, handlers and formats."""
    launch_config.reset()


def _normalized(output_config: str | Mapping[str, Any]) -> dict[str, set[str]]:
    if isinstance(output_config, str):
        if output_config not in _OUTPUTS:
            raise ValueError(
                f"'{output_config}' is not a valid standard output config i.e. one of: "
                f"{', '.join(_OUTPUTS)}"
            )
        return _OUTPUTS[output_config]
    normalized = {}
    for stream, choice in output_config.items():
        choices = {choice} if isinstance(choice, str) else set(choice)
        if stream not in ("stdout", "stderr", "both"):
            raise ValueError(
                f"'{stream}' is not a valid output source: one of stdout, stderr, both"
            )
        if not choices <= {"screen", "log", "own_log"}:
            raise ValueError(
                f"'{choice}' is not a valid output destination: some of screen, log, own_log"
            )
        normalized[stream] = choices
    return normalized


def _checked_style(layout: str, style: str | None) -> _Style:
    """Return the style of a format, which must suit it; the style of named formats is ``{``."""
    if layout in _NAMED_FORMATS:
        if style is not None:
            raise ValueError(f"the format '{layout}' has its own style: give it without '{style}'")
        return "{"
    known = _known_style(style)
    try:
        logging.Formatter(layout, style=known)
    except ValueError as error:
        raise ValueError(
            f"'{layout}' is not a log format of the style '{known}', as '{_EXAMPLES[known]}' is: "
            f"{error}"
        ) from error
    return known


def _known_style(style: str | None) -> _Style:
    if style is None or style == "{":
        return "{"
    if style == "%":
        return "%"
    if style == "$":
        return "$"
    raise ValueError(f"the style of a log format is '{{', '%' or '$', not '{style}'")
