"""`turtlewire.show`: a buffer, a robot, a connection or a bag in the view."""

import doctest
import threading

import pytest
from tests.bags import write_bag
from tests.pages import wait_until
from tests.places import HOW_TO

import turtlewire
from turtlewire import viewing
from turtlewire.errors import TurtlewireError
from turtlewire.urdf import Robot
from turtlewire_view import BufferSource

from .test_page import PIXELS

SECOND = 1_000_000_000
ARM = """<robot name="crane">
  <link name="mast">
    <visual><origin xyz="0 0 1"/><geometry><box size="0.2 0.2 2"/></geometry>
      <material name="red"><color rgba="0.8 0.1 0.1 1"/></material></visual>
  </link>
  <link name="boom">
    <visual><origin xyz="0.75 0 0"/><geometry><box size="1.5 0.1 0.1"/></geometry>
      <material name="blue"><color rgba="0.1 0.2 0.8 1"/></material></visual>
  </link>
  <joint name="lift" type="revolute">
    <parent link="mast"/><child link="boom"/><origin xyz="0 0 2"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
</robot>"""


@pytest.fixture(autouse=True)
def no_desktop(monkeypatch):
    monkeypatch.setenv("TURTLEWIRE_BROWSER", "0")


@pytest.fixture
def buffer():
    buffer = turtlewire.Buffer(cache_time_ns=None)
    for second in range(5):
        buffer.set_transform("world", "turtle", second * SECOND, (second, 2, 0))
    buffer.set_static_transform("turtle", "camera", (0, 0, 1))
    return buffer


def test_pages_follow_a_buffer(buffer, open_view_page):
    with turtlewire.show(buffer, port=0) as view:
        page = open_view_page(view)
        page.wait_for_places({"world": (0, 0, 0), "turtle": (4, 2, 0), "camera": (4, 2, 1)})
        assert page.wait_for("hello")["source"] == {"kind": "live", "name": "buffer"}
        buffer.set_transform("world", "turtle", 9 * SECOND, (7, 0, 0))
        page.wait_for_places({"world": (0, 0, 0), "turtle": (7, 0, 0), "camera": (7, 0, 1)})
        page.send("seek", stamp=1.5)
        page.wait_for_places({"world": (0, 0, 0), "turtle": (1.5, 2, 0), "camera": (1.5, 2, 1)})


def test_a_closed_view_does_not_follow(buffer):
    source = BufferSource(buffer, "it")
    changes = []
    source.on_change(lambda: changes.append(1))
    buffer.set_transform("world", "turtle", 9 * SECOND, (0, 0, 0))
    source.close()
    buffer.set_transform("world", "turtle", 10 * SECOND, (0, 0, 0))
    assert changes == [1]


def test_a_buffer_has_no_network(buffer):
    source = BufferSource(buffer, "it")
    answers = []
    source.ask_parameter("/node", "robot", answers.append)()
    assert "a buffer has no parameters, so 'robot' of /node" in answers[0].problem
    with pytest.raises(TurtlewireError, match="a buffer, not a network, so nothing was published"):
        source.publish("/goal", "std_msgs/msg/String", b"")
    assert source.topics() == []
    assert source.now_ns() == 4 * SECOND


def test_fixed_frame_comes_first(buffer, open_view_page):
    with turtlewire.show(buffer, port=0, fixed_frame="turtle") as view:
        page = open_view_page(view)
        page.wait_for_places({"turtle": (0, 0, 0), "world": (-4, -2, 0), "camera": (0, 0, 1)})


def test_a_robot_is_drawn(open_view):
    with turtlewire.show(Robot.from_xml(ARM), port=0) as view:
        page = open_view(view.url)
        page.wait_for_selector("#tree .row:has-text('boom')")
        page.wait_for_selector("#displays :text('/robot_description')")
        drawn = f"""async (points) => (await ({PIXELS})(points))
            .every(([r, g, b], row) => row ? b > r + 60 : r > b + 60)"""
        assert wait_until(page, drawn, [[0, 0, 1], [0.75, 0, 2]])  # the red mast, the blue boom
        assert page.title().startswith("crane")


def test_a_robot_with_given_positions(tmp_path, open_view_page):
    sliding = ARM.replace("revolute", "prismatic")
    (tmp_path / "crane.urdf").write_text(sliding)
    for what in (Robot.from_xml(sliding), tmp_path / "crane.urdf"):
        with turtlewire.show(what, positions={"lift": 0.5}, port=0) as view:
            page = open_view_page(view)
            assert page.wait_for("hello")["source"]["name"] == "crane"
            page.wait_for_places({"mast": (0, 0, 0), "boom": (0, 0.5, 2)})
    with pytest.raises(KeyError, match=r"no free joint 'lft'\. Did you mean: lift"):
        turtlewire.show(Robot.from_xml(ARM), positions={"lft": 1})


def test_positions_need_a_robot(buffer):
    with pytest.raises(TypeError, match="`positions` are those of a robot's joints; got Buffer"):
        turtlewire.show(buffer, positions={"lift": 1})
    with pytest.raises(ValueError, match="one position of each joint, and got 2"):
        turtlewire.show(Robot.from_xml(ARM), positions={"lift": [0, 1]})


def test_a_bag_and_what_is_none(tmp_path, open_view_page):
    with turtlewire.show(write_bag(tmp_path / "made"), port=0) as view:
        hello = open_view_page(view).wait_for("hello")
        assert hello["source"] == {"kind": "bag", "name": "made"}
    with pytest.raises(FileNotFoundError):
        turtlewire.show(tmp_path / "none", port=0)
    with pytest.raises(ValueError, match=r"for XML, pass Robot\.from_xml"):
        turtlewire.show(ARM, port=0)
    with pytest.raises(TypeError, match=r"a Buffer, a Robot, a Connection, .* got int"):
        turtlewire.show(3, port=0)


def test_a_connection_is_shown_without_a_participant_of_its_own(open_view_page):
    with turtlewire.connect("mover", middleware="local") as net:
        net.send_static_transform("map", "odom", (1, 2, 3))
        with turtlewire.show(net, port=0) as view:
            open_view_page(view).wait_for_places({"map": (0, 0, 0), "odom": (1, 2, 3)})
        net.send_static_transform("map", "after", (0, 0, 0))  # the connection is open


def test_wait_returns_when_the_view_is_closed(buffer):
    view = turtlewire.show(buffer, port=0)
    thread = threading.Thread(target=view.wait)
    thread.start()
    view.close()
    view.close()
    thread.join(120)
    assert not thread.is_alive()


def test_without_the_view_the_error_says_what_to_install(monkeypatch):
    monkeypatch.setattr(viewing, "declared", lambda *_: {})
    with pytest.raises(ImportError, match="pip install turtlewire-view"):
        turtlewire.show()


def test_the_how_to_shows_a_buffer():
    failed, tried = doctest.testfile(str(HOW_TO / "view.md"), module_relative=False)
    assert (failed, tried) == (0, 6)
