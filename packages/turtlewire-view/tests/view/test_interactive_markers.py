"""Interactive markers: the set that a server offers, its changes, and what users do with it."""

import math

import pytest

from turtlewire import msg
from turtlewire.errors import WireError
from turtlewire.tf.buffer import Buffer
from turtlewire.web.commands import CommandError
from turtlewire_view import BufferSource, LiveSource, Viewer
from turtlewire_view.displays.content import Content, Removal, Status
from turtlewire_view.displays.interactive_markers import InteractiveMarkersDisplay
from turtlewire_view.frames import Base
from turtlewire_view.page_commands import GiveFeedback
from turtlewire_view.page_requests import feedback_message

from .still_source import StillSource

get = msg.get_message
NAMES = ("InteractiveMarker", "InteractiveMarkerControl", "InteractiveMarkerUpdate")
Marker, Control, Update = (get(f"visualization_msgs/msg/{name}") for name in NAMES)
Shape = get("visualization_msgs/msg/Marker")
Pose = get("visualization_msgs/msg/InteractiveMarkerPose")
Entry = get("visualization_msgs/msg/MenuEntry")
Feedback = get("visualization_msgs/msg/InteractiveMarkerFeedback")
Service = msg.get_service("visualization_msgs/srv/GetInteractiveMarkers")
SERVICE, UPDATE = "/arm/get_interactive_markers", "/arm/update"


def marker(name="knob", *controls, frame="base", x=0.0, stamp_s=0, **values):
    message = Marker(name=name, controls=list(controls), **values)
    message.header.frame_id = frame
    message.header.stamp.sec = stamp_s
    message.pose.position.x = x
    return message


def moved(name, x, frame="base"):
    message = Pose(name=name)
    message.header.frame_id = frame
    message.pose.position.x = x
    return message


def update(number, *markers, poses=(), erases=()):
    return Update(type=1, seq_num=number, markers=markers, poses=poses, erases=erases)


@pytest.fixture
def display():
    display = InteractiveMarkersDisplay()
    display.topic = UPDATE
    return display


def respond(display, number, *markers):
    return display.take(SERVICE, Service.Response(sequence_number=number, markers=markers))


def contents(outputs):
    return {each.part: each for each in outputs if isinstance(each, Content)}


def removed(outputs):
    return [each.part for each in outputs if isinstance(each, Removal)]


def status_of(outputs):
    return next((each.level, each.text) for each in outputs if isinstance(each, Status))


def places(outputs):
    return {name: each.header["pose"][0] for name, each in contents(outputs).items()}


def test_the_response_and_later_updates(display):
    assert display.service == (SERVICE, "visualization_msgs/srv/GetInteractiveMarkers")
    assert display.sends == ("/arm/feedback", "visualization_msgs/msg/InteractiveMarkerFeedback")
    outputs = respond(display, 7, marker("a"), marker("b", x=1.0))
    assert places(outputs) == {"a": 0, "b": 1}
    assert status_of(outputs) == ("ok", "")
    outputs = display.take(UPDATE, update(8, poses=[moved("b", 2.0)], erases=["a", "c"]))
    assert (places(outputs), removed(outputs)) == ({"b": 2}, ["a"])
    assert display.asks_again is False
    assert display.marker("a") is None
    assert display.marker("b").header["pose"][0] == 2


def test_a_display_that_cannot_call_its_service_leaves_no_subscription(monkeypatch):
    def ask_service(*_args):
        raise WireError("the context has been closed")

    source = StillSource()
    source.offer(UPDATE, update(1))
    monkeypatch.setattr(source, "ask_service", ask_service)
    with Viewer(source, port=0) as viewer, pytest.raises(WireError):
        viewer.new_feed("d", "interactive_markers", UPDATE, {})
    assert source._sinks == {UPDATE: []}


def test_an_update_that_came_before_the_response_is_not_lost(display):
    outputs = display.take(UPDATE, update(8, marker("a", x=8.0)))
    assert places(outputs) == {"a": 8}
    assert status_of(outputs)[0] == "warn"
    outputs = respond(display, 7, marker("a"), marker("b"))
    assert list(places(outputs).items()) == [("a", 8), ("b", 0)]
    assert display.take(UPDATE, update(9, erases=["b"]))
    assert display.asks_again is False


