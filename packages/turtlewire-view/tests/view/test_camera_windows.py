"""A camera's window in a real browser: the image, and the scene that the camera sees over it.

Windows of pictures over the scene: their places, names, and how they are moved and closed.
"""

import base64
import io

import numpy as np
import pytest
from PIL import Image
from tests.pages import wait_until

from .looking_down import ADD, LIMIT_MS, REMOVE_ALL, get, pose, stamped

BLUE, RED = (0, 0, 255), (255, 0, 0)
K = [100.0, 0.0, 80.0, 0.0, 100.0, 60.0, 0.0, 0.0, 1.0]
#: Whether the window's picture has colours [r, g, b] at places [x, y], as parts of its size.
ARE = """([expected, tolerance]) => {
    const canvas = document.querySelector(".image-window:not([hidden]) canvas");
    if (!canvas) return false;
    const ink = canvas.getContext("2d");
    window.seen = expected.map(([[x, y]]) => [...ink.getImageData(
        Math.floor(x * canvas.width), Math.floor(y * canvas.height), 1, 1).data].slice(0, 3));
    return expected.every(([, color], k) =>
        color.every((value, c) => Math.abs(value - window.seen[k][c]) <= tolerance));
}"""
MIDDLE, CORNER = (0.5, 0.5), (0.05, 0.05)


class Window:
    """A blue image whose camera looks down from 4 m, at a red square of 1 m on the ground."""

    def __init__(self, scene):
        self.scene = scene
        self.topic = f"{scene.topic}/image_raw"
        self.info_topic = f"{scene.topic}/camera_info"
        self.source = scene.source
        # x to the right, y down on the image: the camera looks along -z of the map.
        self.source.buffer.set_static_transform("map", "eye", (0, 0, 4), (1, 0, 0, 0))
        square = stamped("visualization_msgs/msg/Marker", type=1)
        square.scale.x = square.scale.y = 1.0
        square.scale.z = 0.002
        square.color.r = square.color.a = 1.0
        scene.show("marker", square)
        scene.expect_red((0, 0, 0))

    def show(self, image, info=None, **options):
        self.source.offer(self.topic, image)
        if info is not None:
            self.source.offer(self.info_topic, info)
        options = {"show_frames": False, "show_grid": False, **options}
        self.scene.page.evaluate(ADD, ["camera", self.topic, options])

    def set(self, name, value):
        script = """async ([name, value]) => {
            const { displays } = await import("./js/main.js");
            displays.setOption(displays.list.at(-1).id, name, value);
        }"""
        self.scene.page.evaluate(script, [name, value])

    def expect(self, *expected, tolerance=30):
        if not wait_until(self.scene.page, ARE, [expected, tolerance]):
            seen = self.scene.page.evaluate("window.seen")
            raise AssertionError(f"expected {expected}, seen {seen}: {self.scene.status()}")


@pytest.fixture
def window(scene):
    return Window(scene)


def blue():
    pixels = np.zeros((120, 160, 3), np.uint8)
    pixels[..., 2] = 255
    message = stamped("sensor_msgs/msg/Image", "eye", encoding="rgb8", height=120, width=160)
    message.step, message.data = 480, pixels.tobytes()
    return message


def info(**values):
    return stamped("sensor_msgs/msg/CameraInfo", width=160, height=120, k=K, **values)


def test_the_scene_is_drawn_where_the_camera_sees_it(window):
    window.show(blue(), info(), rendering="background")
    # 1 m at a distance of 4 m is 25 pixels wide: from 0.42 to 0.58 of the width.
    window.expect((MIDDLE, RED), ((0.43, 0.5), RED), ((0.57, 0.59), RED))
    window.expect(((0.41, 0.5), BLUE), ((0.59, 0.5), BLUE), ((0.5, 0.62), BLUE))
    window.set("zoom", 2)
    window.expect(((0.36, 0.5), RED), ((0.33, 0.5), BLUE), (CORNER, BLUE))
    window.set("zoom", 0.5)
    window.expect(((0.47, 0.5), RED), ((0.44, 0.5), BLUE), (CORNER, (0, 0, 0)))
    window.set("far", 3)
    window.expect((MIDDLE, BLUE))


