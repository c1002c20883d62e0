"""Finds and reads launch descriptions."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from launch.substitution import TextSubstitution, described
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.launch_description import LaunchDescription
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution


class LaunchDescriptionSource:
    """A launch description, or a file that is read when it is first needed.

    Args:
        launch_description: The description, if it exists already.
        location: Path of the file.
        method: How the description is read, for messages.
    """

    def __init__(
        self,
        launch_description: LaunchDescription | None = None,
        location: SomeSubstitutionsType = "<string>",
        method: str = "unspecified mechanism from a script",
    ) -> None:
        self._launch_description = launch_description
        self._location: list[Substitution] = normalize_to_list_of_substitutions(location)
        self._expanded_location: str | None = None
        self._method = method

    def try_get_launch_description_without_context(self) -> LaunchDescription | None:
        """Return the description, or None if only a running launch knows its location.

        Raises:
            Exception: What the loader raises.
        """
        if self._launch_description is None:
            texts = [part.text for part in self._location if isinstance(part, TextSubstitution)]
            if len(texts) != len(self._location):
                return None
            self._load("".join(texts))
        return self._launch_description

    def get_launch_description(self, context: LaunchContext) -> LaunchDescription:
        """Return the description, read at the first call.

        Raises:
            Exception: What the loader raises.
        """
        if self._launch_description is None:
            self._load(perform_substitutions(context, self._location))
        return cast("LaunchDescription", self._launch_description)

    @property
    def location(self) -> str:
        """Path of the file; before it was read, the substitutions that give it."""
        if self._expanded_location is not None:
            return self._expanded_location
        return described(self._location)

    @property
    def method(self) -> str:
        """Method of reading the description, for messages."""
        return self._method

    def _get_launch_description(self, location: str) -> LaunchDescription:
        """Read the description from ``location``."""
        raise NotImplementedError(f"{type(self).__name__} was made without a launch description")

    def _load(self, location: str) -> None:
        self._expanded_location = location
        description = self._get_launch_description(location)
        _check(description, location)
        self._launch_description = description


def _check(description: object, location: str) -> None:
    """Check what a launch file returned, because Python files may return anything.

    Raises:
        RuntimeError: The result is not a launch description, or contains an object that is not an
            action.
    """
    from launch.launch_description import LaunchDescription

    if not isinstance(description, LaunchDescription):
        hint = "Its `return` is missing." if description is None else ""
        raise _rejected(
            f"generate_launch_description() in '{location}' returned {description!r}, "
            "not a LaunchDescription",
            hint,
        )
    for entity in description.describe_sub_entities():
        if not hasattr(entity, "visit"):
            hint = "Remove the comma after the action." if isinstance(entity, tuple) else ""
            raise _rejected(
                f"the LaunchDescription in '{location}' contains {entity!r}, "
                "which is not an action",
                hint,
            )


def _rejected(message: str, hint: str) -> RuntimeError:
    error = RuntimeError(message)
    vars(error)["hint"] = hint
    return error
