"""Robots: their models, meshes and joints; and messages of tools."""

import math
import os

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.places import GOLDEN

import turtlewire
from tests import archive
from turtlewire import msg
from turtlewire.urdf import Robot
from turtlewire.web.commands import CommandError
from turtlewire_view.buffer_source import RobotSource
from turtlewire_view.displays.robot_model import RobotModelDisplay
from turtlewire_view.meshes import MeshFile, MeshLibrary, mesh_address
from turtlewire_view.package_folders import PackageFolders
from turtlewire_view.page_commands import PublishWithTool
from turtlewire_view.page_requests import TOOLS, message_of_tool
from turtlewire_view.tree import TreeTable

ROBOTS = archive.read(GOLDEN / "robots" / "urdf.txt")
URDF = """<robot name="arm">
  <material name="blue"><color rgba="0 0 1 0.5"/></material>
  <link name="base">
    <visual><geometry><box size="1 2 3"/></geometry><material name="blue"/>
      <origin xyz="1 0 0" rpy="0 0 1.5707963267948966"/></visual>
    <collision><geometry><sphere radius="0.5"/></geometry></collision>
  </link>
  <link name="tip">
    <visual><geometry><mesh filename="{mesh}" scale="1 -1 1"/></geometry></visual>
    <visual><geometry><cylinder radius="0.1" length="2"/></geometry></visual>
  </link>
  <joint name="j" type="fixed"><parent link="base"/><child link="tip"/></joint>
</robot>"""


def described(text, **options):
    String = msg.get_message("std_msgs/msg/String")  # noqa: N806
    return RobotModelDisplay(options).content(String(data=text))


@pytest.fixture
def prefix(tmp_path, monkeypatch, meshes):
    """A prefix with the package ``arm``, which has a mesh, a texture and a secret."""
    (tmp_path / "share/ament_index/resource_index/packages/leg").touch()
    for name in ("tip one.stl", "skin.png", "notes.txt"):
        (meshes / name).write_text(name)
    (tmp_path / "share/secret.stl").touch()
    monkeypatch.setenv("AMENT_PREFIX_PATH", f"/nowhere:{tmp_path}")
    return tmp_path


def test_shapes_hang_on_the_frames_of_their_links(prefix):
    (prefix / "share/arm/meshes/tip.dae").touch()
    content, status = described(URDF.format(mesh="package://arm/meshes/tip.dae"))
    assert status.level == "ok"
    assert content.frame_id is None
    assert content.packages == (("arm", str(prefix / "share/arm")),)
    base, tip = content.header["links"]
    assert (content.header["robot"], base["frame"], tip["frame"]) == ("arm", "base", "tip")
    (box,) = base["visuals"]
    assert (box["shape"], box["size"], box["color"]) == ("box", [1, 2, 3], [0, 0, 255, 128])
    assert box["origin"] == pytest.approx([1, 0, 0, 0, 0, math.sqrt(0.5), math.sqrt(0.5)])
    assert base["collisions"][0]["size"] == [0.5]
    mesh, cylinder = tip["visuals"]
    assert mesh["mesh"] == {
        "name": "package://arm/meshes/tip.dae", "url": "/mesh/arm/meshes/tip.dae"
    }  # fmt: skip
    assert (mesh["size"], mesh["color"]) == ([1, -1, 1], None)
    assert cylinder["size"] == [0.1, 2]


def test_a_capsule_is_a_cylinder_with_two_spheres(monkeypatch):
    monkeypatch.setenv("ROS_DISTRO", "lyrical")
    shape = '<origin xyz="1 0 0" rpy="0 1.5707963267948966 0"/><geometry>'
    shape += '<capsule radius="0.5" length="2"/></geometry>'
    text = f'<robot name="r" version="1.1"><link name="a"><visual>{shape}</visual></link></robot>'
    (link,) = described(text)[0].header["links"]
    cylinder, first, second = link["visuals"]
    assert (cylinder["shape"], cylinder["size"]) == ("cylinder", [0.5, 2])
    assert [first["shape"], second["shape"]] == ["sphere", "sphere"]
    assert first["size"] == second["size"] == [0.5]
    assert first["origin"][:3] == pytest.approx([2, 0, 0])
    assert second["origin"][:3] == pytest.approx([0, 0, 0])


