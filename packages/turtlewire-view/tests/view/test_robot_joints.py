"""A robot without a network: its joints are moved on the page."""

import math

import pytest

import turtlewire
from turtlewire.urdf import Robot
from turtlewire_view.buffer_source import RobotSource

URDF = """<robot name="crane">
  <link name="mast"/><link name="boom"/><link name="hook"/><link name="flag"/>
  <joint name="lift" type="revolute">
    <parent link="mast"/><child link="boom"/><origin xyz="0 0 2"/><axis xyz="0 -1 0"/>
    <limit lower="-1" upper="2" effort="1" velocity="3"/>
  </joint>
  <joint name="rope" type="prismatic">
    <parent link="boom"/><child link="hook"/><origin xyz="1 0 0"/><axis xyz="1 0 0"/>
    <limit lower="0.25" upper="0.75" effort="1" velocity="1"/>
  </joint>
  <joint name="wind" type="continuous">
    <parent link="mast"/><child link="flag"/><mimic joint="lift" multiplier="2" offset="1"/>
  </joint>
</robot>"""


@pytest.fixture(autouse=True)
def no_desktop(monkeypatch):
    monkeypatch.setenv("TURTLEWIRE_BROWSER", "0")


@pytest.fixture
def source():
    return RobotSource(Robot.from_xml(URDF))


def place(source, link):
    place = source.buffer.lookup_transform("mast", link).translation
    return tuple(round(value, 6) for value in place)


def test_joints_start_within_their_limits(source):
    lift, rope, wind = source.joints.description()
    assert lift == {
        "name": "lift", "kind": "revolute", "mimic": None, "minimum": -1, "maximum": 2, "zero": 0,
        "max_velocity": 3,
    }  # fmt: skip
    assert (rope["kind"], rope["minimum"], rope["maximum"], rope["zero"]) == (
        "prismatic", 0.25, 0.75, 0.5
    )  # fmt: skip
    assert wind["mimic"] == {"parent": "lift", "factor": 2, "offset": 1}
    assert source.joints.positions() == [0, 0.5, 1]
    assert place(source, "hook") == (1.5, 0, 2)


@pytest.mark.parametrize("positions", [{"lift": 0.5}, [0.5, 0.3], {"lift": [0.5]}])
def test_positions_of_the_program_come_first(positions):
    source = RobotSource(Robot.from_xml(URDF), positions)
    assert source.joints.positions()[0] == 0.5


def test_a_moved_joint_moves_its_links_and_those_that_follow(source):
    source.joints.move({"lift": math.pi / 2, "rope": 0.25})
    assert place(source, "hook") == (0, 0, 3.25)
    assert source.joints.positions() == [math.pi / 2, 0.25, math.pi + 1]
    source.joints.move({"rope": 5})
    assert source.joints.positions()[1] == 0.75


@pytest.mark.parametrize(
    ("positions", "why"),
    [
        ({"lft": 1}, r"the robot has no free joint 'lft'\. Did you mean: lift"),
        ({"wind": 1}, "the robot has no free joint 'wind'"),
        ({"lift": "1"}, "the position of 'lift' must be a number, got '1'"),
        ({"lift": True}, "the position of 'lift' must be a number, got True"),
        ({"lift": math.nan}, "the position of 'lift' must be a number, got nan"),
        ({"lift": 10**400}, "the position of 'lift' must be a number, got 1000"),
    ],
)
def test_moves_that_are_refused(source, positions, why):
    with pytest.raises(ValueError, match=why):
        source.joints.move({"rope": 0.3, **positions})
    assert source.joints.positions() == [0, 0.5, 1]


def test_pages_share_the_joints(open_view_page):
    with turtlewire.show(Robot.from_xml(URDF), port=0) as view:
        first, second = open_view_page(view), open_view_page(view)
        for page in (first, second):
            page.wait_for("joints", lambda packet: len(packet["joints"]) == 3)
            page.wait_for("positions", lambda packet: packet["of"] == [0, 0.5, 1])
        first.send("move", positions={"rope": 0.75})
        second.wait_for("positions", lambda packet: packet["of"] == [0, 0.75, 1])
        second.wait_for("frames", lambda packet: second.places(packet)["hook"] == (1.75, 0, 2))
        first.send("move", positions={"rpe": 0.75})
        first.wait_for("error", lambda packet: "Did you mean: rope" in packet["text"])


def test_a_buffer_has_no_joints_to_move(open_view_page):
    with turtlewire.show(turtlewire.Buffer(), port=0) as view:
        page = open_view_page(view)
        page.send("move", positions={"rope": 0.75})
        page.wait_for("error", lambda packet: packet["text"] == "Here are no joints to move.")
        assert "joints" not in page.kinds()


def slider(page, name):
    return page.locator(f".joint[data-name={name}] input[type=range]")


def test_the_sliders_of_the_page(open_view):
    with turtlewire.show(Robot.from_xml(URDF), port=0) as view:
        page = open_view(view.url)
        slider(page, "lift").fill("10000")
        page.wait_for_function(
            "() => document.querySelector('.joint[data-name=wind] .value input')?.value === '5.000'"
        )
        assert page.locator(".joint[data-name=wind] .value input").is_disabled()
        page.get_by_role("button", name="Degrees").click()
        assert page.locator(".joint[data-name=lift] .value input").input_value() == "114.6"
        page.get_by_role("button", name="Center").click()
        page.wait_for_function(
            "() => document.querySelector('.joint[data-name=lift] .value input').value === '0.0'"
        )
        assert slider(page, "rope").input_value() == "5000"
        page.get_by_role("button", name="Randomize").click()
        page.wait_for_function(
            "() => document.querySelector('.joint[data-name=lift] .value input').value !== '0.0'"
        )


def test_without_a_robot_there_are_no_sliders(fake, open_view):
    fake.names({"map": ""})
    page = open_view(fake.url)
    page.wait_for_selector("#tree .row")
    assert page.locator("#joints").is_hidden()
