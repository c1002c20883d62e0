"""Events of endpoints: counters that the middleware increments and their owner reads."""

from __future__ import annotations

import threading

from .base import Event, EventKind, EventStatus


class EventWatcher:
    """Collects the events that a wait set is attached to, and says which have something to take."""

    def __init__(self) -> None:
        self._happened: dict[StatusEvent, None] = {}
        self._watched: set[StatusEvent] = set()

    def wake(self) -> None:
        """End the wait; the wait set does it."""
        raise NotImplementedError

    def watch(self, event: StatusEvent) -> None:
        """Note that ``event`` reports here."""
        self._watched.add(event)

    def happened(self, event: StatusEvent) -> None:
        """Report ``event`` at this and later waits, until it is taken."""
        self._happened[event] = None
        self.wake()

    def ready_events(self) -> list[StatusEvent]:
        """Return the events that have something to take."""
        if not self._happened:
            return []
        for event in list(self._happened):
            if not event.pending:
                self._happened.pop(event, None)
                if event.pending:  # it happened again at this very moment
                    self._happened[event] = None
        return list(self._happened)

    def forget(self, event: StatusEvent) -> None:
        """Report it no more."""
        self._watched.discard(event)
        self._happened.pop(event, None)

    def leave_events(self) -> None:
        """Detach from all events; at the end of the wait set."""
        for event in list(self._watched):
            event.detach(self)


class StatusEvent(Event):
    """The counters of one kind of event of one endpoint. Thread-safe."""

    def __init__(self, kind: EventKind) -> None:
        self.kind = kind
        self._lock = threading.Lock()
        self._status = EventStatus()
        self._watchers: set[EventWatcher] = set()
        self.pending = False

    def add(self, news: EventStatus) -> None:
        """Take over new counters; their changes are added to those not taken yet."""
        with self._lock:
            self._status = news._replace(
                total_count_change=self._status.total_count_change + news.total_count_change,
                current_count_change=self._status.current_count_change + news.current_count_change,
            )
            self.pending = True
            watchers = list(self._watchers)
        for watcher in watchers:
            watcher.happened(self)

    def take(self) -> EventStatus | None:
        with self._lock:
            if not self.pending:
                return None
            status = self._status
            self._status = status._replace(total_count_change=0, current_count_change=0)
            self.pending = False
            return status

    def attach(self, watcher: EventWatcher) -> None:
        """Tell ``watcher`` when it happens, and at once when it has."""
        with self._lock:
            self._watchers.add(watcher)
            watcher.watch(self)
            pending = self.pending
        if pending:
            watcher.happened(self)

    def detach(self, watcher: EventWatcher) -> None:
        """Stop notifying it."""
        with self._lock:
            self._watchers.discard(watcher)
        watcher.forget(self)

    def close(self) -> None:
        with self._lock:
            watchers = list(self._watchers)
        for watcher in watchers:
            self.detach(watcher)


class EventSource:
    """The events of one endpoint.

    Args:
        lock: Guards them.
    """

    def __init__(self, lock: threading.Lock | threading.RLock) -> None:
        self._lock = lock
        self._events: dict[EventKind, StatusEvent] = {}
        self._matched_count = 0

    def _event(self, kind: EventKind) -> StatusEvent:
        with self._lock:
            return self._events.setdefault(kind, StatusEvent(kind))

    def _report_matched(self, change: int, current: int) -> None:
        """Report that one endpoint more or less matches, and ``current`` ones in all."""
        self._matched_count += max(change, 0)
        status = EventStatus(self._matched_count, max(change, 0), current, change)
        self._event(EventKind.MATCHED).add(status)

    def _close_events(self) -> None:
        for event in list(self._events.values()):
            event.close()
