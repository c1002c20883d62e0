"""A command line that suggests the nearest option, and ends in one line when the disk is full."""

from __future__ import annotations

import argparse
import difflib
import errno
import os
import re
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from typing import Any, NoReturn

_UNKNOWN = re.compile(r"unrecognized arguments: (-\S+)")


class ScriptParser(argparse.ArgumentParser):
    """A parser for programs that run before turtlewire is installed; no option may be shortened."""

    def __init__(self, **settings: Any) -> None:
        super().__init__(allow_abbrev=False, **settings)

    def error(self, message: str) -> NoReturn:
        """Print the usage, the message and the nearest option; exit with status 2."""
        if unknown := _UNKNOWN.match(message):
            option = unknown[1].partition("=")[0]
            for near in difflib.get_close_matches(option, self._option_string_actions, n=1):
                message += f"\nDid you mean: {near}"
        super().error(message)

    def exit(self, status: int = 0, message: str | None = None) -> NoReturn:
        """End the program as `git` ends when its output cannot be written."""
        try:
            sys.stdout.flush()
        except OSError as error:
            # What is left in the buffer must not fail again at the end of the interpreter.
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            if error.errno == errno.EPIPE:
                super().exit(141)
            super().exit(1, f"{self.prog}: write error: {error.strerror}\n")
        super().exit(status, message)
