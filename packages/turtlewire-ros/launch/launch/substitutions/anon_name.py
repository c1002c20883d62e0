"""A name that no other launch has."""

from __future__ import annotations

import os
import socket
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution, described
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_substitution("anon")
class AnonName(Substitution):
    """A name made unique by host, process and chance; the same within one launch for the same base.

    Args:
        name: The base.
    """

    def __init__(self, name: SomeSubstitutionsType) -> None:
        self._name = normalize_to_list_of_substitutions(name)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[AnonName], dict[str, Any]]:
        """Read ``$(anon name)``."""
        if len(data) != 1:
            raise TypeError("anon substitution expects 1 argument")
        return cls, {"name": data[0]}

    @property
    def name(self) -> list[Substitution]:
        """The base."""
        return self._name

    def describe(self) -> str:
        return f"AnonName({described(self._name)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the unique name."""
        base = perform_substitutions(context, self._name)
        # As in ROS 2, the name is kept as a launch configuration.
        key = f"anon{base}"
        if key not in context.launch_configurations:
            context.launch_configurations[key] = self.compute_name(base)
        return context.launch_configurations[key]

    def compute_name(self, id_value: str) -> str:
        """Make a name from a base, host, process and chance."""
        chance = int.from_bytes(os.urandom(8), "big") >> 1  # 63 bits, as in ROS 2
        unique = f"{id_value}_{socket.gethostname()}_{os.getpid()}_{chance}"
        return "".join(character if character.isalnum() else "_" for character in unique)
