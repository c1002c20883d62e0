"""One element of a launch file in XML or YAML."""

from __future__ import annotations

from typing import Any


class Entity:
    """One element of a launch file; each language has its own class.

    Attributes:
        line: The line that it begins in, from 1; 0 if unknown.
    """

    line: int = 0

    @property
    def type_name(self) -> str:
        """Name of the element, for example ``node``."""
        raise NotImplementedError

    @property
    def parent(self) -> Entity | None:
        """The element it is in."""
        raise NotImplementedError

    @property
    def children(self) -> list[Entity]:
        """The elements in it."""
        raise NotImplementedError

    def assert_entity_completely_parsed(self) -> None:
        """Reject attributes and children that the action did not read.

        Raises:
            ValueError: Some attributes or children were not parsed.
        """
        raise NotImplementedError

    def get_attr(
        self, name: str, *, data_type: Any = str, optional: bool = False, can_be_str: bool = True
    ) -> Any:
        """Return the value of an attribute.

        Args:
            name: Its name.
            data_type: ``str``, ``int``, ``float``, ``bool``, ``List[...]`` of these, or
                ``List[Entity]`` for child elements.
            optional: Return None when it is not there.
            can_be_str: Return text as it is when it is not of the type, since it may hold
                substitutions. For ``bool`` it must hold some, or be a truth value.

        Raises:
            AttributeError: The attribute does not exist.
            TypeError: The attribute has another type.
        """
        raise NotImplementedError
