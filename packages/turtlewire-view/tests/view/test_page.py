"""The picture of the view's page: what is drawn where, and how one looks at it."""

from __future__ import annotations

import math

import pytest
from tests.needs import only_first_is_fast
from tests.pages import wait_until

from .fake_view import IDENTITY, pose

CHAIN = {"world": "", "base": "world", "arm": "base", "beacon": "world"}
POSES = [IDENTITY, pose(3, 0, 0), pose(3, 2, 1), pose(-1, 3, 0)]
#: Colours at points of the scene [m], after a picture was drawn.
PIXELS = """async (points) => {
    const { stage } = await import(new URL('js/main.js', location.href));
    const { Vector3 } = await import('three');
    const { view } = stage;
    view.draw(performance.now());
    const canvas = new OffscreenCanvas(view.canvas.width, view.canvas.height);
    const ctx = canvas.getContext('2d');
    ctx.drawImage(view.canvas, 0, 0);
    return points.map((point) => {
        const { x, y } = view.project(new Vector3(...point));
        return [...ctx.getImageData(Math.floor(x), Math.floor(y), 1, 1).data.slice(0, 3)];
    });
}"""
RED, GREEN, BLUE = (224, 47, 63), (20, 154, 78), (47, 91, 234)
HEAD, SHAFT, ACCENT, GROUND = (255, 26, 153), (181, 165, 42), (69, 86, 255), (247, 249, 253)


def in_page(page, body: str, argument=None):
    """Evaluate the body of an async function that knows `stage`, `frames` and `given`."""
    code = "const { stage, frames } = await import(new URL('js/main.js', location.href));"
    return page.evaluate(f"async (given) => {{ {code} {body} }}", argument)


def wait_for_frame(page, name) -> None:
    """Wait until a frame is in the tree and has its place, which another packet tells."""
    page.wait_for_selector(f"#tree .row:has-text('{name}')")
    is_known = "frames.known[frames.index(given)]"
    in_page(page, f"while (!{is_known}) await new Promise(requestAnimationFrame);", name)


def on_screen(page, point) -> tuple[float, float]:
    """Where a point of the scene is in the canvas [CSS pixels]."""
    body = """
        const { Vector3 } = await import('three');
        stage.view.draw(performance.now());
        const { x, y } = stage.view.project(new Vector3(...given));
        return [x, y];
    """
    return tuple(in_page(page, body, list(point)))


def press(page, point, **options) -> None:
    """Press a point of the scene, and let go."""
    x, y = on_screen(page, point)
    page.click("#scene", position={"x": x, "y": y}, **options)


@pytest.fixture
def told(fake):
    """Four frames: a path of two links, and one beside it."""
    fake.names(CHAIN)
    fake.frames(POSES)
    return fake


@pytest.fixture
def fresh(told, open_view):
    """The frames, seen as the page itself chose."""
    page = open_view(told.url)
    wait_for_frame(page, "beacon")
    return page


@pytest.fixture
def phone(told, open_view):
    page = open_view(told.url, has_touch=True, viewport={"width": 390, "height": 780})
    wait_for_frame(page, "arm")
    return page


@pytest.fixture
def page(fresh):
    page = fresh
    in_page(page, "stage.labels.showAll = false; stage.view.grid.object.visible = false;")
    in_page(page, "stage.setSize(0.8); stage.cameras.isTouched = true;")
    # No two axes are seen in one direction from here.
    in_page(page, "stage.view.camera.position.set(-5, -6, 7); stage.view.camera.lookAt(1, 1, 0);")
    return page


def along(k: int, axis: int, metres: float = 0.5) -> list[float]:
    point = list(POSES[k][:3])
    point[axis] += metres
    return point


def near(colors, expected, tolerance=14) -> None:
    """Each colour is the expected one: lines are opaque in their middle."""
    for color, wanted in zip(colors, expected, strict=True):
        assert max(abs(a - b) for a, b in zip(color, wanted, strict=True)) <= tolerance, (
            colors,
            expected,
        )