def test_an_older_update_does_not_replace_the_response(display):
    display.take(UPDATE, update(6, marker("a", x=6.0), marker("gone")))
    outputs = respond(display, 7, marker("a", x=7.0))
    assert (places(outputs), removed(outputs)) == ({"a": 7}, ["gone"])


@pytest.mark.parametrize(("first", "second"), [(7, 9), (7, 1), (7, 7)])
def test_a_gap_or_another_server_asks_again(display, first, second):
    respond(display, first, marker("a"))
    display.take(UPDATE, update(second, marker("b")))
    assert display.asks_again
    outputs = respond(display, second, marker("b"))
    assert removed(outputs) == ["a"]


def test_a_keep_alive_changes_nothing(display):
    respond(display, 7, marker("a"))
    assert contents(display.take(UPDATE, Update(type=0, seq_num=7))) == {}
    assert display.asks_again is False
    display.take(UPDATE, Update(type=0, seq_num=8))
    assert display.asks_again


def test_without_the_service_only_changes_are_shown(display):
    (status,) = display.take_problem("no server offers the service /arm/get_interactive_markers")
    assert status.level == "warn"
    assert status.text.startswith("Only changed markers are shown: no server offers the service")
    outputs = display.take(UPDATE, update(3, marker("a")))
    assert places(outputs) == {"a": 0}
    assert status_of(outputs) == ("warn", status.text)


def test_a_marker_as_a_header(display):
    axis = Control(name="x", interaction_mode=3, orientation_mode=2)
    axis.orientation.z, axis.orientation.w = 2.0, 0.0
    ball = Shape(type=2)
    ball.scale.x, ball.color.a = 0.5, 1.0
    button = Control(name="b", interaction_mode=2, markers=[ball], description="press")
    entries = [Entry(id=1, title="Go"), Entry(id=2, parent_id=1, title="Far"),
               Entry(id=3, title="Run", command_type=1, command="turtlesim x")]  # fmt: skip
    knob = marker("knob", axis, button, scale=0.0, description="Drag", menu_entries=entries)
    (content,) = contents(respond(display, 1, knob)).values()
    header = content.header
    assert (content.frame_id, content.locked, header["scale"]) == ("base", True, 1)
    assert header["description"] == "Drag"
    assert header["menu"][1] == {"id": 2, "parent": 1, "title": "Far", "runs": ""}
    assert header["menu"][2]["runs"] == "turtlesim x"
    first, second = header["controls"]
    assert first == {
        "name": "x", "mode": "move_axis", "orientation": "view_facing", "turn": [0, 0, 1, 0],
        "independent": False, "description": "", "markers": [],
    }  # fmt: skip
    (shape,) = second["markers"]
    assert (shape["shape"], shape["scale"], shape["points"]) == ("sphere", [0.5, 1, 1], [0, 0])


def test_markers_in_the_marker_s_frame_become_relative(display):
    ball = Shape(type=2)
    ball.header.frame_id = "base"
    ball.pose.position.x, ball.color.a = 3.0, 1.0
    turned = marker("knob", Control(markers=[ball]), x=1.0)
    turned.pose.orientation.z = turned.pose.orientation.w = math.sqrt(0.5)
    (content,) = contents(respond(display, 1, turned)).values()
    (shape,) = content.header["controls"][0]["markers"]
    assert shape["pose"] == pytest.approx([0, -2, 0, 0, 0, -math.sqrt(0.5), math.sqrt(0.5)])


def test_a_stamped_marker_stays_where_it_was(display):
    (content,) = contents(respond(display, 1, marker(stamp_s=5))).values()
    assert (content.locked, content.stamp_ns) == (False, 5 * 10**9)


def test_a_moved_marker_keeps_its_revision_and_a_new_one_does_not(display):
    def revision(outputs):
        return contents(outputs)["a"].header["revision"]

    first = revision(respond(display, 1, marker("a")))
    assert revision(display.take(UPDATE, update(2, poses=[moved("a", 1.0)]))) == first
    assert revision(display.take(UPDATE, update(3, marker("a")))) != first


