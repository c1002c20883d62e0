"""The parser against urdfdom's rules and texts: golden logs, and rules beyond them."""

from __future__ import annotations

import contextlib
import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests import archive, places
from turtlewire.urdf import Mimic, Pose, Robot, UrdfError
from turtlewire.urdf.elements import MAX_DEPTH
from turtlewire.urdf.faults import XACRO_LEFT, log_lines
from turtlewire.urdf.model import Box, Cylinder, JointLimits, Mesh
from turtlewire.urdf.values import as_number

GOLDEN = places.GOLDEN / "robots"
INVALID = archive.read(GOLDEN / "invalid.txt")
VALID = {
    name.removesuffix(".urdf"): entry.content.decode()
    for name, entry in archive.read(GOLDEN / "urdf.txt").items()
}
REFUSED = json.loads(INVALID["expected.json"].content)
LINES = {
    "bad_number": (6, '<origin> in <joint name="j">'),
    "duplicate_link": (5, '<link name="a">'),
    "missing_child": (5, '<joint name="j">'),
    "missing_limit": (5, '<joint name="j">'),
    "two_roots": (5, '<link name="c">'),
    "unknown_type": (5, '<joint name="j">'),
}


def refusal(text: str | bytes) -> UrdfError:
    with pytest.raises(UrdfError) as caught:
        Robot.from_xml(text)
    return caught.value


def robot(*elements: str) -> str:
    return "\n".join(['<robot name="r">', *elements, "</robot>"])


def two_links(joint: str) -> str:
    return robot('<link name="a"/>', '<link name="b"/>', joint)


ENDS = '<parent link="a"/><child link="b"/>'


@pytest.mark.parametrize("name", sorted(REFUSED))
def test_texts_of_urdfdom_with_line_and_element(name):
    error = refusal(INVALID[f"{name}.urdf"].content.decode())
    texts = [line.removeprefix("Error: ") for line in REFUSED[name]["log"][:-2]]
    assert error.reports == texts
    assert (error.line, error.element) == LINES[name]
    assert str(error) == texts[0]
    assert error.hint == f"line {error.line} in {error.element}"


def test_golden_invalid_files_are_all_there():
    assert len(REFUSED) == len(INVALID) - 1 == 6


@pytest.mark.parametrize(
    ("name", "links", "joints", "root"),
    [
        ("centipede", 15, 14, "c_seg0"),
        ("ladder", 60, 59, "rung_0"),
        ("pebble", 1, 0, "pebble_link"),
        ("raft", 8, 7, "raft_root"),
        ("sluice", 7, 6, "sluice_base"),
        ("weaver", 8, 7, "loom"),
    ],
)
def test_golden_robots(tmp_path, name, links, joints, root):
    (tmp_path / "robot.urdf").write_text(VALID[name])
    found = Robot.load(tmp_path / "robot.urdf")
    assert (len(found.links), len(found.joints), found.root) == (links, joints, root)
    assert found.warnings == ()


def test_contents_of_the_model():
    sluice = Robot.from_xml(VALID["sluice"])
    base = sluice.links["sluice_base"]
    assert base.visuals[0].geometry == Box((0.1, 0.2, 0.1))
    assert base.visuals[0].origin == Pose((0.0, 0.0, 0.05))
    assert base.visuals[0].material.rgba == (0.7, 0.4, 0.2, 1.0)
    assert base.collisions[0].geometry == Cylinder(radius=0.05, length=0.1)
    mesh = sluice.links["wrist"].visuals[0].geometry
    assert mesh == Mesh("package://no_such_package/meshes/claw.stl", (0.001, 0.001, 0.001))
    bend = sluice.joints["bend"]
    assert bend.axis == (1.0, 0.0, 0.0)  # the default
    assert bend.limits == JointLimits(lower=0.2, upper=1.4, effort=30.0, velocity=2.5)
    assert (bend.safety.soft_lower_limit, bend.safety.k_velocity) == (0.4, 5.0)
    assert sluice.joints["lift"].axis == (0.0, 0.0, 2.0)  # as the file gives it
    assert sluice.joints["turn"].dynamics.damping == 0.7
    weaver = Robot.from_xml(VALID["weaver"])
    assert weaver.joints["a_follow"].mimic == Mimic("m_source", -0.5, 0.25)
    assert weaver.joints["plain_mimic"].mimic == Mimic("m_source", 1.0, 0.0)
    raft = Robot.from_xml(VALID["raft"])
    assert raft.links["raft_root"].inertial.izz == 0.03
    assert [joint.name for joint in raft.child_joints["raft_root"]] == ["drift", "slide"]
    assert raft.parent_joints["deck"].name == "drift"