def test_the_scene_has_the_colours_of_the_page(window):
    poses = [get("geometry_msgs/msg/PoseStamped")(pose=pose(x, 0, 0.2)) for x in (-3, 3)]
    line = stamped("nav_msgs/msg/Path", poses=poses)
    window.scene.topic += "_path"
    window.scene.show("path", line, color="#c86432", width=1)
    window.scene.expect(((1.5, 0, 0), (200, 100, 50)))
    window.show(blue(), info(), rendering="background")
    window.expect(((0.2, 0.5), (200, 100, 50)), tolerance=8)


def test_the_image_is_an_overlay_of_the_scene(window):
    window.show(blue(), info(), alpha=0.25)
    window.expect((MIDDLE, (190, 0, 64)), (CORNER, BLUE), tolerance=40)
    window.set("alpha", 1)
    window.expect((MIDDLE, BLUE))
    window.set("rendering", "background")
    window.expect((MIDDLE, RED))


def test_the_second_eye_of_a_stereo_camera_sees_the_scene_aside(window):
    p = [100.0, 0, 80, -50, 0, 100, 60, 0, 0, 0, 1, 0]  # half a metre to the right
    window.show(blue(), info(p=p), rendering="background")
    window.expect(((0.36, 0.5), RED), ((0.48, 0.5), RED), ((0.52, 0.5), BLUE))


def test_an_image_without_its_camera_is_not_shown(window):
    window.show(blue())
    window.scene.expect_status("No CameraInfo received on")
    assert window.scene.page.locator(".image-window:not([hidden])").count() == 0
    window.source.offer(window.info_topic, info())
    window.set("rendering", "background")
    window.expect((MIDDLE, RED))


def test_a_compressed_image_and_a_corrupt_one(window):
    file = io.BytesIO()
    Image.new("RGB", (160, 120), BLUE).save(file, "PNG")
    message = stamped("sensor_msgs/msg/CompressedImage", "eye", format="png", data=file.getvalue())
    window.topic += "/compressed"
    window.show(message, info(), rendering="background")
    window.expect((MIDDLE, RED), (CORNER, BLUE))
    png = base64.b64decode(base64.b64encode(file.getvalue())[:80])
    message.data = png
    window.source.send(window.topic, message)
    window.scene.expect_status("The browser cannot read this image/png")
    window.expect((MIDDLE, RED), (CORNER, BLUE))


def test_a_hidden_window_comes_back(window):
    window.show(blue(), info(), rendering="background")
    window.expect((MIDDLE, RED))
    window.scene.page.click(".image-window button")
    gone = "() => !document.querySelector('.image-window:not([hidden])')"
    window.scene.page.wait_for_function(gone, timeout=LIMIT_MS)
    window.scene.page.locator("#display-list .eye").last.click()
    window.expect((MIDDLE, RED))


def test_removed_cameras_leave_no_window(window):
    for _ in range(3):
        window.show(blue(), info(), rendering="background")
        window.expect((MIDDLE, RED))
        remove = """async () => {
            const { displays } = await import("./js/main.js");
            displays.remove(displays.list.at(-1).id);
        }"""
        window.scene.page.evaluate(remove)
    assert window.scene.page.locator(".image-window").count() == 0


#: Boxes [left, top, right, bottom] of the windows that are seen, and of the viewport.
BOXES = """() => {
    const box = (element) => {
        const { left, top, right, bottom } = element.getBoundingClientRect();
        return [left, top, right, bottom];
    };
    const seen = [...document.querySelectorAll(".image-window")].filter((each) => !each.hidden);
    return [seen.map(box), box(document.getElementById("viewport"))];
}"""
HEIGHTS = "() => [...document.querySelectorAll('.image-window')].map((e) => +e.style.zIndex)"
COUNT = "(n) => document.querySelectorAll('.image-window:not([hidden])').length === n"


def picture():
    message = stamped("sensor_msgs/msg/Image", "lens", height=6, width=8, step=24)
    message.encoding = "rgb8"
    message.data = np.full((6, 8, 3), (10, 200, 30), np.uint8).tobytes()
    return message


@pytest.fixture
def show(scene):
    """Show pictures of so many cameras, and give the page."""

    def show(count):
        topics = [f"{scene.topic}_{number}" for number in range(count)]
        for topic in topics:
            scene.source.offer(topic, picture())
            scene.page.evaluate(ADD, ["image", topic, {}])
        scene.page.wait_for_function(COUNT, arg=count, timeout=LIMIT_MS)
        return scene.page

    yield show
    scene.page.evaluate(REMOVE_ALL)