def bad_pose():
    message = marker("bad")
    message.pose.position.x = math.nan
    return message


@pytest.mark.parametrize(
    ("wrong", "line"),
    [
        (marker("bad", frame=""), "marker 'bad': header.frame_id is empty"),
        (bad_pose(), "marker 'bad': the pose holds a number that is not finite"),
        (marker("bad", scale=-1.0), "marker 'bad': the scale -1.0 cannot be drawn"),
        (marker("bad", scale=math.inf), "marker 'bad': the scale inf cannot be drawn"),
    ],
)
def test_a_wrong_marker_is_named_and_the_others_are_drawn(display, wrong, line):
    respond(display, 0, marker("bad"))
    outputs = display.take(UPDATE, update(1, wrong, marker("good")))
    assert (list(contents(outputs)), removed(outputs)) == (["good"], ["bad"])
    level, text = status_of(outputs)
    assert (level, text[: len(line)]) == ("warn", line)


def foreign_ball():
    ball = Shape(type=2)
    ball.header.frame_id = "map"
    ball.color.a = 1.0
    return ball


def unturned():
    control = Control(name="c")
    control.orientation.x = math.inf
    return control


@pytest.mark.parametrize(
    ("control", "line"),
    [
        (Control(name="c", interaction_mode=10), "control 'c': the interaction mode 10 is unknown"),
        (Control(name="c", orientation_mode=3), "control 'c': the orientation mode 3 is unknown"),
        (unturned(), "control 'c': the orientation is not finite, so it is not turned"),
        (Control(name="c", markers=[Shape(type=99)]), "control 'c': the type 99 is unknown"),
        (Control(name="c", markers=[foreign_ball()]),
         "control 'c': a marker in the frame 'map' is left out; its frame must be empty or 'base'"),
    ],
)  # fmt: skip
def test_a_wrong_control_is_named(display, control, line):
    outputs = respond(display, 1, marker("knob", control))
    assert list(contents(outputs)) == ["knob"]
    level, text = status_of(outputs)
    assert (level, text[: len(line)]) == ("warn", line)


def test_too_many_controls_and_menu_entries_are_cut(display):
    many = marker("many", *[Control(interaction_mode=3)] * 10_000)
    many.menu_entries = [Entry(id=k) for k in range(5000)]
    outputs = respond(display, 1, marker("few", Control()), many, marker("last", Control()))
    sizes = {name: len(each.header["controls"]) for name, each in contents(outputs).items()}
    assert sizes == {"few": 1, "many": 999, "last": 0}
    assert len(contents(outputs)["many"].header["menu"]) == 1000
    assert status_of(outputs)[1].startswith("999 of 10000 controls are drawn (and 2 more)")


def test_too_many_markers_are_named(display):
    outputs = respond(display, 1, *[marker(str(k)) for k in range(1001)])
    assert len(contents(outputs)) == 1000
    text = "there are 1000 markers already, so '1000' is left out"
    assert status_of(outputs) == ("warn", text)


def test_a_repeated_menu_entry_is_shown_once(display):
    entries = [Entry(id=1, title="a"), Entry(id=1, parent_id=1, title="b")]
    outputs = respond(display, 1, marker(menu_entries=entries))
    assert len(contents(outputs)["knob"].header["menu"]) == 1
    assert status_of(outputs)[1] == "two menu entries have the id 1; the first one is shown"


class Feed:
    name = "d1"

    def __init__(self, display):
        self.display = display


def sent(display, source, **values):
    fields = {"pose": [1, 2, 3, 0, 0, 0, 1], **values}
    command = GiveFeedback("d1", "knob", "x", 1, **fields)
    base = Base(source.buffer, "map", (0.0, 0.0, 0.0))
    message = feedback_message(command, Feed(display), base, 5 * 10**9 + 7)
    assert message.topic == "/arm/feedback"
    return msg.deserialize(Feedback, message.cdr)


