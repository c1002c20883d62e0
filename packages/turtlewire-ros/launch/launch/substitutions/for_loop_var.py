"""Values of loops in launch files."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution, described
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_substitution("for-var")
class ForEachVar(Substitution):
    """A value of the present iteration of :class:`~launch.actions.ForEach`.

    Args:
        name: Its name.
        default_value: Its value in iterations without one.
    """

    def __init__(
        self, name: SomeSubstitutionsType, *, default_value: SomeSubstitutionsType | None = None
    ) -> None:
        self._name = normalize_to_list_of_substitutions(name)
        self._default_value = (
            None if default_value is None else normalize_to_list_of_substitutions(default_value)
        )

    @classmethod
    def parse(
        cls, data: Sequence[SomeSubstitutionsType]
    ) -> tuple[type[ForEachVar], dict[str, Any]]:
        """Read ``$(for-var name [default])``."""
        if not 1 <= len(data) <= 2:
            raise TypeError("for-var substitution expects 1 or 2 arguments")
        return cls, {"name": data[0], "default_value": data[1] if len(data) == 2 else None}

    @classmethod
    def get_local_arg_name(cls, name: str) -> str:
        """Return the name of the local that holds the value."""
        return f"{cls.__name__}_{name}"

    @property
    def name(self) -> list[Substitution]:
        """The name of the variable."""
        return self._name

    @property
    def default_value(self) -> list[Substitution] | None:
        """The value in iterations that do not set the variable, or None."""
        return self._default_value

    def describe(self) -> str:
        return f"{type(self).__name__}({described(self._name)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the value as text.

        Raises:
            RuntimeError: The iteration has no value of this name, and there is no default.
        """
        name = perform_substitutions(context, self._name)
        known = context.get_locals_as_dict()
        local = self.get_local_arg_name(name)
        if local in known:
            return str(known[local])
        if self._default_value is None:
            raise RuntimeError(
                f"No value available for {type(self).__name__} '{name}' and no default value "
                "provided"
            )
        return perform_substitutions(context, self._default_value)


@expose_substitution("index")
class ForLoopIndex(ForEachVar):
    """The number of the present iteration of :class:`~launch.actions.ForLoop`; see `ForEachVar`."""