def overlap(a, b):
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def is_inside(box, around):
    return (
        box[0] >= around[0] - 1
        and box[1] >= around[1] - 1
        and box[2] <= around[2] + 1
        and box[3] <= around[3] + 1
    )


def drag(page, start, end):
    page.mouse.move(*start)
    page.mouse.down()
    page.mouse.move(*end, steps=3)
    page.mouse.up()


def test_windows_open_side_by_side(show):
    page = show(2)
    (first, second), around = page.evaluate(BOXES)
    assert not overlap(first, second)
    assert is_inside(first, around)
    assert is_inside(second, around)
    names = page.locator(".image-window b").all_inner_texts()
    assert [name[-2:] for name in names] == ["_0", "_1"]


def test_captions_stay_below_the_buttons_of_a_low_scene(show):
    page = show(1)
    page.evaluate(REMOVE_ALL)
    page.set_viewport_size({"width": 844, "height": 390})
    show(2)
    (first, second), room = page.evaluate(BOXES)
    assert not overlap(first, second)
    assert is_inside(second, room)
    drag(page, (first[0] + 20, first[1] + 8), (first[0] + 20, -500))
    caption = page.locator(".image-window figcaption").first
    box = caption.bounding_box()
    at = [box["x"] + 20, box["y"] + 4]
    found = "([x, y]) => document.elementFromPoint(x, y).closest('figcaption')?.textContent"
    assert page.evaluate(found, at) == caption.text_content()
    page.set_viewport_size({"width": 900, "height": 700})


def test_when_all_is_taken_the_next_ones_are_a_cascade(show):
    page = show(1)
    (small,), room = page.evaluate(BOXES)
    width, height = small[2] - small[0], small[3] - small[1]
    count = int((room[2] - room[0]) / width) * int((room[3] - room[1]) / height)
    page.evaluate(REMOVE_ALL)
    show(count + 3)
    boxes, room = page.evaluate(BOXES)
    assert all(is_inside(box, room) for box in boxes)
    heights = page.evaluate(HEIGHTS)
    last = sorted(range(count + 3), key=lambda k: heights[k])[-2:]  # in the order of their coming
    (left, top, *_), (second_left, second_top, *_) = (boxes[k] for k in last)
    assert (second_left - left, second_top - top) == (28, 28)
    for k in last:
        caption = page.locator(".image-window figcaption").nth(k)
        box = caption.bounding_box()
        at = [box["x"] + 20, box["y"] + box["height"] / 2]
        found = "([x, y]) => document.elementFromPoint(x, y).closest('figcaption').textContent"
        assert page.evaluate(found, at) == caption.text_content()


def test_a_window_stays_in_the_picture_however_far_it_is_dragged(show):
    page = show(1)
    (box,), around = page.evaluate(BOXES)
    for end in ((5000, -3000), (-4000, 4000)):
        (box,), around = page.evaluate(BOXES)
        drag(page, (box[0] + 20, box[1] + 8), end)
        (moved,), around = page.evaluate(BOXES)
        assert moved != box
        assert is_inside(moved, around)


def test_a_window_is_moved_with_keys(show):
    page = show(1)
    ((left, top, *_),), _ = page.evaluate(BOXES)
    page.focus(".image-window figcaption")
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowUp")
    ((now_left, now_top, *_),), _ = page.evaluate(BOXES)
    assert (now_left - left, now_top - top) == (20, -20)


def test_a_pressed_window_comes_to_the_front(show):
    page = show(2)
    (first, second), _ = page.evaluate(BOXES)
    drag(page, (second[0] + 20, second[1] + 8), (first[0] + 60, first[1] + 40))
    page.mouse.click(first[0] + 10, first[1] + 60)
    top = "([x, y]) => document.elementFromPoint(x, y).closest('.image-window').textContent"
    assert "_0" in page.evaluate(top, [first[0] + 70, first[1] + 60])


def test_a_closed_window_is_hidden_and_comes_back(show):
    page = show(1)
    page.click(".image-window button")
    page.wait_for_function(COUNT, arg=0, timeout=LIMIT_MS)
    eye = page.locator("#display-list .eye")
    assert eye.get_attribute("aria-pressed") == "true"
    eye.click()
    page.wait_for_function(COUNT, arg=1, timeout=LIMIT_MS)