def test_a_prefix_of_frames():
    content, _ = described(URDF.format(mesh="package://a/b.stl"), tf_prefix="left/")
    assert content.header["links"][0]["frame"] == "left/base"


def test_a_robot_of_a_file(prefix):
    file = prefix / "share/arm/arm.urdf"
    file.write_text(URDF.format(mesh="package://arm/meshes/none.stl"))
    for name in (str(file), f"file://{file}", "package://arm/arm.urdf"):
        display = RobotModelDisplay({"source": "file", "description_file": name})
        content, status = display.start()
        assert content.header["robot"] == "arm"
        assert "has no file 'meshes/none.stl'" in status.text
        assert display.content(None) == []
    assert RobotModelDisplay().start() == []


@pytest.mark.parametrize(
    ("file", "why"),
    [
        ("/etc/passwd", "'/etc/passwd' is not the path of a .urdf file"),
        ("package://arm/../../etc/a.urdf", "is not the path of a .urdf file"),
        ("package://nowhere/a.urdf", "is not the path of a .urdf file"),
        ("/nowhere/a.urdf", "'/nowhere/a.urdf' cannot be read: No such file or directory"),
        ("/a\0.urdf", "'/a\\x00.urdf' cannot be read: "),
    ],
)
def test_files_that_are_no_robot(file, why):
    (status,) = RobotModelDisplay({"source": "file", "description_file": file}).start()
    assert status.level == "error"
    assert why in status.text


@pytest.mark.parametrize("name", ROBOTS)
def test_each_golden_robot_is_drawn(name):
    text = ROBOTS[name].content.decode()
    content, status = described(text)
    assert len(content.header["links"]) == len(Robot.from_xml(text).links)
    assert status.level in {"ok", "warn"}


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("", "the description is invalid: The description is empty"),
        ("<robot name='x'/>", "the description is invalid: No link elements found in urdf file"),
        ("<robot", "the description is invalid: "),
        ("hello", "the description is invalid: "),
    ],
)
def test_a_description_that_is_none(text, line):
    (status,) = described(text)
    assert (status.level, status.text[: len(line)]) == ("error", line)


def test_elements_that_urdfdom_forgives_are_named_in_the_status():
    text = "<robot name='x'>\n<link name='a'><inertial><mass value='b'/></inertial></link></robot>"
    content, status = described(text)
    assert content.header["links"]
    assert status.level == "warn"
    assert '(line 2 in <mass> in <link name="a">)' in status.text


@pytest.mark.parametrize(
    ("uri", "why"),
    [
        ("package://../../etc/passwd", "'..' is not the name of a package"),
        ("package://arm/../../etc/passwd.stl", "does not stay below the package"),
        ("package://arm/%2e%2e/%2e%2e/etc/a.stl", "does not stay below the package"),
        ("package://arm//etc/a.stl", "does not stay below the package"),
        ("package://arm/.ssh/a.stl", "holds a name that is not served"),
        ("package://arm/a\\b.stl", "holds a name that is not served"),
        ("package://nowhere/a.stl", "there is no package 'nowhere' in AMENT_PREFIX_PATH"),
        ("package://arm/a.stl", "the package 'arm' has no file 'a.stl'"),
        ("package://arm/id_rsa", "is not a mesh that the page can read"),
        ("package://arm/a.png", "is not a mesh that the page can read"),
        ("file:///etc/passwd", "is not below the share folder of a package"),
        ("/etc/a.stl", "is not below the share folder of a package"),
        ("http://example.com/a.stl", "only package:// addresses are"),
        ("model://arm/a.stl", "only package:// addresses are"),
        ("a.stl", "only package:// addresses are"),
        ("", "only package:// addresses are"),
    ],
)
@pytest.mark.usefixtures("prefix")
def test_addresses_that_are_refused(uri, why):
    address = mesh_address(uri, PackageFolders())
    assert address.url is None
    assert why in address.problem
    content, status = described(URDF.format(mesh=uri))
    assert status.level == "warn"
    assert why in status.text
    assert content.header["links"][1]["visuals"][0]["mesh"]["problem"] == address.problem


