"""One page: its fixed frame, time and displays; what it asks for, and what it does not have yet."""

from __future__ import annotations

import json
import math
import time
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from turtlewire.errors import TurtlewireError
from turtlewire.terminal.printable import printable
from turtlewire_view.display_feed import Base, DisplayFeed
from turtlewire_view.displays.options import OptionError
from turtlewire_view.frames import FrameScene
from turtlewire_view.packets import encode_packet
from turtlewire_view.page_requests import RequestError, message_of_tool, text_of_view
from turtlewire_view.rviz_file import RvizFileError, read_rviz
from turtlewire_view.tree import TreeTable, path_between, relation

if TYPE_CHECKING:
    from turtlewire_view.rviz_file import SavedView
    from turtlewire_view.source import Source

__all__ = ["Host", "ViewCommandError", "ViewSession"]

_FRAMES_S, _RELATION_S, _TREE_S = 1 / 31, 0.1, 1.0
_LONGEST_NAME = 1000
_MOST_DISPLAYS = 100


class ViewCommandError(ValueError):
    """A command of a page that makes no sense; the text is its answer."""


class Host(Protocol):
    """What a session needs of the view; it is :class:`turtlewire_view.viewer.Viewer`."""

    source: Source
    fixed_frame: str
    documents: dict[str, SavedView]

    def keep_document(self, view: SavedView) -> None:
        """Remember a file that was loaded: what the page has not is in the saved one again."""
        ...

    def hello(self) -> bytes:
        """Return the first packet of a page."""
        ...

    def first_view(self) -> list[bytes]:
        """Return the packets of the first view, if a file defines one."""
        ...

    def topics(self) -> list[dict[str, Any]]:
        """Return the topics that can be shown."""
        ...

    def new_feed(self, name: str, kind: str, topic: str, options: dict[str, object]) -> DisplayFeed:
        """Subscribe for a display."""
        ...

    def work(self) -> None:
        """Displays need new poses."""
        ...

    def forget(self, session: ViewSession) -> None:
        """A page is gone."""
        ...


class _Wish(NamedTuple):
    """What a page asked for."""

    kind: str
    topic: str
    options: dict[str, object]


