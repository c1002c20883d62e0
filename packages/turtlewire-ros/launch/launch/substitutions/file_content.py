"""The content of a file."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution, described
from launch.substitutions.substitution_failure import SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_substitution("file-content")
class FileContent(Substitution):
    """The content of a text file.

    Args:
        path: Its path.
    """

    def __init__(self, path: SomeSubstitutionsType) -> None:
        self._path = normalize_to_list_of_substitutions(path)

    @classmethod
    def parse(
        cls, data: Sequence[SomeSubstitutionsType]
    ) -> tuple[type[FileContent], dict[str, Any]]:
        """Read ``$(file-content path)``."""
        if len(data) != 1:
            raise TypeError("file-content substitution expects 1 argument")
        return cls, {"path": data[0]}

    @property
    def path(self) -> list[Substitution]:
        """The path of the file."""
        return self._path

    def describe(self) -> str:
        return f"FileContent({described(self._path)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the content.

        Raises:
            SubstitutionFailure: The file cannot be read.
        """
        path = perform_substitutions(context, self._path)
        try:
            with open(path, encoding="utf-8") as file:
                return file.read()
        except (OSError, UnicodeDecodeError) as error:
            raise SubstitutionFailure(f"Failed to read file '{path}': {error}") from error
