"""The URDF tutorials, as typed: packages of data built by colcon, launched, and moved by hand."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET

import pytest
from tests.pages import wait_until

pytestmark = pytest.mark.slow

HEADLESS = {"TURTLEWIRE_PORT": "0", "TURTLEWIRE_BROWSER": "0"}
MODELS = {
    "01-myfirst.urdf": 1,
    "02-multipleshapes.urdf": 2,
    "03-origins.urdf": 2,
    "04-materials.urdf": 3,
    "05-visual.urdf": 12,
    "06-flexible.urdf": 12,
    "07-physics.urdf": 12,
    "08-macroed.urdf.xacro": 8,
}
#: Whether much of the picture is of the tutorial's orange, lit.
ORANGE_IS_SEEN = """async () => {
    const { stage } = await import("./js/main.js");
    const bitmap = await createImageBitmap(await stage.view.picture());
    const ink = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
    ink.drawImage(bitmap, 0, 0);
    const { data } = ink.getImageData(0, 0, bitmap.width, bitmap.height);
    let count = 0;
    for (let k = 0; k < data.length; k += 4) {
        const [r, g, b] = data.subarray(k, k + 3);
        if (r > 90 && g < 0.8 * r && g > 0.4 * r && b < 0.3 * r) count += 1;
    }
    return count > 1000;
}"""
DISPLAY = "ros2 launch urdf_tutorial display.launch.py"


def end(launch) -> None:
    launch.end()


def test_the_workspace_is_known(workspace, sourced, run):
    where = run(*sourced("ros2 pkg prefix --share urdf_tutorial"))
    assert where.wait() == 0
    share = workspace / "install" / "urdf_tutorial" / "share" / "urdf_tutorial"
    assert where.text == str(share)
    assert sorted(path.name for path in (share / "urdf").iterdir()) == sorted(MODELS)
    assert (share / "package.xml").is_file()


@pytest.mark.parametrize("model", MODELS)
def test_every_model_is_displayed(model, sourced, run):
    launch = run(*sourced(f"{DISPLAY} gui:=false model:=urdf/{model}"), environment=HEADLESS)
    launch.wait_for(r"\[robot_state_publisher\]: Robot initialized")
    echo = run(
        *sourced("ros2 topic echo --once --full-length --field data /robot_description"),
        environment=HEADLESS,
    )
    assert echo.wait() == 0
    robot = ET.fromstring(echo.text.replace("\n---", "").strip())
    assert len(robot.findall("link")) == MODELS[model]
    launch.wait_for(r"\[rviz2\]: The view is at http://")
    end(launch)


def test_the_robot_is_seen(sourced, run, browser_3d):
    """The page of the launched rviz2 shows what its .rviz file names, with meshes and colours."""
    words = f"{DISPLAY} gui:=false model:=urdf/05-visual.urdf"
    launch = run(*sourced(words), environment=HEADLESS)
    address = launch.wait_for(r"The view is at (http://\S+)")[0][1]
    page = browser_3d.new_page(color_scheme="light")
    failures = []
    page.on("requestfailed", lambda request: failures.append(request.url))
    page.on(
        "response", lambda answer: failures.append(answer.url) if answer.status >= 400 else None
    )
    page.goto(address)
    assert wait_until(page, ORANGE_IS_SEEN)
    assert page.input_value("#fixed") == "base_link"
    assert page.inner_text("#display-list .title b") == "/robot_description"
    assert failures == []
    page.close()
    end(launch)


def test_xacro_finds_the_packages_of_the_workspace(sourced, workspace, run):
    share = workspace / "install" / "urdf_tutorial" / "share" / "urdf_tutorial"
    model = share / "urdf" / "08-macroed.urdf.xacro"
    expanded = run(*sourced(f"ros2 run xacro xacro {model} reach:=0.25"))
    assert expanded.wait() == 0
    assert f'<mesh filename="file://{share}/meshes/jaw.stl"/>' in expanded.text
    assert '<origin xyz="-0.25 0 -0.1"/>' in expanded.text


def test_a_slider_moved_in_the_browser_moves_the_transform(browser, sourced, run):
    """The whole way: xacro file, launch, page, joint states, transforms, `tf2_echo`."""
    launch = run(*sourced(f"{DISPLAY} model:=urdf/08-macroed.urdf.xacro"), environment=HEADLESS)
    (found,) = launch.wait_for(r"The joints' sliders are at (http://127\.0\.0\.1:\d+/)")
    echo = run(*sourced("ros2 run tf2_ros tf2_echo base_link lamp"), environment=HEADLESS)
    echo.wait_for(re.escape("- Rotation: in RPY (degree) [0.000, -0.000, 0.000]"))
    page = browser.new_page()
    page.goto(found[1])
    slider = page.locator('.joint[data-name="lamp_tilt"] input[type=range]')
    slider.wait_for(timeout=120_000)
    slider.fill("7500")  # three quarters of the way from -1 to 1 rad
    echo.wait_for(re.escape("- Rotation: in RPY (degree) [0.000, 28.648, 0.000]"))
    page.get_by_role("button", name="Center").click()
    launch.wait_for(r"\[joint_state_publisher\]: Centering$")
    page.wait_for_function(
        "() => document.querySelector('.joint[data-name=lamp_tilt] .value input').value === '0.000'"
    )
    page.close()
    echo.kill()
    end(launch)


def test_using_urdf_with_robot_state_publisher(sourced, run):
    launch = run(*sourced("ros2 launch urdf_tutorial_r2d2 demo_launch.py"), environment=HEADLESS)
    launch.wait_for(r"\[state_publisher\]: state_publisher started")
    launch.wait_for(r"The root link axis has an inertia specified in the URDF, but KDL")
    echo = run(*sourced("ros2 run tf2_ros tf2_echo odom periscope"), environment=HEADLESS)
    places = echo.wait_for(r"^- Translation: \[(\S+), (\S+), (\S+)\]", count=2)
    assert len({place.groups() for place in places}) == 2  # it moves
    echo.kill()
    launch.end()


YAML = """
launch:
- arg: {name: model}
- node:
    pkg: robot_state_publisher
    exec: robot_state_publisher
    param:
    - {name: robot_description, value: "$(command 'xacro $(var model)')", type: str}
"""
XML = """
<launch>
  <arg name="model"/>
  <node pkg="robot_state_publisher" exec="robot_state_publisher">
    <param name="robot_description" value="$(command 'xacro $(var model)')" type="str"/>
  </node>
</launch>
"""


@pytest.mark.parametrize(("name", "content"), [("a.launch.yaml", YAML), ("a.launch.xml", XML)])
def test_a_command_in_yaml_and_xml(name, content, workspace, ros2_launch):
    model = workspace / "src" / "urdf_tutorial" / "urdf" / "06-flexible.urdf"
    launch = ros2_launch(content, f"model:={model}", name=name)
    launch.wait_for(r"\[robot_state_publisher\]: Robot initialized")
    end(launch)


def test_a_model_that_is_not_there_is_one_error(sourced, run):
    launch = run(*sourced(f"{DISPLAY} model:=urdf/99.urdf"), environment=HEADLESS)
    assert launch.wait() == 1
    launch.wait_for("executed command failed.*99.urdf")
    assert launch.survivors() == []