class ViewSession:
    """The server's thread calls all methods but :meth:`base`."""

    def __init__(self, viewer: Host) -> None:
        self._viewer = viewer
        self._source = viewer.source
        self._timeline = viewer.source.new_timeline()
        self._scene = FrameScene()
        self._table = TreeTable()
        self._fixed = viewer.fixed_frame
        self._relation: tuple[str, str] | None = None
        self._feeds: dict[str, DisplayFeed] = {}
        self._wishes: dict[str, _Wish] = {}  # what the displays were asked for
        self._budget = 0
        self._base = Base(self._timeline.buffer, "", (0.0, 0.0, 0.0))
        self._said: dict[str, Any] = {}
        self._due: dict[str, float] = {}
        self._answers: list[bytes] = [viewer.hello(), *viewer.first_view()]
        self._commands = {
            "fixed": self._set_fixed,
            "relation": self._set_relation,
            "add": self._add,
            "remove": self._remove,
            "options": self._set_options,
            "budget": self._set_budget,
            "pause": self._pause,
            "play": self._play,
            "seek": self._seek,
            "speed": self._set_speed,
            "publish": self._publish,
            "save": self._save,
            "load": self._load,
        }

    @property
    def base(self) -> Base:
        """Base that poses refer to; for any thread."""
        return self._base

    @property
    def feeds(self) -> list[DisplayFeed]:
        """The displays; for any thread."""
        return list(self._feeds.values())

    def outgoing(self) -> list[str | bytes]:
        """Return the messages that the page does not have yet."""
        packets, self._answers = self._answers, []
        if self._is_due("tree", _TREE_S):
            packets += self._tree()
        if self._is_due("frames", _FRAMES_S):
            packets += self._frames()
        if self._relation is not None and self._is_due("relation", _RELATION_S):
            packets.append(self._relate(*self._relation))
        for feed in self._feeds.values():
            packets += feed.take_packets()
        return list(packets)

    def receive(self, message: str | bytes) -> None:
        """Take a command; a wrong one is answered by an ``error``."""
        try:
            self._run(message)
        except (ViewCommandError, TurtlewireError) as error:
            self._refuse(error)

    def _refuse(self, error: Exception) -> None:
        self._answers.append(encode_packet({"type": "error", "text": printable(str(error))}))

    def closed(self) -> None:
        """The page is gone."""
        for feed in self._feeds.values():
            feed.close()
        self._feeds.clear()
        self._wishes.clear()
        self._viewer.forget(self)

    def _run(self, message: str | bytes) -> None:
        try:
            command = json.loads(message)
        except (ValueError, RecursionError):
            raise ViewCommandError("The page sent invalid JSON.") from None
        kind = command.get("type") if isinstance(command, dict) else None
        run = self._commands.get(kind) if isinstance(kind, str) else None
        if run is None:
            known = ", ".join(self._commands)
            raise ViewCommandError(f"There is no command {kind!r:.100}; there are {known}.")
        run(command)
        self._due.clear()

    # What is sent.

    def _is_due(self, what: str, period_s: float) -> bool:
        now = time.monotonic()
        if now < self._due.get(what, 0.0):
            return False
        self._due[what] = now + period_s
        return True

    def _frames(self) -> list[bytes]:
        frames = self._scene.look(self._timeline.buffer, self._fixed, self._timeline.stamp_ns())
        structure = frames.structure
        base = Base(self._timeline.buffer, frames.fixed, frames.origin)
        if not base.same_place(self._base) or base.buffer is not self._base.buffer:
            self._base = base
            self._viewer.work()
        header = {
            "type": "names",
            "version": structure.version,
            "names": structure.names,
            "parents": structure.parents,
            "trees": structure.trees,
            "roots": structure.roots,
            "loops": structure.loops,
            "fixed": frames.fixed,
            "chosen": self._fixed,
        }
        packets = self._if_new("names", header)
        arrays = frames.arrays()
        key = b"".join(array.tobytes() for array in arrays.values())
        if packets or key != self._said.get("frames"):
            self._said["frames"] = key
            head = {"type": "frames", "version": structure.version, "origin": list(frames.origin)}
            stamp = self._timeline.stamp_ns() / 1e9 or float(frames.stamps.max(initial=0.0))
            packets.append(encode_packet({**head, "stamp": stamp}, arrays))
        return packets

    def _tree(self) -> list[bytes]:
        self._source.forget_former_time()
        buffer, now_ns = self._timeline.buffer, self._source.now_ns()
        self._scene.read_structure(buffer)
        rows = self._table.rows(buffer, now_ns)
        packets = [encode_packet({"type": "tree", "now": now_ns / 1e9, "rows": rows})]
        topics = self._viewer.topics()
        news = self._if_new("topics", {"type": "topics", "topics": topics})
        if news:
            self._follow_types(topics)
        packets += news
        packets += self._if_new("time", {"type": "time", **self._timeline.state()._asdict()})
        text = self._source.problem
        status = {"type": "status", "id": None, "level": "error" if text else "ok", "text": text}
        return packets + self._if_new("status", status)

    def _relate(self, target: str, source: str) -> bytes:
        answer = relation(self._timeline.buffer, target, source, self._timeline.stamp_ns())
        structure = self._scene.structure
        path = path_between(structure.names, structure.parents, target, source)
        return encode_packet({"type": "relation", **answer, "path": path})

    def _if_new(self, what: str, header: dict[str, Any]) -> list[bytes]:
        """Return the packet, if it is not the last one of its kind."""
        if self._said.get(what) == header:
            return []
        self._said[what] = header
        return [encode_packet(header)]

    # What a page may ask for.

    def _set_fixed(self, command: dict[str, Any]) -> None:
        self._fixed = _text(command, "frame")

    def _set_relation(self, command: dict[str, Any]) -> None:
        if command.get("target") is None:
            self._relation = None
        else:
            self._relation = _text(command, "target"), _text(command, "source")

    def _add(self, command: dict[str, Any]) -> None:
        name, kind, topic = (_text(command, word) for word in ("id", "kind", "topic"))
        if name in self._feeds:
            raise ViewCommandError(f"There is a display {name!r} already.")
        if len(self._feeds) >= _MOST_DISPLAYS:
            raise ViewCommandError(f"There are {_MOST_DISPLAYS} displays already.")
        wish = _Wish(kind, topic, _options(command))
        self._feeds[name] = self._viewer.new_feed(name, *wish)
        self._wishes[name] = wish
        self._share_budget()
        self._viewer.work()  # latched messages may have come already

    def _follow_types(self, topics: list[dict[str, Any]]) -> None:
        """Begin displays again whose topic has come with another type than was expected."""
        for name, wish in self._wishes.items():
            feed = self._feeds[name]
            sent = [each for each in topics if each["name"] == wish.topic and each["publishers"]]
            fits = any(each["kind"] == wish.kind for each in sent)
            if not fits or any(each["type_name"] in feed.types.values() for each in sent):
                continue
            try:
                new = self._viewer.new_feed(name, *wish)
            except (ViewCommandError, TurtlewireError) as error:
                self._refuse(error)
                continue
            new.paused = feed.paused
            self._feeds[name] = new
            feed.close()
            self._share_budget()
            self._viewer.work()

    def _remove(self, command: dict[str, Any]) -> None:
        name = _text(command, "id")
        feed = self._feeds.pop(name, None)
        if feed is not None:
            del self._wishes[name]
            feed.close()
            self._share_budget()

    def _set_options(self, command: dict[str, Any]) -> None:
        name = _text(command, "id")
        if name not in self._feeds:
            raise ViewCommandError(f"There is no display {name!r}.")
        try:
            self._feeds[name].set_options(_options(command))
            self._wishes[name] = self._wishes[name]._replace(options=_options(command))
        except OptionError as error:
            raise ViewCommandError(f"This stays as it was: {error}.") from error

    def _set_budget(self, command: dict[str, Any]) -> None:
        self._budget = int(_number(command, "points", least=1))
        self._share_budget()

    def _share_budget(self) -> None:
        if self._budget and self._feeds:
            for feed in self._feeds.values():
                feed.display.budget = max(1, self._budget // len(self._feeds))

    def _pause(self, command: dict[str, Any]) -> None:
        del command
        self._timeline.pause()
        self._hold_displays(held=self._source.kind == "live")

    def _play(self, command: dict[str, Any]) -> None:
        del command
        self._timeline.play()
        self._hold_displays(held=False)

    def _seek(self, command: dict[str, Any]) -> None:
        self._timeline.seek(round(_number(command, "stamp", least=0.0) * 1e9))
        self._hold_displays(held=self._source.kind == "live")

    def _set_speed(self, command: dict[str, Any]) -> None:
        self._timeline.set_speed(_number(command, "factor", least=1e-9))

    def _publish(self, command: dict[str, Any]) -> None:
        frame = self._base.fixed
        try:
            sent = message_of_tool(command, frame, self._base.origin, self._source.now_ns())
        except RequestError as error:
            raise ViewCommandError(f"Nothing was published: {error}.") from error
        heard = self._source.publish(*sent) > 0
        answer = {"type": "published", "topic": sent.topic, "heard": heard}
        self._answers.append(encode_packet(answer))

    def _save(self, command: dict[str, Any]) -> None:
        types = {topic.name: topic.type_name for topic in self._source.topics()}
        try:
            former = self._viewer.documents.get(str(command.get("document")))
            text = text_of_view(command, types, former)
        except RequestError as error:
            raise ViewCommandError(f"The view was not saved: {error}.") from error
        self._answers.append(encode_packet({"type": "saved", "text": text}))

    def _load(self, command: dict[str, Any]) -> None:
        text = command.get("text")
        try:
            view = read_rviz(text if isinstance(text, str) else "")
        except RvizFileError as error:
            raise ViewCommandError(f"This is not a view: {error}.") from error
        self._viewer.keep_document(view)
        self._answers.append(encode_packet(view.header()))

    def _hold_displays(self, *, held: bool) -> None:
        for feed in self._feeds.values():
            feed.paused = held


def _text(command: dict[str, Any], word: str) -> str:
    value = command.get(word)
    if not isinstance(value, str) or len(value) > _LONGEST_NAME:
        raise ViewCommandError(f"{word!r} must be a string of at most {_LONGEST_NAME} characters.")
    return value


def _number(command: dict[str, Any], word: str, *, least: float) -> float:
    value = command.get(word)
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise ViewCommandError(f"{word!r} must be a number.")
    if not least <= value < 1e12 or not math.isfinite(value):
        raise ViewCommandError(
            f"{word!r} must be a number from {least:g} to 1e12, got {value!r:.50}."
        )
    return value


def _options(command: dict[str, Any]) -> dict[str, object]:
    options = command.get("options", {})
    if not isinstance(options, dict):
        raise ViewCommandError("'options' must be an object.")
    return options