def test_axes_are_red_green_and_blue_along_x_y_and_z(page):
    points = [along(k, axis) for k in (1, 3) for axis in range(3)]
    near(page.evaluate(PIXELS, points), [RED, GREEN, BLUE] * 2)


def test_an_axis_turns_with_its_frame(page, fake):
    fake.frames([*POSES[:3], pose(-1, 3, 0, yaw=math.pi / 2)])
    in_page(page, "while (frames.poses[27] > 0.9) await new Promise(requestAnimationFrame);")
    points = [along(3, 1), along(3, 0, -0.5), along(3, 0, 0.5)]
    near(page.evaluate(PIXELS, points), [RED, GREEN, GROUND])


def test_arrows_go_from_child_to_parent(page):
    in_page(page, "stage.drawing.show.axes = false; stage.change();")
    shaft, head = [-0.5, 1.5, 0.0], [-0.07, 0.21, 0.0]  # of beacon's, which ends in world
    near(page.evaluate(PIXELS, [shaft, head]), [SHAFT, HEAD], tolerance=40)


def test_disabled_displays_are_not_drawn(page):
    page.click("#looks summary")
    page.uncheck("#show-axes")
    page.uncheck("#show-arrows")
    near(page.evaluate(PIXELS, [along(1, 1), [-0.5, 1.5, 0.0]]), [GROUND, GROUND])


def test_unknown_and_hidden_frames_are_not_drawn(page, fake):
    fake.frames(POSES, known=[1, 1, 1, 0])
    in_page(page, "while (frames.known[3]) await new Promise(requestAnimationFrame);")
    near(page.evaluate(PIXELS, [along(3, 0), along(1, 1)]), [GROUND, GREEN])
    page.fill("#hide", "^ba")
    near(page.evaluate(PIXELS, [along(1, 1), along(2, 2)]), [GROUND, BLUE])


def test_pressing_a_frame_highlights_its_path_to_the_fixed_frame(page, fake):
    press(page, POSES[2][:3])
    fake.wait_for(lambda c: c["type"] == "relation" and c.get("source") == "arm")
    assert page.get_attribute("#tree .row:has-text('arm')", "aria-selected") == "true"
    on_path = page.evaluate(PIXELS, [[3.0, 1.0, 0.5], [1.5, 0.0, 0.0]])
    for red, green, blue in on_path:
        assert blue - max(red, green) > 60
    beside = page.evaluate(PIXELS, [along(3, 0)])[0]
    assert beside[0] - beside[1] < RED[0] - RED[1] - 60  # dimmed
    assert in_page(page, "return stage.labels.texts")[0] == "arm"
    page.keyboard.press("Escape")
    fake.wait_for(lambda c: c["type"] == "relation" and c["target"] is None)
    near(page.evaluate(PIXELS, [along(3, 0)]), [RED])


@pytest.mark.slow
def test_shift_and_a_second_frame_asks_for_their_relation(page, fake):
    press(page, POSES[2][:3])
    press(page, POSES[3][:3], modifiers=["Shift"])
    fake.wait_for(
        lambda c: c["type"] == "relation" and (c["target"], c.get("source")) == ("beacon", "arm")
    )
    assert page.input_value("#relation-target") == "beacon"


@pytest.mark.slow
def test_an_arrow_leads_straight_from_the_frame_that_looks(page, fake):
    press(page, POSES[2][:3])
    press(page, POSES[3][:3], modifiers=["Shift"])
    fake.wait_for(lambda c: c.get("target") == "beacon")
    (red, green, blue), beside = page.evaluate(PIXELS, [[1, 2.5, 0.5], [1, 2.5, 1.5]])
    assert blue - max(red, green) > 60
    assert tuple(beside) == GROUND


