"""The URDF tutorials, as typed: packages of data built by colcon, launched, and moved by hand."""

from __future__ import annotations

import re
import signal
import xml.etree.ElementTree as ET

import pytest

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
DISPLAY = "ros2 launch urdf_tutorial display.launch.py"


def end(launch) -> None:
    launch.signal_group(signal.SIGINT)
    assert launch.wait() == 0
    assert "Traceback" not in launch.text
    assert launch.survivors() == []


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
    launch.wait_for("turtlewire has no 3D view yet")
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
    slider.wait_for(timeout=60_000)
    slider.fill("7500")  # three quarters of the way from -1 to 1 rad
    echo.wait_for(re.escape("- Rotation: in RPY (degree) [0.000, 28.648, 0.000]"))
    page.close()
    echo.kill()
    end(launch)