JOINT_REFUSALS = [
    ('<joint name="j" type="fixed"><child link="b"/></joint>', "Failed to build tree: Joint [j] is missing a parent and/or child link specification."),
    (f'<joint name="j">{ENDS}</joint>', "joint [j] has no type, check to see if it's a reference."),
    (f'<joint type="fixed">{ENDS}</joint>', "unnamed joint found"),
    (f'<joint name="j" type="prismatic">{ENDS}</joint>', "Joint [j] is of type PRISMATIC without limits"),
    (f'<joint name="j" type="revolute">{ENDS}<limit velocity="1"/></joint>', "joint limit: no effort"),
    (f'<joint name="j" type="revolute">{ENDS}<limit effort="1"/></joint>', "joint limit: no velocity"),
    (f'<joint name="j" type="revolute">{ENDS}<limit lower="x"/></joint>', "lower value (x) is not a valid float"),
    (f'<joint name="j" type="continuous">{ENDS}<mimic/></joint>', "joint mimic: no mimic joint specified"),
    (f'<joint name="j" type="continuous">{ENDS}<dynamics/></joint>', "joint dynamics element specified with no damping and no friction"),
    (f'<joint name="j" type="continuous">{ENDS}<safety_controller/></joint>', "joint safety: no k_velocity"),
    (f'<joint name="j" type="continuous">{ENDS}<axis xyz="1 0"/></joint>', "Malformed axis element for joint [j]: Parser found 2 elements but 3 expected while parsing vector [1 0]"),
    (f'<joint name="j" type="continuous">{ENDS}<axis xyz="0 0 0"/></joint>', "Malformed axis element for joint [j]: it is zero, which is not a direction"),
    ('<joint name="j" type="fixed"><parent link="c"/><child link="b"/></joint>', 'Failed to build tree: parent link [c] of joint [j] not found.  This is not valid according to the URDF spec. Every link you refer to from a joint needs to be explicitly defined in the robot description. To fix this problem you can either remove this joint [j] from your urdf file, or add "<link name="c" />" to your urdf file.'),
    ("", "Failed to find root link: Two root links found: [a] and [b]"),
    (f'<joint name="j" type="fixed">{ENDS}</joint>' * 2, "joint 'j' is not unique."),
    (f'<joint name="i" type="fixed">{ENDS}</joint><joint name="j" type="fixed">{ENDS}</joint>', "Failed to build tree: link [b] is the child of the joints [i] and [j]"),
    (f'<joint name="i" type="fixed">{ENDS}</joint><joint name="j" type="fixed"><parent link="b"/><child link="a"/></joint>', "Failed to find root link: No root link found. The robot xml is not a valid tree."),
    (f'<link name="c"/><link name="root"/><joint name="i" type="fixed">{ENDS}</joint><joint name="j" type="fixed"><parent link="b"/><child link="a"/></joint><joint name="k" type="fixed"><parent link="root"/><child link="c"/></joint>', "Failed to build tree: the links a -> b -> a form a loop"),
]  # fmt: skip


@pytest.mark.parametrize(("joint", "text"), JOINT_REFUSALS)
def test_joints_that_urdfdom_refuses(joint, text):
    error = refusal(two_links(joint))
    assert str(error) == text
    assert error.line in (1, 3, 4)