def test_a_tap_selects_and_a_finger_turns(phone, fake):
    x, y = on_screen(phone, POSES[3][:3])
    box = phone.locator("#scene").bounding_box()
    phone.touchscreen.tap(box["x"] + x, box["y"] + y)
    fake.wait_for(lambda c: c["type"] == "relation" and c.get("source") == "beacon")
    action = "() => getComputedStyle(document.querySelector('#scene')).touchAction"
    assert phone.evaluate(action) == "none"


def touch(session, kind, *points):
    """A touch event with some fingers on the page."""
    fingers = [{"x": x, "y": y, "id": number} for number, (x, y) in enumerate(points)]
    session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": fingers})


def two_fingers(page, before, after, steps=6):
    """Two fingers from two places to two others, from the middle of the canvas [CSS pixels]."""
    session = page.context.new_cdp_session(page)
    box = page.locator("#scene").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    for step in range(steps + 1):
        share = step / steps
        points = [
            (x + a[0] + share * (b[0] - a[0]), y + a[1] + share * (b[1] - a[1]))
            for a, b in zip(before, after, strict=True)
        ]
        touch(session, "touchMove" if step else "touchStart", *points)
    touch(session, "touchEnd")
    session.detach()


def camera_of(page):
    return in_page(page, "return stage.cameras.saved([0, 0, 0]);")


@pytest.mark.slow
def test_two_fingers_come_nearer_and_move_the_picture(phone):
    before = camera_of(phone)
    two_fingers(phone, [(-40, 0), (40, 0)], [(-100, 0), (100, 0)])
    nearer = camera_of(phone)
    assert nearer["distance"] < 0.7 * before["distance"]
    two_fingers(phone, [(-60, 0), (60, 0)], [(-60, 80), (60, 80)])
    moved = camera_of(phone)
    assert math.dist(moved["focus"], nearer["focus"]) > 0.1 * nearer["distance"]
    assert moved["distance"] == pytest.approx(nearer["distance"], rel=0.1)


def test_a_finger_turns_the_picture(phone):
    before = camera_of(phone)
    session = phone.context.new_cdp_session(phone)
    box = phone.locator("#scene").bounding_box()
    x, y = box["x"] + 40, box["y"] + box["height"] / 2
    touch(session, "touchStart", (x, y))
    for step in range(1, 6):
        touch(session, "touchMove", (x + 20 * step, y))
    touch(session, "touchEnd")
    assert abs(camera_of(phone)["yaw"] - before["yaw"]) > 0.2


def test_fit_shows_displays_too(page, fake):
    body = """
        const three = await import("three");
        const box = new three.Mesh(new three.BoxGeometry(2, 2, 2));
        box.position.set(200, 0, 0);
        stage.view.displays.add(box);
        document.getElementById("fit").click();
        const at = stage.view.project(new three.Vector3(200, 0, 0));
        return at && at.x > 0 && at.x < stage.view.viewport.width;
    """
    assert in_page(page, body)


@pytest.mark.slow
def test_the_picture_comes_back_after_the_browser_took_it(page):
    assert tuple(page.evaluate(PIXELS, [[0, 0, 0]])[0]) != GROUND
    in_page(page, "globalThis.gl = stage.view.canvas.getContext('webgl2')"
                  ".getExtension('WEBGL_lose_context'); gl.loseContext();")  # fmt: skip
    page.wait_for_selector("#notice:text('WebGL context lost')")
    page.evaluate("gl.restoreContext()")
    page.wait_for_selector("#notice", state="hidden")
    (red, green, blue), ground = page.evaluate(PIXELS, [[1.5, 0, 0], [1, 2.5, 2.5]])
    assert min(red, green) - blue > 60  # the shaft of an arrow
    assert tuple(ground) == GROUND


NAMED_AS_A_CARD = """
const ask = WebGL2RenderingContext.prototype.getParameter;
WebGL2RenderingContext.prototype.getParameter = function (what) {
    return what === 0x9246 || what === this.RENDERER ? "A fine card" : ask.call(this, what);
};
"""


