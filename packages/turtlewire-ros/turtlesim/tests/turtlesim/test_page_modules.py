"""The page's modules one by one, in the browser.

Words, the time between two frames, the camera, the drawing's memory.
"""

import itertools

import pytest


@pytest.fixture
def js(simulator, open_page):
    """Evaluates the body of an async function; it may import the page's modules."""
    page = open_page(simulator.screen.url, reduced_motion="no-preference")
    return lambda body, argument=None: page.evaluate(f"async (given) => {{ {body} }}", argument)


#: Translation, z and w of the rotation, and what is said of them.
SENTENCES = [
    (
        (2.16, 0.9, 0),
        (0, 1),
        "turtle1 is 2.16 m ahead and 0.90 m to the left of turtle2, and looks the same way",
    ),
    (
        (-1, -2, 0),
        (0.5**0.5, 0.5**0.5),
        (
            "turtle1 is 1.00 m behind and 2.00 m to the right of turtle2, and looks 90° further to "
            "the left"
        ),
    ),
    (
        (0, -2, 0),
        (-(0.5**0.5), 0.5**0.5),
        "turtle1 is 2.00 m to the right of turtle2, and looks 90° further to the right",
    ),
    ((-2, 0, 0), (0, 1), "turtle1 is 2.00 m behind turtle2, and looks the same way"),
    ((0, 0.004, 0), (0, -1), "turtle1 is where turtle2 is, and looks the same way"),
    (
        (1, 1, 0.5),
        (0, 1),
        (
            "turtle1 is 1.00 m ahead, 1.00 m to the left and 0.50 m above turtle2, and looks the "
            "same way"
        ),
    ),
    ((1, None, 0), (0, 1), "turtle1 has no finite position in turtle2"),
]


def test_transforms_in_words(js):
    said = js(
        """
        const { transformInWords } = await import('/js/words.js');
        return given.map(([translation, z_w]) => transformInWords(
            'turtle1', 'turtle2', { translation, rotation: [0, 0, ...z_w] }));
        """,
        [case[:2] for case in SENTENCES],
    )
    assert said == [text for _, _, text in SENTENCES]


PLAYBACK = """
    const { Playback } = await import('/js/frames.js');
    const playback = new Playback();
    const x = (tick) => tick * 0.032 + (tick > given.jump ? 5 : 0);
    const pose = (tick) => new Float32Array([x(tick), 1, 0, 2, 0]);
    const frame = (tick) => ({ tick, version: 0, turtleCount: 1, poses: pose(tick) });
    const seen = [];
    let sent = 0;
    for (let now = 0; now < 2000; now += given.display) {
        const due = () => 16 * given.ticks * sent + given.late[sent % given.late.length];
        while (due() <= now) playback.push(frame(given.ticks * sent++));
        const sample = playback.sample(now);
        if (sample) seen.push(sample.poses[0].x);
    }
    return seen;
"""


@pytest.mark.parametrize("ticks", [1, 2, 4])
def test_the_display_goes_smoothly_between_frames(js, ticks):
    """At any display's rate, when frames come up to 12 ms late and not for each tick.

    2 m/s are 2 mm a millisecond.
    """
    for display in (1000 / 30, 1000 / 60, 1000 / 144):
        seen = js(
            PLAYBACK, {"display": display, "late": [0, 7, 2, 12, 1], "jump": 1000, "ticks": ticks}
        )
        steps = [b - a for a, b in itertools.pairwise(seen[len(seen) // 4 :])]
        assert len(steps) > 40
        assert min(steps) >= 0.5 * 0.002 * display
        assert max(steps) <= 1.5 * 0.002 * display


def test_a_teleport_is_no_movement(js):
    seen = js(PLAYBACK, {"display": 4, "late": [0], "jump": 60, "ticks": 1})
    assert (
        max(b - a for a, b in itertools.pairwise(seen)) > 5
    )  # at once: it is seen nowhere in between
    assert not [x for x in seen if 2.2 < x < 6.5]


def test_camera_rests_on_its_turtle_within_the_field(js):
    places = js(
        """
        const { Camera } = await import('/js/camera.js');
        const camera = new Camera();
        camera.setFollow(true);
        const places = [];
        let now = 0;
        for (const [x, y] of [[250, 250], [400, 250], [499, 0]]) {
            for (const end = now + 3000; now < end; now += 16) camera.look(x, y, 500, now);
            places.push([camera.left, camera.top]);
        }
        camera.setFollow(false);
        camera.rest();
        return [...places, [camera.left, camera.top]];
        """
    )
    # the ground is 1250 pixels wide, the canvas 500
    assert places == [
        pytest.approx(place, abs=1) for place in [(375, 375), (750, 375), (750, 0), (0, 0)]
    ]


def test_the_drawing_forgets_its_oldest_half_when_it_is_full(js):
    count = js(
        """
        const { Trails } = await import('/js/trails.js');
        const trails = new Trails();
        const many = 150_000;
        const points = new Float32Array(5 * many);
        const strokes = { count: many, points, pens: new Uint32Array(5 * many) };
        for (let k = 0; k < 3; k += 1) trails.append(strokes);
        return trails.count;
        """
    )
    assert count == 150_000 + 150_000