def test_meshes_of_named_packages_are_served(prefix):
    library = MeshLibrary()
    asked = "/mesh/arm/meshes/tip one.stl"
    address = mesh_address("package://arm/meshes/tip one.stl", PackageFolders())
    assert address.url == "/mesh/arm/meshes/tip%20one.stl"
    assert library.find(asked) == "no robot or marker names a mesh of the package 'arm'"
    assert library.answer("/mesh/arm/meshes/tip one.stl") is None
    library.permit(address.packages)
    file = str(prefix / "share/arm/meshes/tip one.stl")
    assert library.find(asked) == MeshFile(file, "model/stl")
    assert library.answer(asked) == (b"tip one.stl", "model/stl")
    assert library.answer("/other") is None
    assert library.find("/mesh/arm/meshes/skin.png").media_type == "image/png"
    assert mesh_address(f"file://{file}", PackageFolders()).url == address.url
    assert mesh_address(f"{prefix}/share/secret.stl", PackageFolders()).url is None


@pytest.mark.parametrize(
    ("path", "why"),
    [
        ("/mesh/arm/meshes/notes.txt", "neither a mesh nor a texture"),
        ("/mesh/arm/meshes/none.stl", "has no file 'meshes/none.stl'"),
        ("/mesh/arm/meshes", "neither a mesh nor a texture"),
        ("/mesh/arm/../secret.stl", "does not stay below"),
        ("/mesh/arm/a\0.stl", "not served"),
        ("/mesh/leg/a.stl", "no robot or marker names"),
        ("/mesh/", "is not the name of a package"),
        ("/mesh/../../etc/passwd", "is not the name of a package"),
    ],
)
def test_urls_that_are_refused(prefix, path, why):
    library = MeshLibrary()
    library.permit([("arm", str(prefix / "share/arm")), ("..", str(prefix))])
    answer = library.find(path)
    assert isinstance(answer, str)
    assert why in answer


@pytest.mark.skipif(not os.path.exists("/proc/self/mem"), reason="Linux only")
def test_a_mesh_that_cannot_be_read_is_answered_as_a_missing_one(prefix, caplog):
    os.symlink("/proc/self/mem", prefix / "share/arm/meshes/faulty.stl")
    why = "the file 'meshes/faulty.stl' of the package 'arm' cannot be read: Input/output error"
    _, status = described(URDF.format(mesh="package://arm/meshes/faulty.stl"))
    assert (status.level, status.text.count(why)) == ("warn", 1)
    library = MeshLibrary()
    library.permit([("arm", str(prefix / "share/arm"))])
    assert library.answer("/mesh/arm/meshes/faulty.stl") is None
    assert f"The page did not get /mesh/arm/meshes/faulty.stl: {why}" in caplog.text


@pytest.mark.usefixtures("prefix")
def test_a_mesh_that_becomes_unreadable_is_answered_as_a_missing_one(meshes, monkeypatch, caplog):
    library, file = MeshLibrary(), meshes / "tip one.stl"
    library.permit([("arm", str(meshes.parent))])
    find = library.find

    def find_and_delete(url_path):
        found = find(url_path)
        file.unlink()
        return found

    monkeypatch.setattr(library, "find", find_and_delete)
    assert library.answer("/mesh/arm/meshes/tip one.stl") is None
    assert caplog.text.endswith("the file cannot be read: No such file or directory\n")


