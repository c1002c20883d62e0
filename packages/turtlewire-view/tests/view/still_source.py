"""A source of the view that holds what a test gives it: no wire, and no time but the test's."""

from __future__ import annotations

import threading

from turtlewire import msg
from turtlewire.tf.buffer import Buffer
from turtlewire_view.live import LiveTimeline
from turtlewire_view.source import ParameterAnswer, ServiceAnswer, Topic

STAMP_NS = 1_700_000_000 * 10**9


class StillSource:
    """Frames of the robot ``map`` → ``base`` (1, 0, 0) → ``tip`` (0, 1, 0), and given messages."""

    kind = "live"
    name = "still"
    history_ns = 60 * 10**9
    listeners = 1
    problem = ""
    joints = None

    def __init__(self) -> None:
        self.buffer = Buffer()
        self.departed: list[str] = []
        self.published: list[tuple[str, str, bytes]] = []
        self._sent = threading.Condition()
        self.parameters: dict[tuple[str, str], str] = {}
        self.advertised: list[tuple[str, str]] = []
        self._responses: dict[str, object] = {}
        self._askers: dict[str, list] = {}
        self._topics: dict[str, Topic] = {}
        self._sinks: dict[str, list] = {}
        self._last: dict[str, list[bytes]] = {}
        self._changed = lambda: None
        self.put_frame("map", "base", (1, 0, 0))
        self.put_frame("base", "tip", (0, 1, 0))

    def put_frame(self, parent, child, place):
        self.buffer.set_static_transform(parent, child, place, (0, 0, 0, 1))
        self._changed()

    def offer(self, topic, message):
        """A topic with a message, which each new subscription gets; more messages may follow."""
        type_name = msg.type_name(type(message))
        self._topics[topic] = Topic(topic, type_name, 1)
        self._last.setdefault(topic, [])
        self.send(topic, message)

    def send(self, topic, message):
        cdr = msg.serialize(message)
        self._last[topic].append(cdr)
        for sink in self._sinks.get(topic, []):
            sink(cdr)
        self._changed()

    def now_ns(self):
        return STAMP_NS

    def departed_frames(self):
        return self.departed

    def new_timeline(self):
        return LiveTimeline(self)

    def topics(self):
        return sorted(self._topics.values())

    def subscribe(self, topic, type_name, on_message):
        del type_name
        self._sinks.setdefault(topic, []).append(on_message)
        for cdr in self._last.get(topic, []):
            on_message(cdr)
        return lambda: self._sinks[topic].remove(on_message)

    def ask_parameter(self, node, name, on_answer):
        text = self.parameters.get((node, name))
        problem = "" if text else f"the node {node} has no parameter '{name}'"
        on_answer(ParameterAnswer(text or "", problem))
        return lambda: None

    def respond(self, service, response):
        """The response of a service from now on; displays that ask already get it."""
        self._responses[service] = response
        for on_answer in self._askers.get(service, []):
            on_answer(ServiceAnswer(msg.serialize(response)))
        self._changed()

    def ask_service(self, name, type_name, on_answer):
        del type_name
        source, askers = self, self._askers.setdefault(name, [])

        class Calls:
            def again(self):
                response = source._responses.get(name)
                problem = "" if response else f"no server offers the service {name}"
                cdr = msg.serialize(response) if response else b""
                on_answer(ServiceAnswer(cdr, problem))

            def close(self):
                askers.remove(on_answer)

        askers.append(on_answer)
        calls = Calls()
        calls.again()
        return calls

    def advertise(self, topic, type_name):
        self.advertised.append((topic, type_name))

    def publish(self, topic, type_name, cdr):
        with self._sent:
            self.published.append((topic, type_name, cdr))
            self._sent.notify_all()
        return self.listeners

    def wait_until(self, is_true):
        """Return True if it becomes true; looks after each message that is published."""
        with self._sent:
            return self._sent.wait_for(is_true, 60)

    def drop_old_timeline(self):
        pass

    def on_change(self, call):
        self._changed = call

    def close(self):
        pass