#: Errors that urdfdom logs before it goes on without the rest of the link, tried with Debian's.
LINK_FAULTS = [
    ('<link name="a"><inertial/></link>', ["Inertial element must have a mass element", "Could not parse inertial element for Link [a]"]),
    ('<link name="a"><inertial><mass value="1"/></inertial></link>', ["Inertial element must have inertia element", "Could not parse inertial element for Link [a]"]),
    ('<link name="a"><visual><geometry/></visual></link>', ["Geometry tag contains no child element.", "Could not parse visual element for Link [a]"]),
    ('<link name="a"><collision><geometry><cone/></geometry></collision></link>', ["Unknown geometry type 'cone'", "Could not parse collision element for Link [a]"]),
    ('<link name="a"><visual><geometry><cylinder radius="1"/></geometry></visual></link>', ["Cylinder shape must have both length and radius attributes", "Could not parse visual element for Link [a]"]),
    ('<link name="a"><visual><geometry><cylinder length="1"/></geometry></visual></link>', ["Cylinder shape must have both length and radius attributes", "Could not parse visual element for Link [a]"]),
    ('<link name="a"><visual><geometry><sphere/></geometry></visual></link>', ["Sphere shape must have a radius attribute", "Could not parse visual element for Link [a]"]),
    ('<link name="a"><collision><geometry><box/></geometry></collision></link>', ["Box shape has no size attribute", "Could not parse collision element for Link [a]"]),
]  # fmt: skip


def test_one_link_without_a_name_is_a_warning():
    """urdfdom gives it the empty name: no joint can refer to it, and a second one is refused."""
    found = Robot.from_xml(robot("<link><visual/></link>"))
    (warning,) = found.warnings
    assert (warning.errors, warning.line) == (("No name given for the link.",), 2)
    assert (list(found.links), found.root, found.links[""].visuals) == ([""], "", ())
    assert str(refusal(robot("<link/>", "<link/>"))) == "link '' is not unique."
    child = '<joint name="j" type="fixed"><parent link="a"/><child link=""/></joint>'
    assert "missing a parent and/or child" in str(refusal(robot('<link name="a"/><link/>', child)))


def test_one_material_without_a_name_is_a_warning():
    material = '<material><color rgba="1 0 0 1"/></material>'
    found = Robot.from_xml(robot(material, '<link name="a"/>'))
    (warning,) = found.warnings
    assert (warning.errors, warning.line) == (("Material must contain a name attribute",), 2)
    assert str(refusal(robot(material * 2, '<link name="a"/>'))) == "material '' is not unique."


@pytest.mark.parametrize(("link", "texts"), LINK_FAULTS)
def test_a_fault_in_a_link_leaves_the_rest_of_it_out(link, texts):
    found = Robot.from_xml(robot(link))
    (warning,) = found.warnings
    assert (warning.text, list(warning.errors), warning.line) == (texts[0], texts, 2)
    first, place, *others = log_lines(warning)
    assert [first, *others] == [f"Error:   {text}" for text in texts]
    assert place.startswith("         at line 2 in <")
    assert found.links["a"].visuals == found.links["a"].collisions == ()


def test_items_before_a_faulty_mesh_are_kept():
    ball, mesh = "<geometry><sphere radius='1'/></geometry>", "<geometry><mesh/></geometry>"
    parts = f"<visual name='v'>{ball}</visual><visual>{mesh}</visual><collision>{ball}</collision>"
    found = Robot.from_xml(robot(f'<link name="a">{parts}</link>'))
    assert [visual.name for visual in found.links["a"].visuals] == ["v"]
    assert found.links["a"].collisions == ()


def test_robots_that_urdfdom_refuses():
    assert str(refusal("<robot/>")) == "No name given for the robot."
    assert str(refusal('<robot name="r"/>')) == "No link elements found in urdf file"
    assert str(refusal("<sdf/>")) == "Could not find the 'robot' element in the xml file"
    assert "version 1.0" in str(refusal('<robot name="r" version="2.0"><link name="a"/></robot>'))
    twice = robot('<material name="m"/>' * 2, '<link name="a"/>')
    assert str(refusal(twice)) == "material 'm' is not unique."


