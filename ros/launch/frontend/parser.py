"""Makes launch descriptions of the elements of a launch file."""

from __future__ import annotations

import os
import re
from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING, Any

from launch.frontend.expose import action_parse_methods
from launch.frontend.parse_substitution import parse_substitution
from launch.invalid_launch_file_error import InvalidLaunchFileError
from launch.launch_description import LaunchDescription

if TYPE_CHECKING:
    import io

    from launch.frontend.entity import Entity
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.substitution import Substitution

__all__ = ["InvalidFrontendLaunchFileError", "Parser"]


class InvalidFrontendLaunchFileError(InvalidLaunchFileError):
    """No parser can read the file."""


class Parser:
    """Base of the parsers, one for each language."""

    @classmethod
    def load(cls, file: str | io.TextIOBase) -> tuple[Entity, Parser]:
        """Read a file into its root element, and choose the parser of its language.

        The language of the file's suffix is tried first, then the others.

        Args:
            file: Path of the file, or the opened file.

        Raises:
            InvalidFrontendLaunchFileError: No language fits.
        """
        path = file if isinstance(file, str) else getattr(file, "name", "")
        suffix = os.path.splitext(str(path))[1].removeprefix(".")
        parsers = sorted(_parsers(), key=lambda parser: suffix not in parser.get_file_extensions())
        errors: list[BaseException] = []
        for parser in parsers:
            try:
                return parser.load(file)
            except OSError:  # noqa: PERF203  two or three languages
                raise
            except Exception as error:  # noqa: BLE001  each language has its own errors
                if suffix in parser.get_file_extensions():
                    errors.append(error)
                if not isinstance(file, str):
                    file.seek(0)
        raise InvalidFrontendLaunchFileError(suffix, likely_errors=errors)

    @classmethod
    def get_available_extensions(cls) -> list[str]:
        """Suffixes of all installed languages, without dot."""
        return [suffix for parser in _parsers() for suffix in sorted(parser.get_file_extensions())]

    @classmethod
    def get_file_extensions(cls) -> set[str]:
        """Suffixes of this language, without dot."""
        return set()

    @classmethod
    def is_extension_valid(cls, extension: str) -> bool:
        """Whether a language with that suffix is installed."""
        return extension.removeprefix(".") in cls.get_available_extensions()

    def parse_description(self, entity: Entity) -> LaunchDescription:
        """The launch description of a root element.

        Raises:
            RuntimeError: It is not a root element, or an element is unknown.
        """
        if entity.type_name != "launch":
            raise RuntimeError("Expected 'launch' as root tag")
        actions = [self.parse_action(child) for child in entity.children]
        entity.assert_entity_completely_parsed()
        return LaunchDescription(actions)

    def parse_action(self, entity: Entity) -> LaunchDescriptionEntity:
        """The action of an element.

        Raises:
            RuntimeError: There is no such action.
            ValueError: The element has attributes or children that the action does not know.
            Exception: All errors carry the line of the innermost element as ``launch_file_line``.
        """
        try:
            return self._action(entity)
        except Exception as error:
            if entity.line:
                vars(error).setdefault("launch_file_line", entity.line)
            raise

    def _action(self, entity: Entity) -> LaunchDescriptionEntity:
        _load_extensions()
        if entity.type_name not in action_parse_methods:
            raise RuntimeError(f"Unrecognized entity of the type: {entity.type_name}")
        action_class, keywords = action_parse_methods[entity.type_name](entity, self)
        entity.assert_entity_completely_parsed()
        action: LaunchDescriptionEntity = action_class(**keywords)
        return action

    def parse_substitution(self, value: str) -> list[Substitution]:
        """The substitutions of a text."""
        _load_extensions()
        return parse_substitution(value)

    def parse_if_substitutions(self, value: Any) -> Any:
        """Text, and text in lists, as substitutions; other values as they are."""
        if isinstance(value, str):
            return self.parse_substitution(value)
        if isinstance(value, list):
            return [self.parse_if_substitutions(item) for item in value]
        return value

    def escape_characters(self, value: str) -> str:
        r"""Unescape a text without substitutions: ``\$``, ``\'``, ``\"`` and ``\\``."""
        return re.sub(r"\\([$'\"\\])", r"\1", value)


def _parsers() -> list[type[Parser]]:
    """The front ends that are installed (launch_xml and launch_yaml are ours)."""
    from importlib.metadata import entry_points

    return [entry.load() for entry in entry_points(group="launch.frontend.parser")]


@cache
def _load_extensions() -> None:
    """Import the modules that expose actions and substitutions.

    These are launch itself and packages with an entry point for it, such as launch_ros.
    """
    from importlib.metadata import entry_points

    for module in ("launch.actions", "launch.substitutions"):
        import_module(module)
    for entry in entry_points(group="launch.frontend.launch_extension"):
        entry.load()
