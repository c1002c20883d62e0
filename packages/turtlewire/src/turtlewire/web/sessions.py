"""The server's side of one browser's connection.

All messages are objects with a ``type``. A page sends commands as JSON
(:mod:`turtlewire.web.commands`). It receives JSON, and packets, which also carry arrays
(:mod:`turtlewire.web.packets`). The answer to a wrong command is ``{"type": "error", "text":
...}``.
"""

from __future__ import annotations

import json
import logging
from typing import TYPE_CHECKING, Any, Protocol

from turtlewire.terminal.printable import printable
from turtlewire.web.commands import CommandError

if TYPE_CHECKING:
    from turtlewire.web.commands import CommandReader

__all__ = ["CommandSession", "PageSession"]


_logger = logging.getLogger(__name__)


class PageSession(Protocol):
    """One browser's connection. The server's thread calls all methods, so they must be short."""

    def outgoing(self) -> list[str | bytes]:
        """Return the messages that this browser does not have yet.

        Called after :meth:`turtlewire.web.Server.notify`, and only when the browser has taken the
        last messages: values that became outdated in between are never sent, so a slow browser
        sees fewer frames, not old ones.
        """
        ...

    def receive(self, message: str | bytes) -> None:
        """Take a message of the browser; the session answers a wrong one itself."""
        ...

    def closed(self) -> None:
        """The browser has disconnected."""
        ...


class CommandSession:
    """A session that takes commands, and answers those that make no sense.

    Args:
        reader: Reads the commands.
    """

    def __init__(self, reader: CommandReader) -> None:
        self._reader = reader
        self._answers: list[str | bytes] = []

    def outgoing(self) -> list[str | bytes]:
        """Return the answers and the news."""
        answers, self._answers = self._answers, []
        return [*answers, *self.news()]

    def receive(self, message: str | bytes) -> None:
        """Carry out a command, or answer why not."""
        try:
            self.obey(self._reader.read(message))
        except CommandError as error:
            self.refuse(error)
        except Exception:  # it would close the connection: the page would lose all that it shows
            _logger.exception("A command of a page failed")
            self.answer({"type": "error", "text": "This command failed; the log says why."})

    def refuse(self, error: Exception) -> None:
        """Answer that something went wrong."""
        self.answer({"type": "error", "text": printable(str(error))})

    def answer(self, fields: dict[str, Any]) -> None:
        """Send an answer as soon as the browser has taken the last messages."""
        self._answers.append(json.dumps(fields))

    def news(self) -> list[str | bytes]:
        """Return the messages that this browser does not have yet, except answers."""
        raise NotImplementedError

    def obey(self, command: Any) -> None:
        """Carry out a command.

        Raises:
            CommandError: The command cannot be carried out; the text is the answer.
        """
        raise NotImplementedError

    def closed(self) -> None:
        """The browser has disconnected."""
