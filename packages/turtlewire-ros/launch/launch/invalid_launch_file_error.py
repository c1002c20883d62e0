"""The error of launch files that no loader can read."""

from __future__ import annotations

from collections.abc import Sequence


class InvalidLaunchFileError(Exception):
    """No loader could read a launch file; the text holds the error of each.

    Args:
        extension: The file's format, for example ``.py``.
        likely_errors: What the loaders raised, the most likely one first.
    """

    def __init__(
        self, extension: str = "", *, likely_errors: Sequence[BaseException] | None = None
    ) -> None:
        self.extension = extension.removeprefix(".")
        self.likely_errors = list(likely_errors or ())
        super().__init__(str(self))

    def __str__(self) -> str:
        """One line for one error, a list for several."""
        if not self.likely_errors:
            return "The launch file may have a syntax error, or its format is unknown"
        if len(self.likely_errors) == 1:
            return (
                f"Caught exception when trying to load file of format [{self.extension}]: "
                f"{self.likely_errors[0]}"
            )
        lines = [
            f"Caught multiple exceptions when trying to load file of format [{self.extension}]:"
        ]
        return "\n".join(
            lines + [f" - {type(error).__name__}: {error}" for error in self.likely_errors]
        )