@pytest.mark.slow
@pytest.mark.parametrize(("script", "smooth"), [("", False), (NAMED_AS_A_CARD, True)])
def test_edges_are_smoothed_where_a_card_draws(told, open_view, script, smooth):
    page = open_view(told.url, script)
    wait_for_frame(page, "beacon")
    attributes = "stage.view.canvas.getContext('webgl2').getContextAttributes().antialias"
    assert in_page(page, f"return {attributes};") is smooth
    assert in_page(page, "return stage.view.canvas === document.querySelector('#scene');")
    assert tuple(page.evaluate(PIXELS, [[1.5, 0, 0]])[0]) != GROUND


def test_without_webgl_the_tree_works(told, open_view):
    blind = "HTMLCanvasElement.prototype.getContext = () => null;"
    page = open_view(told.url, blind)
    page.wait_for_selector("#notice:text('cannot draw in 3D')")
    page.click("#tree .row:has-text('arm')")
    told.wait_for(lambda c: c["type"] == "relation" and c.get("source") == "arm")


@pytest.mark.slow
def test_a_saved_camera_is_looked_through_again(fresh, fake):
    camera = {"kind": "orbit", "frame": "", "focus": [1.0, 2.0, 0.5]}
    angles = {"distance": 7.0, "yaw": 0.4, "pitch": 0.6, "scale": None}
    view = {"type": "view", "fixed": "", "displays": [], "show": {}, "text": ""}
    fake.tell({**view, "camera": camera | angles})
    touched = "async () => (await import('./js/main.js')).stage.cameras.isTouched"
    assert wait_until(fresh, touched)
    saved = camera_of(fresh)
    assert saved["focus"] == pytest.approx(camera["focus"])
    assert [saved[word] for word in angles] == [*map(pytest.approx, [7.0, 0.4, 0.6]), None]
    fake.tell({**view, "camera": camera | angles | {"kind": "top", "scale": 40.0}})
    fresh.wait_for_selector("#top[aria-pressed=true]")
    assert camera_of(fresh)["scale"] == pytest.approx(40.0)
    with fresh.expect_download():
        fresh.click("#looks summary")
        fresh.click("#save-view")
        sent = fake.wait_for(lambda c: c["type"] == "save")
        fake.tell({"type": "saved", "text": "a: 1"})
    assert sent["camera"]["kind"] == "top"


def test_dragging_selects_nothing(page, fake):
    before = on_screen(page, POSES[2][:3])
    page.mouse.move(before[0] + 30, before[1] + 120)
    x, y = on_screen(page, POSES[3][:3])
    box = page.locator("#scene").bounding_box()
    page.mouse.move(box["x"] + x, box["y"] + y)
    page.mouse.down()
    page.mouse.move(box["x"] + x + 90, box["y"] + y + 10, steps=4)
    page.mouse.up()
    assert on_screen(page, POSES[2][:3]) != before  # it turned
    assert not [c for c in fake.commands if c["type"] == "relation" and c["target"]]


def test_from_above_x_goes_right_and_y_up(page):
    page.click("#top")
    (x0, y0), (x1, y1), (x2, y2) = (
        on_screen(page, point) for point in ((0, 0, 0), (1, 0, 0), (0, 1, 5))
    )
    assert x1 - x0 > 20
    assert y1 == pytest.approx(y0, abs=0.01)
    assert y0 - y2 == pytest.approx(x1 - x0)
    assert x2 == pytest.approx(x0, abs=0.01)
    page.keyboard.press("o")
    assert page.get_attribute("#orbit", "aria-pressed") == "true"


def test_a_pressed_button_is_as_clear_below_the_mouse(page):
    color = "getComputedStyle(document.getElementById('top')).backgroundColor"
    page.click("#top")
    below = page.evaluate(color)
    page.mouse.move(0, 0)
    assert page.evaluate(color) == below


