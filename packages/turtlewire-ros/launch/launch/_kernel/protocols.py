"""Protocols of the parts of a launch, as the other parts see them.

``Context_contra`` is the type of the context that they get; it is a type parameter because its
module is in a higher layer.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

if TYPE_CHECKING:
    import asyncio

    from launch.event import Event

Context_contra = TypeVar("Context_contra", contravariant=True)


class Performable(Protocol[Context_contra]):
    """A substitution: text that is known only when the launch runs."""

    def perform(self, context: Context_contra) -> str:
        """Return the text."""


class Visitable(Protocol[Context_contra]):
    """An entity of a launch description."""

    def visit(self, context: Context_contra) -> Sequence[Visitable[Context_contra]] | None:
        """Take effect; the returned entities are visited next."""

    def get_asyncio_future(self) -> asyncio.Future[None] | None:
        """Return the future of the entity's completion, or None if a visit completes it."""


class EventHandling(Protocol[Context_contra]):
    """An event handler."""

    def matches(self, event: Event) -> bool:
        """Return True if it handles the event."""

    def handle(
        self, event: Event, context: Context_contra
    ) -> Visitable[Context_contra] | Iterable[Visitable[Context_contra]] | None:
        """React to the event; the returned entities are visited."""


class ProcessRunner(Protocol):
    """The action that runs a process, as the events and matchers of processes know it."""

    @property
    def process_details(self) -> Mapping[str, Any] | None:
        """Name, cmd, cwd, env and pid of the process, or None before its start."""

    @property
    def return_code(self) -> int | None:
        """Exit status of the last run, negative for a signal; None before the first run."""

    def get_stdout(self) -> bytes:
        """Return all that the process wrote to stdout, if that is kept."""

    def get_stderr(self) -> bytes:
        """Return all that the process wrote to stderr, if that is kept."""
