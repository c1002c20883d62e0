"""Each display's picture in light, and below it in dark, as somebody found it good.

Pictures are compared by the mean colours of blocks. To renew those in ``tests/golden/displays``
after a wanted change, and then look at them, set ``TURTLEWIRE_RENEW_PICTURES=1`` for this module.
"""

import base64
import math
import os
from copy import deepcopy

import numpy as np
import pytest
from tests.pages import wait_until

from tests import places
from turtlewire_view import Viewer

from .looking_down import ADD, REMOVE_ALL, get, pose, stamped
from .still_source import StillSource
from .test_display_pictures import MARKERS, cloud, grid

GOLDEN = places.GOLDEN / "displays"
RENEWS = os.environ.get("TURTLEWIRE_RENEW_PICTURES", "0") != "0"
SCHEMES = ("light", "dark")
#: Greatest difference of a block's mean colour, of 255.
TOLERANCE = 10
SIDE = 8  # of a block, in pixels
#: Looks at a picture that has not changed until it counts as final.
SETTLED = 50
SET_UP = """async () => {
    const { stage } = await import("./js/main.js");
    const { Vector3 } = await import("three");
    const { style } = document.getElementById("viewport");
    Object.assign(style, { position: "fixed", left: 0, top: 0, width: "320px", height: "240px" });
    await new Promise((done) => {
        const look = () => (stage.view.viewport.height === 240 ? done() : setTimeout(look, 10));
        look();
    });
    stage.cameras.isTouched = true;
    stage.cameras.look(new Vector3(0, 0, 0), 2.6);
    for (const what of ["names", "axes", "arrows", "grid"]) {
        document.getElementById(`show-${what}`).click();
    }
}"""
#: The picture as it is now, with windows of images in a corner.
TAKE = """
    const take = async () => {
        const { stage } = await import("./js/main.js");
        const canvas = new OffscreenCanvas(320, 240);
        const ink = canvas.getContext("2d", { willReadFrequently: true });
        stage.view.draw(performance.now());
        ink.drawImage(stage.view.canvas, 0, 0); // in the task that drew it
        const image = document.querySelector(".image-window canvas");
        ink.imageSmoothingEnabled = false;
        if (image?.width) ink.drawImage(image, 8, 8, 160, 120);
        return canvas;
    };
    const decode = async ({ text, scheme }) => {
        const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
        const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
        const canvas = new OffscreenCanvas(320, 240);
        const top = scheme === "dark" ? -240 : 0;
        canvas.getContext("2d", { willReadFrequently: true }).drawImage(bitmap, 0, top);
        return canvas;
    };
    const blocks = (canvas) => {
        const { data } = canvas.getContext("2d").getImageData(0, 0, 320, 240);
        const sums = new Float64Array(3 * (320 / SIDE) * (240 / SIDE));
        for (let k = 0; k < data.length; k += 4) {
            const [x, y] = [(k / 4) % 320, Math.floor(k / 4 / 320)];
            const at = 3 * (Math.floor(y / SIDE) * (320 / SIDE) + Math.floor(x / SIDE));
            for (let c = 0; c < 3; c += 1) sums[at + c] += data[k + c] / SIDE ** 2;
        }
        return sums;
    };
    const difference = (left, right) => {
        return left.reduce((most, each, k) => Math.max(most, Math.abs(each - right[k])), 0);
    };
    const encode = async (canvas) => {
        const blob = await canvas.convertToBlob({ type: "image/png" });
        const bytes = new Uint8Array(await blob.arrayBuffer());
        return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""));
    };
""".replace("SIDE", str(SIDE))
#: True when the picture is like the golden one; null when it is not and stays as it is although
#: the display has got its content or cannot get it, and the scheme is the wanted one.
IS_LIKE = f"""async ([golden, tolerance, scheme]) => {{
    {TAKE}
    const {{ stage, displays }} = await import("./js/main.js");
    const decoded = `${{scheme}} ${{golden}}`;
    if (window.decoded !== decoded) {{
        window.golden = blocks(await decode({{ text: golden, scheme }}));
        Object.assign(window, {{ decoded, same: 0, former: null }});
    }}
    const now = blocks(await take());
    window.difference = difference(now, window.golden);
    if (window.difference <= tolerance) return true;
    const isComplete = displays.list.every(({{ partNames, level }}) =>
        partNames?.size || level === "error") && stage.view.colors.dark === (scheme === "dark");
    const isSame = isComplete && window.former && !difference(now, window.former);
    Object.assign(window, {{ former: now, same: isSame ? window.same + 1 : 0 }});
    return window.same < {SETTLED} ? false : null;
}}"""
PICTURE = f"async () => {{ {TAKE} return encode(await take()); }}"
#: Both schemes, one above the other.
STACKED = f"""async (pictures) => {{
    {TAKE}
    const both = new OffscreenCanvas(320, 480);
    const ink = both.getContext("2d");
    for (const [k, text] of pictures.entries()) ink.drawImage(await decode({{ text }}), 0, 240 * k);
    return encode(both);
}}"""
#: How different a golden picture is from one without the display, one that is shifted by a block's
#: side, and one with other colours.
CHANGES = f"""async ([golden, scheme, empty]) => {{
    {TAKE}
    const shown = await decode({{ text: golden, scheme }});
    const right = blocks(shown);
    const changed = (draw) => {{
        const canvas = new OffscreenCanvas(320, 240);
        draw(canvas.getContext("2d", {{ willReadFrequently: true }}));
        return difference(right, blocks(canvas));
    }};
    return {{
        nothing: difference(right, blocks(await decode({{ text: empty }}))),
        shifted: changed((ink) => {{
            ink.drawImage(shown, 0, 0);
            ink.drawImage(shown, {SIDE}, 0);
        }}),
        colored: changed((ink) => {{
            ink.filter = "hue-rotate(90deg) brightness(0.8)";
            ink.drawImage(shown, 0, 0);
        }}),
    }};
}}"""