@pytest.mark.parametrize("camera", only_first_is_fast("orbit", "top"))
def test_a_followed_frame_stays_where_it_is(page, fake, camera):
    page.click(f"#{camera}")
    page.click("#tree .row:has-text('arm')")
    page.click("#follow")
    fake.frames(POSES)
    fake.frames([*POSES[:2], pose(9, 4, 1), POSES[3]])
    in_page(page, "while (frames.poses[14] < 8) await new Promise(requestAnimationFrame);")
    middle = in_page(page, "return [stage.view.viewport.width / 2, stage.view.viewport.height / 2]")
    assert on_screen(page, (9, 4, 1)) == pytest.approx(middle, abs=1)
    assert "following arm" in page.inner_text("#caption")


def test_everything_is_seen_at_first_and_after_fit(page, fake):
    far = [IDENTITY, pose(300, 0), pose(-200, 100, 40), pose(0, -250)]
    fake.frames(far)
    in_page(page, "while (frames.poses[7] < 8) await new Promise(requestAnimationFrame);")
    page.click("#fit")
    size = in_page(page, "return [stage.view.viewport.width, stage.view.viewport.height]")
    for each in far:
        place = on_screen(page, each[:3])
        assert all(0 < value < limit for value, limit in zip(place, size, strict=True))
    assert page.inner_text("#caption").startswith("grid 50 m")


def test_keys_turn_and_approach_the_picture(page):
    before = on_screen(page, POSES[2][:3])
    page.focus("#scene")
    page.keyboard.press("ArrowLeft")
    turned = on_screen(page, POSES[2][:3])
    assert turned != pytest.approx(before, abs=1)
    distance = "return stage.cameras.pixelsPerMetre"
    far = in_page(page, distance)
    page.keyboard.press("+")
    assert in_page(page, distance) > far


@pytest.mark.slow
def test_trees_that_are_not_connected_stand_apart_and_are_named(fake, open_view):
    fake.names({"world": "", "base": "world", "map": "", "odom": "map"})
    fake.frames([IDENTITY, pose(2, 0), IDENTITY, pose(1, 1)])
    page = open_view(fake.url)
    wait_for_frame(page, "odom")
    places = in_page(page, "return frames.names.map((_, k) => frames.position(k))")
    assert places[:2] == [[0, 0, 0], [2, 0, 0]]
    assert places[2][0] > 3
    assert [b - a for a, b in zip(places[2], places[3], strict=True)] == [1, 1, 0]
    in_page(page, "stage.view.draw(performance.now())")
    assert {"world", "map"} <= set(in_page(page, "return stage.labels.texts"))
    assert "not connected" in page.inner_text("#tree .row:has-text('map')")
    # They keep their place while they move within it.
    fake.frames([IDENTITY, pose(2.1, 0), IDENTITY, pose(1.1, 1)])
    in_page(page, "while (frames.poses[7] < 2.05) await new Promise(requestAnimationFrame);")
    assert in_page(page, "return frames.position(2)") == places[2]


def test_frames_fade_as_in_rviz(page):
    fading = in_page(
        page,
        """
        const { AgeClock } = await import(new URL('js/frames.js', location.href));
        let now = 100;
        const ages = new AgeClock(() => now);
        ages.rename(['moving', 'static']);
        const known = Uint8Array.of(1, 1);
        ages.take(Float64Array.of(7, 0), known);
        const seen = [];
        const look = (seconds) => {
            now += seconds;
            ages.tick();
            const { grey, alpha } = ages.fading(0);
            seen.push([grey, alpha, ages.isAlive(0), ages.fading(1).alpha, ages.isAlive(1)]);
        };
        for (const seconds of [4, 3.5, 5, 3]) look(seconds);
        ages.take(Float64Array.of(8, 0), known);
        look(0);
        ages.setPaused(true);
        look(50);
        ages.setPaused(false);
        look(7.5);
        return seen;
        """,
    )
    assert fading == [
        [0, 1, True, 1, True],
        [0.5, 1, True, 1, True],
        [1, 0.5, True, 1, True],
        [1, 0, False, 1, True],
        [0, 1, True, 1, True],
        [0, 1, True, 1, True],
        [0.5, 1, True, 1, True],
    ]


