"""The examples of the how-to page about URDF; a `text` block is the previous block's output."""

import doctest
import re
import sys
from xml.etree import ElementTree as ET

import pytest
from tests.how_to import blocks
from tests.places import HOW_TO, PATH

from turtlewire.urdf import Robot

SVG = "{http://www.w3.org/2000/svg}"
LIMIT = '<limit lower="-1.5" upper="0.25" effort="1" velocity="1"/>'
ARM = f"""<robot name="arm">
  <link name="base"/><link name="upper"/><link name="slide"/><link name="finger"/>
  <link name="wheel"/>
  <joint name="lift" type="revolute"><parent link="base"/><child link="upper"/>
    <origin xyz="0 0 1"/>{LIMIT}</joint>
  <joint name="reach" type="prismatic"><parent link="upper"/><child link="slide"/>
    <origin xyz="1 0 0"/>{LIMIT}</joint>
  <joint name="grip" type="prismatic"><parent link="slide"/><child link="finger"/>
    <mimic joint="reach"/>{LIMIT}</joint>
  <joint name="roll" type="continuous"><parent link="base"/><child link="wheel"/></joint>
</robot>"""


def parsed(robot):
    return ET.fromstring(robot._repr_html_())


def rows(robot):
    return [[cell.text or "" for cell in row] for row in parsed(robot).iterfind(".//tbody/tr")]


def caption(robot):
    return "".join(parsed(robot).find(".//caption").itertext())


def chain(count, name="link", origin="0 0 1"):
    links = "".join(f'<link name="{name}{i}"/>' for i in range(count))
    joints = "".join(
        f'<joint name="joint{i}" type="fixed"><parent link="{name}{i}"/>'
        f'<child link="{name}{i + 1}"/><origin xyz="{origin}"/></joint>'
        for i in range(count - 1)
    )
    return Robot.from_xml(f'<robot name="chain">{links}{joints}</robot>')


def test_a_robot_shows_its_tree_with_joints_and_limits():
    robot = Robot.from_xml(ARM)
    assert caption(robot) == "arm: 5 links, 4 joints"
    indent = "\N{NO-BREAK SPACE}" * 2
    assert rows(robot) == [
        ["base", "", "", ""],
        [f"{indent}upper", "lift", "revolute", "-1.5 to 0.25 rad"],
        [f"{indent * 2}slide", "reach", "prismatic", "-1.5 to 0.25 m"],
        [f"{indent * 3}finger", "grip", "prismatic", "follows reach"],
        [f"{indent}wheel", "roll", "continuous", ""],
    ]


def test_the_picture_has_a_line_per_joint_and_a_dot_per_moving_joint():
    root = parsed(Robot.from_xml(ARM))
    picture = root.find(f".//{SVG}svg")
    width, height = float(picture.get("width")), float(picture.get("height"))
    assert max(width, height) == 240
    lines = [line.get("points") for line in root.iter(f"{SVG}polyline")]
    assert len(lines) == 4
    assert len(list(root.iter(f"{SVG}circle"))) == 4
    for point in " ".join(lines).split():
        x, y = map(float, point.split(","))
        assert 12 <= x <= width - 11
        assert 12 <= y <= height - 11
    (x, low), (also_x, high) = (map(float, point.split(",")) for point in lines[0].split())
    assert (x, low > high) == (also_x, True)  # `upper` is 1 m above `base`


@pytest.mark.parametrize("xml", ['<robot name="dot"><link name="only"/></robot>'])
def test_a_robot_of_one_link_has_no_picture(xml):
    robot = Robot.from_xml(xml)
    assert caption(robot) == "dot: 1 link, 0 joints"
    assert "<svg" not in robot._repr_html_()


def test_distances_too_large_to_draw_have_no_picture():
    assert "<svg" in chain(3, origin="1e300 0 0")._repr_html_()
    assert "<svg" not in chain(3, origin="1.7e308 0 0")._repr_html_()


def test_names_cannot_contain_html():
    evil = "&lt;script&gt;alert(1)&lt;/script&gt;"
    robot = chain(2, name=evil)
    assert "<script" not in robot._repr_html_()
    assert rows(robot)[0][0] == "<script>alert(1)</script>0"


@pytest.mark.parametrize("count", [500, 501, pytest.param(10_000, marks=pytest.mark.slow)])
def test_the_first_500_links_are_shown(count):
    robot = chain(count)
    assert len(rows(robot)) == 500
    cut = "; the first 500 links shown" if count > 500 else ""
    assert caption(robot) == f"chain: {count:,} links, {count - 1:,} joints{cut}"
    assert len(robot._repr_html_()) < 300_000
    assert len(repr(robot)) < 100


def test_a_loop_of_mimic_joints_is_reported_below_the_table():
    loop = ARM.replace(LIMIT, '<mimic joint="grip"/>' + LIMIT, 1).replace(
        'xyz="1 0 0"/>', 'xyz="1 0 0"/><mimic joint="lift"/>'
    )
    robot = Robot.from_xml(loop)
    assert len(rows(robot)) == 5
    assert "mimic" in parsed(robot).find("p").text
    assert "<svg" not in robot._repr_html_()


def test_warnings_are_counted():
    visual = '<visual><geometry><sphere radius="1"/></geometry><material name="m"/></visual>'
    robot = Robot.from_xml(f'<robot name="odd"><link name="l">{visual}</link></robot>')
    assert len(robot.warnings) == 1
    assert parsed(robot).find(".//p").text == "1 warning; see robot.warnings"


def test_the_text_of_a_robot_is_one_short_line():
    assert repr(Robot.from_xml(ARM)) == "<Robot 'arm': 5 links, 4 joints, 4 moving>"


PAGE = HOW_TO / "urdf.md"


def commands(text):
    """The lines of a shell block; a here-document is one, and so is a line that is continued."""
    text = text.replace("\\\n", "")
    found = re.findall(r"^(?:cat .*?^END$|.+?)(?:\n|\Z)", text, re.MULTILINE | re.DOTALL)
    return [line.rstrip("\n") for line in found]


@pytest.mark.slow
def test_the_page_does_what_it_says(run, tmp_path):
    path = PATH
    options = {"cwd": tmp_path, "environment": {"PATH": path}}
    found = blocks(PAGE.read_text())
    assert len(found) == 13
    printed = ""
    for kind, text in found:
        if kind == "text":
            flags = doctest.ELLIPSIS
            assert doctest.OutputChecker().check_output(text, printed, flags), printed
        elif kind == "python":
            printed = outcome(run(sys.executable, "-c", text, **options))
        else:
            for line in commands(text):
                if line.endswith(" &"):
                    run("bash", "-c", f"exec {line.removesuffix(' &')}", **options)
                else:
                    printed = outcome(run("bash", "-c", line, **options))


def outcome(program):
    """Return the output, without the log and the waiting time for the first transform."""
    assert program.wait() == 0, program.text
    skipped = ("[INFO]", "Waiting", "Warning")
    return "".join(
        f"{line}\n" for line in program.text.splitlines() if not line.startswith(skipped)
    )
