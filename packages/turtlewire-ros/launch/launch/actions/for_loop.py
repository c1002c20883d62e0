"""Repeats entities, with values that change."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any

from launch import logging
from launch.action import Action
from launch.actions.opaque_function import OpaqueFunction
from launch.frontend.expose import expose_action
from launch.substitution import described
from launch.substitutions.for_loop_var import ForEachVar, ForLoopIndex
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution


@expose_action("for_each")
class ForEach(Action):
    """Visits the entities that a function returns for each of several mappings.

    Args:
        input_values: Mappings in YAML, separated by semicolons:
            ``{name: 'a', id: 1};{name: 'b', id: 2}``.
        function: Called with the values of each mapping as keywords; returns entities.
        **kwargs: See :class:`Action`.
    """

    SEPARATOR = ";"

    def __init__(
        self,
        input_values: SomeSubstitutionsType,
        *,
        function: Callable[..., Iterable[LaunchDescriptionEntity] | None],
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self._input_values = normalize_to_list_of_substitutions(input_values)
        self._function = function
        self._logger = logging.get_logger("launch.actions.for_loop")

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[ForEach], dict[str, Any]]:
        """Read a ``for_each`` element; ``$(for-var NAME)`` stands for the values inside."""
        _, kwargs = super().parse(entity, parser)
        kwargs["input_values"] = parser.parse_substitution(entity.get_attr("values"))
        again = _children(entity, parser)

        def iteration(**values: Any) -> list[LaunchDescriptionEntity]:
            return _with_locals(
                {ForEachVar.get_local_arg_name(name): value for name, value in values.items()},
                again(),
            )

        return cls, {**kwargs, "function": iteration}

    @property
    def input_values(self) -> list[Substitution]:
        """The mappings, as text."""
        return self._input_values

    @property
    def function(self) -> Callable[..., Iterable[LaunchDescriptionEntity] | None]:
        """The function."""
        return self._function

    def describe(self) -> str:
        return f"ForEach(input_values={described(self._input_values)})"

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Return the entities of all iterations."""
        import yaml

        text = perform_substitutions(context, self._input_values)
        if not text.strip():
            self._logger.warning("no input values: will not iterate")
            return []
        entities: list[LaunchDescriptionEntity] = []
        for values in map(yaml.safe_load, text.strip(self.SEPARATOR).split(self.SEPARATOR)):
            entities += self._function(**values) or []
        return entities


@expose_action("for")
class ForLoop(Action):
    """Visits what a function returns for each number from 0 to ``length - 1``.

    Args:
        length: How often: a text that is an integer.
        function: Called with the number; returns entities.
        name: The name of ``$(index NAME)``.
        **kwargs: See :class:`Action`.
    """

    def __init__(
        self,
        length: SomeSubstitutionsType,
        *,
        function: Callable[[int], Iterable[LaunchDescriptionEntity] | None],
        name: str | None = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self._length = normalize_to_list_of_substitutions(length)
        self._function = function
        self._name = name

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[ForLoop], dict[str, Any]]:
        """Read a ``for`` element; ``$(index NAME)`` stands for the number inside."""
        _, kwargs = super().parse(entity, parser)
        kwargs["length"] = parser.parse_substitution(entity.get_attr("len"))
        kwargs["name"] = name = parser.escape_characters(entity.get_attr("name"))
        again = _children(entity, parser)

        def iteration(number: int) -> list[LaunchDescriptionEntity]:
            return _with_locals({ForLoopIndex.get_local_arg_name(name): number}, again())

        return cls, {**kwargs, "function": iteration}

    @property
    def length(self) -> list[Substitution]:
        """The number of iterations, as text."""
        return self._length

    @property
    def function(self) -> Callable[[int], Iterable[LaunchDescriptionEntity] | None]:
        """The function."""
        return self._function

    @property
    def name(self) -> str | None:
        """The name of the number, or None."""
        return self._name

    def describe(self) -> str:
        return f"ForLoop(length={described(self._length)})"

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Return the entities of all iterations.

        Raises:
            ValueError: The length is not an integer.
        """
        entities: list[LaunchDescriptionEntity] = []
        for number in range(int(perform_substitutions(context, self._length))):
            entities += self._function(number) or []
        return entities


def _children(entity: Entity, parser: Parser) -> Callable[[], list[LaunchDescriptionEntity]]:
    """Return a function that makes the children of an element again, for each call.

    An action like a process can be executed only once.
    """
    children = list(entity.children)

    def make() -> list[LaunchDescriptionEntity]:
        return [parser.parse_action(child) for child in children]

    make()  # a mistake in them is found when the file is read
    return make


def _with_locals(
    values: Mapping[str, Any], entities: list[LaunchDescriptionEntity]
) -> list[LaunchDescriptionEntity]:
    """Put entities between actions that begin and end a scope with locals."""

    def enter(context: LaunchContext) -> None:
        context.local_scopes.push()
        context.extend_locals(values)

    def leave(context: LaunchContext) -> None:
        context.local_scopes.pop()

    return [OpaqueFunction(function=enter), *entities, OpaqueFunction(function=leave)]