def test_feedback_is_in_the_frame_of_a_marker_without_a_stamp(display):
    respond(display, 1, marker())
    feedback = sent(display, StillSource(), mouse_point=[4, 5, 6], menu_entry=9)
    assert (feedback.header.frame_id, feedback.header.stamp.sec) == ("base", 0)
    assert (feedback.client_id, feedback.control_name) == ("turtlewire_view/d1", "x")
    at = feedback.pose.position
    assert (at.x, at.y, at.z, feedback.pose.orientation.w) == (1, 2, 3, 1)
    assert (feedback.mouse_point_valid, feedback.mouse_point.z) == (True, 6)
    assert (feedback.event_type, feedback.menu_entry_id) == (1, 9)


def test_feedback_is_in_the_fixed_frame_for_a_marker_with_a_stamp(display):
    respond(display, 1, marker(stamp_s=1))
    feedback = sent(display, StillSource(), mouse_point=[4, 5, 6])
    stamp = feedback.header.stamp
    assert (feedback.header.frame_id, stamp.sec, stamp.nanosec) == ("map", 5, 7)
    assert (feedback.pose.position.x, feedback.mouse_point.x) == (2, 5)
    assert sent(display, StillSource()).mouse_point_valid is False


@pytest.mark.parametrize(
    ("values", "line"),
    [
        ({"pose": [1, 2]}, "pose must be a list of 7 finite numbers"),
        ({"pose": [math.nan] * 7}, "pose must be a list of 7 finite numbers"),
        ({"pose": [10**400] * 7}, "pose must be a list of 7 finite numbers"),
        ({"pose": ["1"] * 7}, "pose must be a list of 7 finite numbers"),
        ({"mouse_point": [1]}, "mouse_point must be a list of 3 finite numbers"),
        ({"menu_entry": -1}, "event must be from 0 to 5"),
        ({"menu_entry": 2**32}, "event must be from 0 to 5"),
    ],
)
def test_feedback_that_makes_no_sense_is_refused(display, values, line):
    respond(display, 1, marker())
    with pytest.raises(CommandError, match=line):
        sent(display, StillSource(), **values)


def test_feedback_on_an_unknown_marker_is_refused(display):
    with pytest.raises(CommandError, match="There is no interactive marker 'knob'"):
        sent(display, StillSource())


def test_a_page_gets_markers_and_gives_feedback(open_view_page):
    source = StillSource()
    source.offer(UPDATE, update(1))
    source.respond(SERVICE, Service.Response(sequence_number=1, markers=[marker(x=1.0)]))
    with Viewer(source, "map", port=0) as viewer:
        page = open_view_page(viewer)
        page.send("add", id="a", kind="interactive_markers", topic=UPDATE, options={})
        shown = page.wait_for("display")
        assert (shown["part"], shown["frame"], shown["pose"][0]) == ("knob", "base", 1)
        assert source.advertised == [
            ("/arm/feedback", "visualization_msgs/msg/InteractiveMarkerFeedback")
        ]
        values = {"marker": "knob", "control": "", "event": 5, "pose": [0, 0, 0, 0, 0, 0, 1]}
        page.send("feedback", id="a", **values)
        page.send("feedback", id="b", **values)
        page.wait_for("error", lambda packet: packet["text"] == "There is no display 'b'.")
        ((topic, _, cdr),) = source.published
        assert (topic, msg.deserialize(Feedback, cdr).event_type) == ("/arm/feedback", 5)
        new = Service.Response(sequence_number=5, markers=[marker("other")])
        source.respond(SERVICE, new)
        page.wait_for("display", lambda packet: packet["part"] == "other")
        page.wait_for("removed", lambda packet: packet["part"] == "knob")
        source.respond(SERVICE, Service.Response(sequence_number=8, markers=[marker("last")]))
        source.send(UPDATE, update(20))  # a gap: the service is called again
        page.wait_for("display", lambda packet: packet["part"] == "last")


def test_a_buffer_and_an_invalid_name_have_no_service():
    live = LiveSource()
    buffer = BufferSource(Buffer(), "buffer")
    for source, name, line in (
        (buffer, "/a", "a buffer has no services, so /a cannot be called"),
        (live, "not a name", "'not a name' is not the name of a service: "),
    ):
        answers = []
        calls = source.ask_service(
            name, "visualization_msgs/srv/GetInteractiveMarkers", answers.append
        )
        calls.again()
        calls.close()
        ((cdr, problem),) = answers
        assert cdr == b""
        assert problem.startswith(line)
    live.close()