def test_an_unknown_material_is_a_warning():
    visual = '<visual><geometry><sphere radius="1"/></geometry><material name="m"/></visual>'
    found = Robot.from_xml(robot("", f'<link name="l">\n\n{visual}</link>'))
    assert [warning.text for warning in found.warnings] == ["link 'l' material 'm' undefined."]
    assert found.warnings[0].place == 'line 5 in <visual> in <link name="l">'
    assert list(log_lines(found.warnings[0])) == [
        "Warning: link 'l' material 'm' undefined.",
        '         at line 5 in <visual> in <link name="l">',
    ]


def test_elements_of_xacro_are_one_warning():
    left = '<xacro:macro name="leg"/>\n<xacro:leg/>'
    found = Robot.from_xml(robot("", f'<link name="l"/>\n{left}'))
    assert [warning.text for warning in found.warnings] == [XACRO_LEFT]
    assert "xacro FILE" in XACRO_LEFT
    assert found.warnings[0].place == 'line 4 in <xacro:macro name="leg">'


def test_limits_the_wrong_way_round_are_a_warning():
    ends = '<parent link="a"/><child link="b"/><limit lower="2" upper="1" effort="1" velocity="1"/>'
    links = '<link name="a"/><link name="b"/>'
    for kind, number in (("revolute", 1), ("prismatic", 1), ("continuous", 0)):
        found = Robot.from_xml(robot("", f'{links}<joint name="j" type="{kind}">{ends}</joint>'))
        assert len(found.warnings) == number
        for warning in found.warnings:
            assert "its lower limit, 2, is above its upper limit, 1" in warning.text


def test_non_string_description():
    with pytest.raises(TypeError, match=r"str or bytes, got NoneType; for a file, use Robot\.load"):
        Robot.from_xml(None)


def test_a_material_of_the_robot_colours_its_visuals():
    visual = '<visual><geometry><sphere radius="1"/></geometry><material name="m"/></visual>'
    material = '<material name="m"><color rgba="1 0 0 1"/></material>'
    found = Robot.from_xml(robot(f'<link name="l">{visual}</link>', material))
    assert found.links["l"].visuals[0].material.rgba == (1.0, 0.0, 0.0, 1.0)


def test_unknown_elements_are_ignored():
    found = Robot.from_xml(
        robot("<gazebo/>", "<ros2_control><joint/></ros2_control>", '<link name="l"/>')
    )
    assert list(found.links) == ["l"]


def test_a_name_with_braces_and_percent_signs():
    joint = f'<joint name="{{}}{{0}}%s" type="revolute">{ENDS}</joint>'
    assert str(refusal(two_links(joint))).startswith("Joint [{}{0}%s] is of type REVOLUTE")


def test_text_before_the_declaration_counts_as_lines():
    error = refusal('\n\n<?xml version="1.0"?>\n<robot name="r">\n<link name="a"/><joint/></robot>')
    assert error.line == 5


@pytest.mark.parametrize(
    ("text", "value"), [("1", 1.0), ("-.5", -0.5), ("+1.e3", 1000.0), (" 7", 7.0), ("1e-999", 0.0)]
)
def test_numbers(text, value):
    assert as_number(text) == value


@pytest.mark.parametrize(
    "text", ["", "nan", "inf", "-Infinity", "1e999", "0x10", "1 ", "1,5", "1_0", "٣", "1e", "."]
)
def test_invalid_numbers(text):
    assert as_number(text) is None


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_every_double_is_read_exactly(number):
    assert as_number(repr(number)) == number


BOMB = (
    '<!DOCTYPE robot [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">]>'
    '<robot name="&b;"><link name="l"/></robot>'
)
EXTERNAL = '<!DOCTYPE robot [<!ENTITY x SYSTEM "file:///etc/passwd">]><robot name="&x;"/>'


@pytest.mark.parametrize("text", [BOMB, EXTERNAL])
def test_entities_are_refused(text):
    error = refusal(text)
    assert "is not allowed" in str(error)
    assert error.line == 1


