"""One page: its fixed frame, time and displays, its requests, and data still to be sent."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from turtlewire.errors import TurtlewireError
from turtlewire.web import CommandSession
from turtlewire.web.commands import CommandError
from turtlewire.web.packets import encode_packet
from turtlewire_view import page_commands
from turtlewire_view.displays import displays_of
from turtlewire_view.displays.options import OptionError
from turtlewire_view.frames import Base, FrameScene
from turtlewire_view.page_requests import feedback_message, message_of_tool, text_of_view
from turtlewire_view.rviz_file import RvizFileError, read_rviz
from turtlewire_view.tree import TreeTable, missing_frame, path_between, relation

if TYPE_CHECKING:
    from turtlewire_view.display_feed import DisplayFeed
    from turtlewire_view.frames import Frames
    from turtlewire_view.rviz_file import SavedView
    from turtlewire_view.source import Source

__all__ = ["SessionHost", "ViewSession"]

_FRAMES_S, _RELATION_S, _TREE_S = 1 / 31, 0.1, 1.0
_MOST_DISPLAYS = 100


class SessionHost(Protocol):
    """The part of :class:`turtlewire_view.viewer.Viewer` that sessions use."""

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
        """Forget a page that was closed."""
        ...


class _Wish(NamedTuple):
    """A request of a page."""

    kind: str
    topic: str
    options: dict[str, object]


class ViewSession(CommandSession):
    """The server's thread calls all methods but :meth:`base`."""

    def __init__(self, viewer: SessionHost) -> None:
        super().__init__(page_commands.READER)
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
        self._answers += [viewer.hello(), *viewer.first_view()]
        self._actions: dict[type, Callable[[Any], None]] = {
            page_commands.ChooseFixedFrame: self._set_fixed,
            page_commands.ChooseRelation: self._set_relation,
            page_commands.AddDisplay: self._add,
            page_commands.RemoveDisplay: self._remove,
            page_commands.ChangeDisplay: self._set_options,
            page_commands.SetBudget: self._set_budget,
            page_commands.PauseTime: self._pause,
            page_commands.PlayTime: self._play,
            page_commands.SeekTime: self._seek,
            page_commands.ChangePace: self._set_speed,
            page_commands.PublishWithTool: self._publish,
            page_commands.GiveFeedback: self._give_feedback,
            page_commands.SaveView: self._save,
            page_commands.LoadView: self._load,
            page_commands.MoveJoints: self._move,
        }

    @property
    def base(self) -> Base:
        """Base that poses refer to; for any thread."""
        return self._base

    @property
    def feeds(self) -> list[DisplayFeed]:
        """The displays; for any thread."""
        return list(self._feeds.values())

    def news(self) -> list[str | bytes]:
        """Return the packets that the page does not have yet."""
        packets: list[str | bytes] = []
        if self._is_due("tree", _TREE_S):
            packets += self._tree()
        if self._is_due("frames", _FRAMES_S):
            packets += [*self._joints(), *self._frames()]
        if self._relation is not None and self._is_due("relation", _RELATION_S):
            packets.append(self._relate(*self._relation))
        for feed in self._feeds.values():
            packets += feed.take_packets()
        return packets

    def obey(self, command: Any) -> None:
        """Carry out a command; one that fails is answered by an ``error``."""
        try:
            self._actions[type(command)](command)
        except TurtlewireError as error:
            self.refuse(error)
        self._due.clear()

    def closed(self) -> None:
        """The page was closed."""
        for feed in self._feeds.values():
            feed.close()
        self._feeds.clear()
        self._wishes.clear()
        self._viewer.forget(self)

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
        # No transform of a bag is still to come.
        own_frames = self._source.kind == "bag" and not structure.names
        base = Base(self._timeline.buffer, frames.fixed, frames.origin, own_frames=own_frames)
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
            stamp = self._shown_s(frames)
            packets.append(encode_packet({**head, "stamp": stamp}, arrays))
        return packets

    def _joints(self) -> list[bytes]:
        joints = self._source.joints
        if joints is None:
            return []
        if "joints" not in self._said:
            self._said["joints"] = joints.description()
            first = [encode_packet({"type": "joints", "joints": self._said["joints"]})]
        else:
            first = []
        return first + self._if_new("positions", {"type": "positions", "of": joints.positions()})

    def _tree(self) -> list[bytes]:
        self._source.drop_old_timeline()
        buffer, now_ns = self._timeline.buffer, self._source.now_ns()
        self._scene.read_structure(buffer)
        rows = self._table.rows(buffer, now_ns, self._source.departed_frames())
        packets = [encode_packet({"type": "tree", "now": now_ns / 1e9, "rows": rows})]
        topics = self._viewer.topics()
        news = self._if_new("topics", {"type": "topics", "topics": topics})
        if news:
            self._follow_types(topics)
        packets += news
        packets += self._if_new("time", {"type": "time", **self._timeline.state()._asdict()})
        problem = self._source.problem
        typo = missing_frame(self._fixed, self._scene.structure.names)
        level = "error" if problem else "warn" if typo else "ok"
        status = {"type": "status", "id": None, "level": level, "text": problem or typo}
        return packets + self._if_new("status", status)

    def _shown_s(self, frames: Frames) -> float:
        stamp_ns = self._timeline.stamp_ns()
        return float(frames.stamps.max(initial=0.0)) if stamp_ns is None else stamp_ns / 1e9

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

    def _set_fixed(self, command: page_commands.ChooseFixedFrame) -> None:
        self._fixed = command.frame

    def _set_relation(self, command: page_commands.ChooseRelation) -> None:
        target, source = command
        self._relation = None if target is None else (target, source)

    def _add(self, command: page_commands.AddDisplay) -> None:
        name, kind, topic, options = command
        if name in self._feeds:
            raise CommandError(f"There is a display {name!r} already.")
        if len(self._feeds) >= _MOST_DISPLAYS:
            raise CommandError(f"There are {_MOST_DISPLAYS} displays already.")
        wish = _Wish(kind, topic, options)
        self._feeds[name] = self._viewer.new_feed(name, *wish)
        self._wishes[name] = wish
        self._share_budget()
        self._viewer.work()  # latched messages may have come already

    def _follow_types(self, topics: list[dict[str, Any]]) -> None:
        """Begin displays again whose topic has come with another type than was expected."""
        for name, wish in self._wishes.items():
            feed = self._feeds[name]
            sent = [each for each in topics if each["name"] == wish.topic and each["publishers"]]
            known = displays_of(wish.kind)
            fits = any(each["type_name"] in known for each in sent)
            if not fits or any(each["type_name"] in feed.types.values() for each in sent):
                continue
            try:
                self._begin_again(name, wish)
            except (CommandError, TurtlewireError) as error:
                self.refuse(error)

    def _begin_again(self, name: str, wish: _Wish) -> None:
        """Replace a display by one that subscribes to other topics or types."""
        former = self._feeds[name]
        new = self._viewer.new_feed(name, *wish)
        new.paused = former.paused
        self._feeds[name] = new
        self._wishes[name] = wish
        former.close()
        self._share_budget()
        self._viewer.work()

    def _remove(self, command: page_commands.RemoveDisplay) -> None:
        (name,) = command
        feed = self._feeds.pop(name, None)
        if feed is not None:
            del self._wishes[name]
            feed.close()
            self._share_budget()

    def _set_options(self, command: page_commands.ChangeDisplay) -> None:
        name, options = command
        if name not in self._feeds:
            raise CommandError(f"There is no display {name!r}.")
        try:
            self._feeds[name].set_options(options)
            self._wishes[name] = self._wishes[name]._replace(options=options)
            if self._feeds[name].needs_other_topics:
                self._begin_again(name, self._wishes[name])
        except OptionError as error:
            raise CommandError(f"This stays as it was: {error}.") from error

    def _set_budget(self, command: page_commands.SetBudget) -> None:
        self._budget = int(command.points)
        self._share_budget()

    def _share_budget(self) -> None:
        if self._budget and self._feeds:
            for feed in self._feeds.values():
                feed.display.budget = max(1, self._budget // len(self._feeds))

    def _pause(self, _command: page_commands.PauseTime) -> None:
        self._timeline.pause()
        self._hold_displays(held=self._source.kind == "live")

    def _play(self, _command: page_commands.PlayTime) -> None:
        self._timeline.play()
        self._hold_displays(held=False)

    def _seek(self, command: page_commands.SeekTime) -> None:
        self._timeline.seek(round(command.stamp * 1e9))
        self._hold_displays(held=self._source.kind == "live")

    def _set_speed(self, command: page_commands.ChangePace) -> None:
        self._timeline.set_speed(command.factor)

    def _publish(self, command: page_commands.PublishWithTool) -> None:
        frame = self._base.fixed
        try:
            sent = message_of_tool(command, frame, self._base.origin, self._source.now_ns())
        except CommandError as error:
            raise CommandError(f"Nothing was published: {error}.") from error
        heard = self._source.publish(*sent) > 0
        self.answer({"type": "published", "topic": sent.topic, "heard": heard})

    def _give_feedback(self, command: page_commands.GiveFeedback) -> None:
        feed = self._feeds.get(command.id)
        if feed is None:
            raise CommandError(f"There is no display {command.id!r}.")
        self._source.publish(*feedback_message(command, feed, self._base, self._source.now_ns()))

    def _save(self, command: page_commands.SaveView) -> None:
        types = {topic.name: topic.type_name for topic in self._source.topics()}
        try:
            former = self._viewer.documents.get(command.document or "")
            text = text_of_view(command, types, former)
        except CommandError as error:
            raise CommandError(f"The view was not saved: {error}.") from error
        self.answer({"type": "saved", "text": text})

    def _load(self, command: page_commands.LoadView) -> None:
        try:
            view = read_rviz(command.text)
        except RvizFileError as error:
            raise CommandError(f"This is not a view: {error}.") from error
        self._viewer.keep_document(view)
        self.answer(view.header())

    def _move(self, command: page_commands.MoveJoints) -> None:
        if self._source.joints is None:
            raise CommandError("Here are no joints to move.")
        try:
            self._source.joints.move(command.positions)
        except ValueError as error:
            raise CommandError(f"Nothing was moved: {error}") from error

    def _hold_displays(self, *, held: bool) -> None:
        for feed in self._feeds.values():
            feed.paused = held
