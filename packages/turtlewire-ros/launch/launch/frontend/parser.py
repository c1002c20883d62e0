"""Makes launch descriptions of the elements of a launch file."""

from __future__ import annotations

import os
from importlib import import_module
from typing import TYPE_CHECKING, Any

from launch.frontend.expose import instantiate_action
from launch.frontend.parse_substitution import (
    parse_if_substitutions,
    parse_substitution,
    replace_escaped_characters,
)
from launch.invalid_launch_file_error import InvalidLaunchFileError
from launch.launch_description import LaunchDescription
from turtlewire.plugins import declared

if TYPE_CHECKING:
    import io

    from launch.frontend.entity import Entity
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.substitution import Substitution


class InvalidFrontendLaunchFileError(InvalidLaunchFileError):
    """No parser can read the file."""


class Parser:
    """Base of the parsers, one for each language.

    Attributes:
        extensions_loaded: Whether the packages that expose actions and substitutions are imported.
        frontend_parsers: Parser classes by the name of their language; None until they are needed.
    """

    extensions_loaded: bool = False
    frontend_parsers: dict[str, type[Parser]] | None = None

    @classmethod
    def load_launch_extensions(cls) -> None:
        """Import launch's own actions, and packages with an entry point for others."""
        if Parser.extensions_loaded:
            return
        # Importing them exposes their classes.
        for module in ("launch.actions", "launch.substitutions"):
            import_module(module)
        for entry in declared("launch.frontend.launch_extension").values():
            entry.load()
        Parser.extensions_loaded = True

    @classmethod
    def load_parser_implementations(cls) -> None:
        """Import the parsers of all installed languages; launch_xml and launch_yaml are ours."""
        if Parser.frontend_parsers is None:
            found = declared("launch.frontend.parser")
            Parser.frontend_parsers = {name: entry.load() for name, entry in found.items()}

    @classmethod
    def _parsers(cls) -> list[type[Parser]]:
        cls.load_parser_implementations()
        return list((Parser.frontend_parsers or {}).values())

    @classmethod
    def get_parser_from_extension(cls, extension: str) -> type[Parser]:
        """Return the parser of files with a suffix.

        Raises:
            RuntimeError: No installed language has it.
        """
        wanted = extension.removeprefix(".")
        for parser in cls._parsers():
            if wanted in parser.get_file_extensions():
                return parser
        known = ", ".join(cls.get_available_extensions())
        raise RuntimeError(
            f"Not recognized frontend implementation: no parser of '{wanted}', only of {known}"
        )

    @classmethod
    def get_parsers_from_filename(cls, filename: str) -> list[type[Parser]]:
        """Return the parsers that may read a file, judged by its name."""
        return [parser for parser in cls._parsers() if parser.may_parse(filename)]

    @classmethod
    def get_file_extensions_from_parsers(cls) -> list[set[str]]:
        """Return the suffixes of each installed language, without dot."""
        return [parser.get_file_extensions() for parser in cls._parsers()]

    @classmethod
    def is_filename_valid(cls, filename: str) -> bool:
        """Return True if an installed language has files of such a name."""
        return bool(cls.get_parsers_from_filename(filename))

    @classmethod
    def may_parse(cls, filename: str) -> bool:
        """Return True if the file's suffix is one of this language."""
        return os.path.splitext(filename)[1].removeprefix(".") in cls.get_file_extensions()

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
        parsers = sorted(cls._parsers(), key=lambda each: suffix not in each.get_file_extensions())
        errors: list[BaseException] = []
        for parser in parsers:
            try:
                return parser.load(file)
            except OSError:  # noqa: PERF203  two or three languages
                # A file that cannot be opened is not a question of its language.
                raise
            except Exception as error:  # noqa: BLE001  each language has its own errors
                # Other languages' errors only say that the file is not theirs.
                if suffix in parser.get_file_extensions():
                    errors.append(error)
                if not isinstance(file, str):
                    file.seek(0)
        raise InvalidFrontendLaunchFileError(suffix, likely_errors=errors)

    @classmethod
    def get_available_extensions(cls) -> list[str]:
        """Return the suffixes of all installed languages, without dot."""
        found = [sorted(extensions) for extensions in cls.get_file_extensions_from_parsers()]
        return [suffix for extensions in found for suffix in extensions]

    @classmethod
    def get_file_extensions(cls) -> set[str]:
        """Return the suffixes of this language, without dot."""
        return set()

    @classmethod
    def is_extension_valid(cls, extension: str) -> bool:
        """Return True if a language with that suffix is installed."""
        return extension.removeprefix(".") in cls.get_available_extensions()

    def parse_description(self, entity: Entity) -> LaunchDescription:
        """Return the launch description of a root element.

        Raises:
            RuntimeError: The entity is not a root element, or an element is unknown.
        """
        if entity.type_name != "launch":
            raise RuntimeError("Expected 'launch' as root tag")
        actions = [self.parse_action(child) for child in entity.children]
        reason = entity.get_attr("deprecated", optional=True)
        entity.assert_entity_completely_parsed()
        return LaunchDescription(actions, deprecated_reason=reason)

    def parse_action(self, entity: Entity) -> LaunchDescriptionEntity:
        """Return the action of an element.

        Raises:
            RuntimeError: No action has this name.
            ValueError: The element has attributes or children that the action does not know.
            Exception: All errors carry the line of the innermost element as ``launch_file_line``.
        """
        try:
            return self._action(entity)
        except Exception as error:
            if entity.line:
                # The innermost element sets it first.
                vars(error).setdefault("launch_file_line", entity.line)
            raise

    def _action(self, entity: Entity) -> LaunchDescriptionEntity:
        self.load_launch_extensions()
        action: LaunchDescriptionEntity = instantiate_action(entity, self)
        return action

    def parse_substitution(self, value: str) -> list[Substitution]:
        """Return the substitutions of a text."""
        self.load_launch_extensions()
        return parse_substitution(value)

    def parse_if_substitutions(self, value: Any) -> Any:
        """Convert text, and text in lists, to substitutions; return other values unchanged."""
        self.load_launch_extensions()
        return parse_if_substitutions(value)

    def escape_characters(self, value: str) -> str:
        r"""Unescape a text without substitutions: ``\$``, ``\'``, ``\"`` and ``\\``."""
        return replace_escaped_characters(value)
