"""A real browser whose page looks down at the displays of a test."""

from tests.pages import wait_until

from turtlewire import msg

LIMIT_MS = 120_000
#: Looks down on the square of 8 m around the origin, without frames, names and grid.
#: Only the tests add displays: a robot that the page adds itself would be a second one.
LOOK_DOWN = """async () => {
    const { robots, stage } = await import("./js/main.js");
    robots.isOn = false;
    const { Vector3 } = await import("three");
    stage.cameras.choose("top");
    stage.cameras.isTouched = true;
    stage.cameras.look(new Vector3(0, 0, 0), 4);
    stage.drawing.object.visible = stage.labels.object.visible = false;
    stage.view.grid.object.visible = false;
    stage.view.requestDraw();
}"""
#: Colours [r, g, b] of the picture at places [x, y, z] in metres.
PIXELS = """async (places) => {
    const { stage } = await import("./js/main.js");
    const { Vector3 } = await import("three");
    const bitmap = await createImageBitmap(await stage.view.picture());
    const ink = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
    ink.drawImage(bitmap, 0, 0);
    const ratio = bitmap.width / stage.view.viewport.width;
    return places.map((place) => {
        const { x, y } = stage.view.project(new Vector3(...place));
        return [...ink.getImageData(Math.round(x * ratio), Math.round(y * ratio), 1, 1).data]
            .slice(0, 3);
    });
}"""
#: Whether the colours at places are as expected, each within a tolerance.
ARE = f"""async ([expected, tolerance]) => {{
    const colors = await ({PIXELS})(expected.map(([place]) => place));
    window.seen = colors;
    return colors.every((color, k) =>
        color.every((value, c) => Math.abs(value - expected[k][1][c]) <= tolerance));
}}"""
#: Whether places are more red than anything else.
ARE_RED = f"""async (places) => {{
    window.seen = await ({PIXELS})(places);
    return window.seen.every(([r, g, b]) => r > 110 && g < 0.7 * r && b < 0.7 * r);
}}"""
ADD = """async ([kind, topic, options]) => {
    const { displays } = await import("./js/main.js");
    await displays.add({ kind, topic, options });
}"""
SET_OPTION = """async ([name, value]) => {
    const { displays } = await import("./js/main.js");
    displays.setOption(displays.list[0].id, name, value);
}"""
REMOVE_ALL = """async () => {
    const { displays } = await import("./js/main.js");
    for (const { id } of displays.list) displays.remove(id);
}"""
GROUND = (247, 249, 253)
RED, GREEN, BLUE, WHITE = (255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 255)


class Scene:
    """A page that looks down at what the displays of one test draw.

    Attributes:
        topic: What :meth:`show` offers and shows.
    """

    def __init__(self, page, source, number):
        self.page = page
        self.source = source
        self.topic = f"/shown{number}"

    def show(self, kind, message, **options):
        """Offer a message and add a display of it."""
        self.source.offer(self.topic, message)
        self.page.evaluate(ADD, [kind, self.topic, options])

    def send(self, message, suffix=""):
        self.source.offer(self.topic + suffix, message)

    def set_option(self, name, value):
        self.page.evaluate(SET_OPTION, [name, value])

    def expect(self, *expected, tolerance=12):
        """Wait until the places have the colours: pairs of (x, y, z) and (r, g, b)."""
        if not wait_until(self.page, ARE, [expected, tolerance]):
            seen = self.page.evaluate("window.seen")
            raise AssertionError(f"expected {expected}, seen {seen}: {self.status()}")

    def expect_red(self, *places):
        """Wait until the places are reddish: light makes bodies darker or paler."""
        if not wait_until(self.page, ARE_RED, places):
            seen = self.page.evaluate("window.seen")
            raise AssertionError(f"no red at {places}, but {seen}: {self.status()}")

    def expect_ground(self, *places):
        self.expect(*[(place, GROUND) for place in places])

    def wait_until(self, check):
        """Wait until an async function of the page is true."""
        assert wait_until(self.page, check), (check, self.status())

    def expect_status(self, text):
        self.page.wait_for_function(
            "(text) => document.querySelector('#display-list').textContent.includes(text)",
            arg=text,
            timeout=LIMIT_MS,
        )

    def expect_no_status(self, text):
        self.page.wait_for_function(
            "(text) => !document.querySelector('#display-list').textContent.includes(text)",
            arg=text,
            timeout=LIMIT_MS,
        )

    def status(self):
        return self.page.inner_text("#display-list")


get = msg.get_message


def stamped(type_name, frame="map", **values):
    message = get(type_name)(**values)
    message.header.frame_id = frame
    return message


def pose(x=0.0, y=0.0, z=0.0):
    result = get("geometry_msgs/msg/Pose")()
    result.position.x, result.position.y, result.position.z = float(x), float(y), float(z)
    result.orientation.w = 1.0
    return result