@pytest.mark.parametrize(
    ("text", "what", "line"),
    [
        ("", "empty", 0),
        (" \n ", "empty", 0),
        ("no xml", "not well-formed", 1),
        ('<robot name="r">\n<link name="a">\n</robot>', "<link> is never closed", 2),
        ('<robot name="r">\n', "<robot> is never closed", 1),
        (b'<robot name="\xff\xfe"/>', "not well-formed", 1),
        (b'<?xml version="1.0" encoding="klingon"?><robot/>', "klingon", 1),
        ('<robot name="r">\n<link name="a" name="b"/></robot>', "duplicate attribute", 2),
        ('<robot name="r">\n&nbsp;</robot>', "undefined entity", 2),
        ("<robot name='\0'/>", "not well-formed", 1),
        ("<robot name='r'>" + "<a>" * 100_000, "nested more than", 1),
    ],
)
def test_broken_xml_is_one_error_with_a_line(text, what, line):
    error = refusal(text)
    assert what in str(error)
    assert error.line == line


def test_the_number_of_elements_is_limited(monkeypatch):
    monkeypatch.setattr("turtlewire.urdf.elements.MAX_ELEMENTS", 3)
    links = [f'<link name="{name}"/>' for name in "abc"]
    assert str(refusal(robot(*links[:2]))).startswith("Failed to find root link")
    assert str(refusal(robot(*links))) == "The file has more than 3 elements"


def test_nesting_up_to_the_limit_is_read():
    deep = "<a>" * (MAX_DEPTH - 1) + "</a>" * (MAX_DEPTH - 1)
    assert Robot.from_xml(robot(deep, '<link name="l"/>')).root == "l"


@pytest.mark.parametrize("number", ["nan", "inf", "1e999", "-1e400"])
def test_numbers_that_are_none_or_too_large(number):
    error = refusal(
        two_links(f'<joint name="j" type="fixed"><origin rpy="0 {number} 0"/>{ENDS}</joint>')
    )
    assert str(error).startswith(f"Unable to parse component [{number}] to a double")
    assert error.line == 4


@given(st.text(alphabet='<>/="& abcj\n', max_size=60))
def test_any_text_is_a_robot_or_a_refusal(text):
    with contextlib.suppress(UrdfError):
        assert Robot.from_xml(text).links


@given(st.data())
def test_a_damaged_robot_is_a_robot_or_a_refusal(data):
    text = VALID["raft"]
    begin = data.draw(st.integers(0, len(text)))
    end = data.draw(st.integers(begin, min(len(text), begin + 40)))
    piece = data.draw(st.text(alphabet='<>/" 01.e-nx', max_size=8))
    with contextlib.suppress(UrdfError):
        assert Robot.from_xml(text[:begin] + piece + text[end:]).root


@pytest.mark.slow
def test_a_loop_of_ten_thousand_links_is_one_error():
    count = 10_000
    links = "".join(f'<link name="l{number}"/>' for number in range(count))
    joints = "\n".join(
        f'<joint name="j{number}" type="fixed"><parent link="l{number}"/>'
        f'<child link="l{(number + 1) % count}"/></joint>'
        for number in range(count)
    )
    error = refusal(robot(links, joints))
    assert error.reports == [
        "Failed to find root link: No root link found. The robot xml is not a valid tree."
    ]
    beside = refusal(robot('<link name="root"/>', links, joints))
    assert str(beside).startswith("Failed to build tree: the links ")
    assert beside.line > 3


def test_log_lines_are_limited_and_escaped():
    long = refusal(robot(f'<link name="{"9" * 1_000_000}\u202e"/>' * 2))
    assert all(len(line) < 1100 and line.isprintable() for line in log_lines(long))
    name = refusal(robot('<link name="\u202e"/>' * 2))
    assert next(log_lines(name)) == r"Error:   link '\u202e' is not unique."


def test_an_error_survives_pickling():
    import pickle

    error = refusal(robot('<link name="a"/><joint/>'))
    copy = pickle.loads(pickle.dumps(error))
    assert (str(copy), copy.reports, copy.line) == (str(error), error.reports, error.line)
