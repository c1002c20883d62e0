"""An XML element of a launch file."""

from __future__ import annotations

from typing import Any
from xml.etree.ElementTree import Element

from launch.frontend import Entity as BaseEntity
from launch.frontend.type_utils import check_is_list_entity, coerce, list_item_type, may_become


class Entity(BaseEntity):
    """An XML element of a launch file.

    Args:
        xml_element: The element; None makes an empty root.
        parent: The element it is in.
    """

    def __init__(self, xml_element: Element | None = None, *, parent: Entity | None = None) -> None:
        if xml_element is None:
            xml_element = Element("launch")
        self._element = xml_element
        self.line = getattr(xml_element, "line", 0)
        self._parent = parent
        self._children = [Entity(child, parent=self) for child in xml_element]
        self._read_attributes: set[str] = set()
        self._read_children: set[str] = set()

    @property
    def type_name(self) -> str:
        """The tag."""
        return self._element.tag

    @property
    def parent(self) -> Entity | None:
        """The element it is in."""
        return self._parent

    @property
    def children(self) -> list[BaseEntity]:
        """The child elements."""
        # Then the action has read all of them.
        self._read_children |= {child.type_name for child in self._children}
        return list(self._children)

    def assert_entity_completely_parsed(self) -> None:
        attributes = set(self._element.attrib) - self._read_attributes
        if attributes:
            raise ValueError(f"Unexpected attribute(s) found in `{self.type_name}`: {attributes}")
        children = {child.type_name for child in self._children} - self._read_children
        if children:
            raise ValueError(
                f"Unexpected nested entity(ies) found in `{self.type_name}`: {children}"
            )

    def get_attr(
        self, name: str, *, data_type: Any = str, optional: bool = False, can_be_str: bool = True
    ) -> Any:
        """Return the value of an attribute; a list of elements holds the children with that tag."""
        if check_is_list_entity(data_type):
            return self._children_named(name, optional)
        if name not in self._element.attrib:
            if optional:
                return None
            raise AttributeError(
                f"Attribute '{name}' of type '{data_type}' not found in Entity '{self.type_name}'"
            )
        self._read_attributes.add(name)
        return self._value(name, self._element.attrib[name], data_type, can_be_str)

    def _children_named(self, name: str, optional: bool) -> list[Entity] | None:
        found = [child for child in self._children if child.type_name == name]
        if not found and not optional:
            raise AttributeError(
                f"Attribute '{name}' of type 'List[Entity]' not found in Entity '{self.type_name}'"
            )
        self._read_children.add(name)
        return found or None

    def _value(self, name: str, text: str, data_type: Any, can_be_str: bool) -> Any:
        separator = self._element.attrib.get(f"{name}-sep")
        item_type = list_item_type(data_type)
        try:
            if separator is None and item_type is None:
                return coerce(text, data_type)
            self._read_attributes.add(f"{name}-sep")
            separator = separator or ","
            return [coerce(item.strip(), item_type) for item in text.split(separator)]
        except ValueError as error:
            if can_be_str and may_become(text, data_type):
                return text
            raise TypeError(
                f"Attribute '{name}' of Entity '{self.type_name}' "
                f"expected to be of type '{data_type}' but got '{text}'"
            ) from error