def poses(count):
    """Poses along an arc, each turned further."""
    result = []
    for k in range(count):
        angle = k / (count - 1) * math.pi
        each = pose(2 * math.cos(angle), 2 * math.sin(angle) - 1, 0.3 * k)
        each.orientation.z, each.orientation.w = math.sin(angle / 2), math.cos(angle / 2)
        result.append(each)
    return result


def path():
    PoseStamped = get("geometry_msgs/msg/PoseStamped")  # noqa: N806
    return stamped("nav_msgs/msg/Path", poses=[PoseStamped(pose=each) for each in poses(6)])


def wave():
    places = [(x / 4, y / 4, math.sin(x / 3)) for x in range(-10, 11) for y in range(-10, 11)]
    return cloud(places, [(20 * (10 + k % 11), 90, 200) for k in range(len(places))])


def scan():
    count = 90
    return stamped(
        "sensor_msgs/msg/LaserScan", angle_min=-math.pi, angle_max=math.pi, range_max=9.0,
        angle_increment=2 * math.pi / count, ranges=[1.5 + math.cos(k / 7) for k in range(count)],
        intensities=[float(k) for k in range(count)],
    )  # fmt: skip


def markers():
    """One of each type, but text, whose letters are the computer's."""
    shown = []
    names = [name for name in MARKERS if name != "text"]
    for k, name in enumerate(names):
        message = MARKERS[name][0]
        copy = deepcopy(message)
        copy.header = stamped("visualization_msgs/msg/Marker").header
        copy.id = k
        copy.pose = pose(1.6 * (k % 4) - 2.4, 1.8 * (k // 4) - 1.8)
        copy.color = get("std_msgs/msg/ColorRGBA")(r=k % 3 / 2, g=k / 12, b=1 - k / 12, a=1.0)
        shown.append(copy)
    return get("visualization_msgs/msg/MarkerArray")(markers=shown)


def covariance():
    message = stamped("geometry_msgs/msg/PoseWithCovarianceStamped")
    message.pose.pose = poses(3)[1]
    for k, value in zip((0, 7, 14, 35), (1.0, 0.3, 0.1, 0.2), strict=True):
        message.pose.covariance[k] = value
    return message


def odometry():
    message = stamped("nav_msgs/msg/Odometry")
    message.pose.pose = poses(3)[2]
    return message


def polygon():
    Point32 = get("geometry_msgs/msg/Point32")  # noqa: N806
    message = stamped("geometry_msgs/msg/PolygonStamped")
    corners = [(2 * math.cos(k), 2 * math.sin(k)) for k in range(5)]
    message.polygon.points = [Point32(x=x, y=y) for x, y in corners]
    return message


def point():
    message = stamped("geometry_msgs/msg/PointStamped")
    message.point.x, message.point.z = 0.5, 0.5
    return message


def picture():
    rows, columns = np.mgrid[0:12, 0:16]
    pixels = np.stack([15 * columns, 20 * rows, 0 * rows + 80], axis=2).astype(np.uint8)
    message = stamped("sensor_msgs/msg/Image", height=12, width=16, step=48, encoding="rgb8")
    message.data = pixels.tobytes()
    return message


ROBOT = """<robot name="r">
  <material name="blue"><color rgba="0.1 0.3 0.9 1"/></material>
  <link name="map">
    <visual><geometry><box size="2 1 0.4"/></geometry><material name="blue"/></visual>
    <collision><origin xyz="-1.5 0 0.2"/><geometry><box size="2.4 1.4 0.6"/></geometry>
    </collision></link>
  <link name="base"><visual><origin xyz="0 0 0.7"/><geometry><cylinder radius="0.3" length="1"/>
    </geometry></visual></link>
  <link name="tip"><visual><origin xyz="0 0.4 1"/><geometry><sphere radius="0.4"/></geometry>
    <material name="green"><color rgba="0.1 0.8 0.2 1"/></material></visual></link>
  <joint name="a" type="fixed"><parent link="map"/><child link="base"/></joint>
  <joint name="b" type="fixed"><parent link="base"/><child link="tip"/></joint>
</robot>"""

#: Kind, message and options by name; all in the frame `map`, or the robot's.
SCENES = {
    "path": ("path", path(), {"width": 0.15, "pose_style": "axes"}),
    "point_cloud": ("point_cloud", wave(), {"size": 5}),
    "point_cloud_boxes": (
        "point_cloud", wave(), {"style": "boxes", "size_metres": 0.2, "color": "axis"}
    ),
    "laser_scan": ("laser_scan", scan(), {"style": "spheres", "size_metres": 0.3}),
    "occupancy_grid": ("occupancy_grid", grid([0, 100, -1, 50]), {"alpha": 1}),
    "marker": ("marker", markers(), {}),
    "pose": ("pose", covariance(), {"length": 2}),
    "odometry": ("odometry", odometry(), {"shape": "axes", "length": 2}),
    "pose_array": (
        "pose_array", stamped("geometry_msgs/msg/PoseArray", poses=poses(9)), {"length": 1.5}
    ),
    "polygon": ("polygon", polygon(), {"color": "#c02020"}),
    "point": ("point", point(), {"radius": 1}),
    "range": (
        "range",
        stamped("sensor_msgs/msg/Range", range=3.0, max_range=5.0, field_of_view=0.8),
        {"color": "#d0a020"},
    ),
    "image": ("image", picture(), {}),
    "robot_model": (
        "robot_model", get("std_msgs/msg/String")(data=ROBOT), {"collision": True}
    ),
}  # fmt: skip


@pytest.fixture(scope="module")
def small_page(browser_3d):
    """One page for all pictures, and what it looks like without displays."""
    source = StillSource()
    viewer = Viewer(source, "map", port=0)
    context = browser_3d.new_context(viewport={"width": 800, "height": 600})
    page = context.new_page()
    page.goto(viewer.url)
    page.wait_for_selector("#connection[data-state=live]")
    page.evaluate(SET_UP)
    empty = {}
    for scheme in SCHEMES:
        page.emulate_media(color_scheme=scheme)
        empty[scheme] = page.evaluate(PICTURE)
    yield page, source, empty
    context.close()
    viewer.close()


def golden(name):
    return base64.b64encode((GOLDEN / f"{name}.png").read_bytes()).decode()


def renew(page, name):
    """Save the picture as it is now in both schemes."""
    pictures = []
    for scheme in SCHEMES:
        page.emulate_media(color_scheme=scheme)
        page.wait_for_timeout(3000)
        pictures.append(page.evaluate(PICTURE))
    GOLDEN.mkdir(exist_ok=True)
    (GOLDEN / f"{name}.png").write_bytes(base64.b64decode(page.evaluate(STACKED, pictures)))


def show(small_page, name):
    page, source, _ = small_page
    kind, message, options = SCENES[name]
    topic = f"/{name}"
    source.offer(topic, message)
    page.evaluate(ADD, [kind, topic, options])


@pytest.mark.parametrize("name", SCENES)
def test_picture(small_page, name, tmp_path):
    page, _, _ = small_page
    show(small_page, name)
    try:
        if RENEWS:
            renew(page, name)
        for scheme in SCHEMES:
            page.emulate_media(color_scheme=scheme)
            if not wait_until(page, IS_LIKE, [golden(name), TOLERANCE, scheme]):
                seen = tmp_path / f"{name}_{scheme}.png"
                seen.write_bytes(base64.b64decode(page.evaluate(PICTURE)))
                difference = page.evaluate("window.difference")
                pytest.fail(f"a block differs by {difference:.0f}: {seen} is not in {GOLDEN}")
    finally:
        page.evaluate(REMOVE_ALL)


def test_a_wrong_picture_is_soon_final(small_page):
    page, _, _ = small_page
    page.emulate_media(color_scheme="light")
    show(small_page, "point")
    try:
        ends = f"async (arg) => (await ({IS_LIKE})(arg)) === null"
        assert wait_until(page, ends, [golden("polygon"), TOLERANCE, "light"])
    finally:
        page.evaluate(REMOVE_ALL)


@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("name", SCENES)
def test_the_comparison_notices(small_page, name, scheme):
    page, _, empty = small_page
    changes = page.evaluate(CHANGES, [golden(name), scheme, empty[scheme]])
    assert min(changes.values()) > 2 * TOLERANCE, changes


def test_the_pictures_are_small():
    assert sum(file.stat().st_size for file in GOLDEN.iterdir()) < 600_000
    assert {file.stem for file in GOLDEN.iterdir()} == {*SCENES}