@given(st.text(st.sampled_from("ab./\\%2e:\0 ~"), max_size=20))
def test_no_path_leads_out_of_a_package(tail):
    library = MeshLibrary()
    library.permit([("arm", "/nowhere")])
    for uri in ("package://arm/" + tail + ".stl", tail):
        address = mesh_address(uri, PackageFolders())
        assert address.url is None or "/../" not in address.url
    assert isinstance(library.find("/mesh/arm/" + tail + ".stl"), (str, MeshFile))


@pytest.mark.parametrize("tool", TOOLS)
def test_tools_publish_as_rviz_does(tool):
    command = PublishWithTool(tool, [0.0, 2.0, 3.0], math.pi / 2)
    sent = message_of_tool(command, "map", (1.0, 0.0, 0.0), 1_500_000_000)
    assert sent.topic == {"point": "/clicked_point", "pose_estimate": "/initialpose"}.get(
        tool, "/goal_pose"
    )
    message = msg.deserialize(msg.get_message(sent.type_name), sent.cdr)
    assert message.header.frame_id == "map"
    assert (message.header.stamp.sec, message.header.stamp.nanosec) == (1, 500_000_000)
    if tool == "point":
        assert (message.point.x, message.point.y, message.point.z) == (1, 2, 3)
        return
    pose = message.pose.pose if tool == "pose_estimate" else message.pose
    assert (pose.position.x, pose.position.y, pose.position.z) == (1, 2, 0)
    assert (pose.orientation.z, pose.orientation.w) == pytest.approx((math.sqrt(0.5),) * 2)
    if tool == "pose_estimate":
        covariance = message.pose.covariance
        assert {k: covariance[k] for k in range(36) if covariance[k]} == pytest.approx(
            {0: 0.25, 7: 0.25, 35: 0.06853891945200942}
        )


def test_a_tool_publishes_on_a_topic_of_ones_own():
    command = PublishWithTool("goal", [0, 0, 0], topic="/mine")
    assert message_of_tool(command, "map", (0, 0, 0), 0).topic == "/mine"


@pytest.mark.parametrize(
    ("tool", "position", "yaw", "fixed", "why"),
    [
        ("x", [0, 0, 0], 0, "m", "there is no tool 'x'; choose from point, pose_estimate, goal"),
        ("goal", [0, 0], 0, "m", "a tool needs a position of three finite numbers and a finite"),
        ("goal", [0, math.nan, 0], 0, "m", "position must be a list of three finite numbers"),
        ("goal", [0, 1.7e308, 0], 0, "m", "a tool needs a position of three finite numbers"),
        ("goal", [0, 0, 0], math.inf, "m", "a tool needs a position of three finite numbers"),
        ("goal", [0, 0, 0], 0, "", "no position can be published, because there is no fixed"),
    ],
)
def test_nonsense_of_tools(tool, position, yaw, fixed, why):
    with pytest.raises(CommandError, match=why):
        message_of_tool(PublishWithTool(tool, position, yaw), fixed, (0, 1.7e308, 0), 0)


CRANE = """<robot name="crane">
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
    return RobotSource(Robot.from_xml(CRANE))


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
    source = RobotSource(Robot.from_xml(CRANE), positions)
    assert source.joints.positions()[0] == 0.5


def test_the_tree_names_the_joint_of_each_frame(source):
    for _ in range(2):
        rows = TreeTable().rows(source.buffer, 0)
        assert {row["name"]: row["publisher"] for row in rows} == {
            "boom": "joint lift", "hook": "joint rope", "flag": "joint wind",
        }  # fmt: skip
        source.joints.move({"lift": 0.3})


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
    with turtlewire.show(Robot.from_xml(CRANE), port=0) as view:
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
    with turtlewire.show(Robot.from_xml(CRANE), port=0) as view:
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
