"""A YAML mapping of a launch file."""

from __future__ import annotations

from typing import Any

from launch.frontend import Entity as BaseEntity
from launch.frontend.type_utils import check_is_list_entity, list_item_type, may_become


class Entity(BaseEntity):
    """An element of a YAML launch file: a name with attributes or a list of elements.

    Args:
        element: The mapping or list.
        type_name: The name; None if ``element`` maps it to the element.
        parent: The element it is in.
    """

    def __init__(
        self, element: Any, type_name: str | None = None, *, parent: Entity | None = None
    ) -> None:
        if type_name is None:  # the mapping of one name to its element
            ((type_name, element),) = element.items()
        self._type_name = str(type_name)
        self._element = element
        self._parent = parent
        self._read_keys: set[str] = set()

    @property
    def type_name(self) -> str:
        """The name."""
        return self._type_name

    @property
    def parent(self) -> Entity | None:
        """The element it is in."""
        return self._parent

    @property
    def children(self) -> list[BaseEntity]:
        """The elements of the list, or of the key ``children``."""
        elements = self._element
        if isinstance(elements, dict):
            if "children" not in elements:
                raise ValueError(
                    f"Expected entity `{self._type_name}` to have children entities. "
                    "That can be a list of subentities or a "
                    "dictionary with a `children` list element"
                )
            self._read_keys.add("children")
            elements = elements["children"]
        if not isinstance(elements, list):
            raise TypeError(f"Expected a list of entities in `{self._type_name}`, got '{elements}'")
        children: list[BaseEntity] = []
        for item in elements:
            if not isinstance(item, dict) or len(item) != 1:
                raise RuntimeError(
                    "Subentities must be a dictionary with only one key, as the entity type: "
                    f"'{item}'"
                )
            ((name, value),) = item.items()
            child = Entity(value, str(name), parent=self)
            child.line = getattr(item, "line", 0)
            children.append(child)
        return children

    def assert_entity_completely_parsed(self) -> None:
        if isinstance(self._element, dict):
            unread = set(self._element) - self._read_keys
            if unread:
                raise ValueError(f"Unexpected key(s) found in `{self._type_name}`: {unread}")

    def get_attr(
        self, name: str, *, data_type: Any = str, optional: bool = False, can_be_str: bool = True
    ) -> Any:
        """Return the value of an attribute. See the base class."""
        if not isinstance(self._element, dict) or name not in self._element:
            if optional:
                return None
            raise AttributeError(
                f"Attribute '{name}' of type '{data_type}' not found in Entity '{self._type_name}'"
            )
        self._read_keys.add(name)
        value = self._element[name]
        if check_is_list_entity(data_type):
            return self._entities(name, value)
        if _is_of_type(value, data_type):
            return value
        if can_be_str and isinstance(value, str) and may_become(value, data_type):
            return value
        raise TypeError(
            f"Attribute '{name}' of Entity '{self._type_name}' "
            f"expected to be of type '{data_type}' but got '{type(value)}'"
        )

    def _entities(self, name: str, value: Any) -> list[Entity]:
        if not isinstance(value, list) or not all(isinstance(item, dict) for item in value):
            raise TypeError(
                f"Attribute '{name}' of Entity '{self._type_name}' "
                "expected to be a list of dictionaries."
            )
        return [Entity(item, name, parent=self) for item in value]


def _is_of_type(value: Any, data_type: Any) -> bool:
    item_type = list_item_type(data_type)
    if item_type is not None:
        return isinstance(value, list) and all(_is_of_type(item, item_type) for item in value)
    if data_type is None:
        return True
    if data_type is float:
        # bool is a subclass of int.
        return isinstance(value, (int, float)) and not isinstance(value, bool)
    if data_type is int:
        return isinstance(value, int) and not isinstance(value, bool)
    return isinstance(value, data_type)