@pytest.mark.slow
def test_old_frames_are_grey_and_then_gone(page, fake):
    fake.frames(POSES, stamps=[0, 5, 5, 0])
    in_page(page, "while (!frames.stamps[1]) await new Promise(requestAnimationFrame);")
    later = """
        const { AgeClock } = await import(new URL('js/frames.js', location.href));
        const [{ stamps, known, names }, start] = [frames, performance.now() / 1000];
        let now = 0;
        frames.ages = new AgeClock(() => now);
        frames.ages.rename(names);
        frames.ages.take(stamps, known);
        now = given;
        stage.change();
    """
    in_page(page, later, 10)
    near(page.evaluate(PIXELS, [along(1, 1), along(3, 1)]), [(179, 179, 179), GREEN])
    in_page(page, later, 20)
    near(page.evaluate(PIXELS, [along(1, 1), along(3, 1)]), [GROUND, GREEN])


@pytest.mark.slow
def test_a_trail_stays_where_a_frame_was(page, fake):
    page.click("#tree .row:has-text('beacon')")
    page.click("#trail")
    for step in range(6):
        fake.frames([*POSES[:3], pose(-1, 3 + 0.5 * step)])
    in_page(page, "while (frames.poses[22] < 5.4) await new Promise(requestAnimationFrame);")
    page.keyboard.press("Escape")
    in_page(page, "stage.drawing.show.axes = stage.drawing.show.arrows = false; stage.change();")
    on, beside = page.evaluate(PIXELS, [[-1, 4.25, 0], [-1.5, 4.25, 0]])
    assert max(abs(a - b) for a, b in zip(on, GROUND, strict=True)) > 60
    assert tuple(beside) == GROUND


@pytest.mark.slow
def test_a_trail_outlives_other_names_but_not_another_fixed_frame(page, fake):
    page.click("#tree .row:has-text('beacon')")
    page.click("#trail")
    count = "return stage.trails.lengthOf('beacon')"
    for step in range(3):
        fake.frames([*POSES[:3], pose(-1, 3 + step)])
    in_page(page, "while (frames.poses[22] < 4.5) await new Promise(requestAnimationFrame);")
    before = in_page(page, count)
    fake.names({**CHAIN, "late": "world"})
    page.wait_for_selector("#tree .row:has-text('late')")
    assert in_page(page, count) == before > 0
    fake.names({**CHAIN, "late": "world"}, fixed="base")
    in_page(page, "while (frames.fixed !== 'base') await new Promise(requestAnimationFrame);")
    assert in_page(page, count) == 0


def test_nothing_is_drawn_while_nothing_changes(page):
    drawn = in_page(
        page,
        """
        const pause = (n) => new Promise((done) => {
            const next = () => (n-- ? requestAnimationFrame(next) : done());
            next();
        });
        let count = 0;
        await new Promise((done) => setTimeout(done, 700));
        stage.view.afterDraw(() => { count += 1; });
        await pause(30);
        const idle = count;
        stage.change();
        await pause(3);
        return [idle, count];
        """,
    )
    assert drawn == [0, 1]


@pytest.mark.slow
def test_at_most_fifty_names_and_always_the_selected_one(fake, open_view):
    names = {f"link{k}": f"link{k - 1}" if k else "" for k in range(1000)}
    fake.names(names)
    fake.frames([pose(0.4 * (k % 32), 0.4 * (k // 32)) for k in range(1000)])
    page = open_view(fake.url)
    wait_for_frame(page, "link5")
    page.fill("#search", "link777")
    page.click("#tree .row:has-text('link777')")
    in_page(page, "stage.view.draw(performance.now())")
    texts = in_page(page, "return stage.labels.texts")
    assert texts[0] == "link777"
    assert 5 < len(texts) <= 50
    page.click("#looks summary")
    page.uncheck("#show-names")
    in_page(page, "stage.view.draw(performance.now())")
    assert in_page(page, "return stage.labels.texts[0]") == "link777"
