"""turtlesim's page for people who see badly, or use a keyboard or a screen reader."""

from __future__ import annotations

import pytest
from tests.pages import (
    COLORS,
    UNREAD_NAMES,
    root_size_with,
    small_texts,
    weak_borders,
    weak_rings,
    weak_texts,
)

from turtlesim import page_commands

from .seen import publish_transform, wait_until
from .test_page_settings import set_colour

pytestmark = pytest.mark.slow

SIZES = {"desktop": (1280, 800), "phone": (390, 844), "small": (320, 640), "landscape": (844, 390)}
BACKGROUNDS = ["#4556ff", "#ffffff", "#000000", "#777777", "#8a8a8a", "#f2e24a", "#b03030"]
#: Contrast of the brightest and the darkest pixel around the 5 at the left edge of the field.
CONTRAST_OF_DIGIT = f"""() => {{
    {COLORS}
    const canvas = document.getElementById("ground");
    const size = canvas.width;
    const font = Math.max(12 * devicePixelRatio, size / 62);
    const y = size - (5 * 45 + 0.5) * (size / 500);
    const box = [0, y - 0.6 * font, 1.2 * font, 1.2 * font].map(Math.round);
    const {{ data }} = canvas.getContext("2d").getImageData(...box);
    const pixels = Array.from({{ length: data.length / 4 }}, (_, k) => {{
        return [...data.slice(4 * k, 4 * k + 3)];
    }}).sort((a, b) => luminance(a) - luminance(b));
    return contrast(pixels[0], pixels.at(-1));
}}"""
#: Contrast between the two rings around what has the focus.
CONTRAST_OF_RINGS = f"""() => {{
    {COLORS}
    const {{ outlineColor, boxShadow }} = getComputedStyle(document.activeElement);
    if (boxShadow === "none") return 1;
    return contrast(parse(outlineColor), parse(boxShadow.match(/rgba?\\(.*?\\)/)[0]));
}}"""


def opened(simulator, open_page, size="desktop", **options):
    width, height = SIZES[size]
    return open_page(simulator.screen.url, viewport={"width": width, "height": height}, **options)


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_focused_elements_are_visible(simulator, open_page, scheme):
    page = opened(simulator, open_page, color_scheme=scheme)
    publish_transform(simulator, "world", "turtle1", 10**9, 2.0, 1.0)
    page.wait_for_selector("#relation:visible")
    assert weak_rings(page) == {}


def test_focus_on_the_field_is_seen_on_every_colour(simulator, page):
    """Of two rings with a contrast of 9:1, one has at least 3:1 to whatever is around them."""
    for name in ("axes", "follow", "picture"):
        page.focus(f"#{name}")
        page.keyboard.press("Shift+Tab")
        page.keyboard.press("Tab")  # the ring is for those who use the keyboard
        assert page.evaluate("document.activeElement.id") == name
        assert page.evaluate(CONTRAST_OF_RINGS) >= 9


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_input_fields_have_a_visible_border(simulator, open_page, scheme):
    for k in range(2, 13):
        simulator.world.spawn(1.0 + k / 2, 2.0, 0.5, f"turtle{k}")
    page = opened(simulator, open_page, color_scheme=scheme)
    page.wait_for_selector("#find-turtle:visible")
    publish_transform(simulator, "world", "turtle1", 10**9, 2.0, 1.0)
    page.wait_for_selector("#relation:visible")
    assert weak_borders(page) == {}


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_texts_stand_out(simulator, open_page, scheme):
    simulator.missing = ("turtle2",)
    page = opened(simulator, open_page, color_scheme=scheme)
    publish_transform(simulator, "world", "turtle1", 10**9, 2.0, 1.0)
    page.wait_for_selector("#relation:visible")
    page.wait_for_selector("#hint:visible")
    page.wait_for_selector("#tree li[data-kind=stale]")
    page.click("#spawn")
    assert weak_texts(page) == []
    page.click("#pause")
    page.wait_for_selector("#pause[aria-pressed=true]")
    page.mouse.move(0, 0)
    assert weak_texts(page) == []


@pytest.mark.parametrize("size", SIZES)
def test_no_text_is_smaller_than_12_px(simulator, open_page, size):
    simulator.missing = ("turtle2",)
    page = opened(simulator, open_page, size)
    page.wait_for_selector("#hint:visible")
    assert small_texts(page) == []
    assert page.evaluate("document.documentElement.scrollWidth") <= SIZES[size][0]


def test_names_are_where_a_screen_reader_reads_them(simulator, open_page):
    assert opened(simulator, open_page).evaluate(UNREAD_NAMES) == []


def test_the_size_of_texts_in_the_browser_counts(simulator, page):
    assert root_size_with(page, 16) == pytest.approx(15)
    assert root_size_with(page, 24) == pytest.approx(22.5)


@pytest.mark.parametrize("scale", [1, 2])
def test_the_digits_of_the_grid_are_read_on_every_colour(simulator, open_page, scale):
    page = opened(simulator, open_page, device_scale_factor=scale)
    seen = {}
    for css in BACKGROUNDS:
        set_colour(page, "#background", css)
        wait_until(lambda css=css: simulator.background == tuple(bytes.fromhex(css[1:])))
        page.wait_for_function(
            """(css) => {
                const { data } = document.getElementById("ground").getContext("2d")
                    .getImageData(30, 30, 1, 1);
                const wanted = [1, 3, 5].map((at) => parseInt(css.slice(at, at + 2), 16));
                return wanted.every((value, k) => Math.abs(value - data[k]) < 30);
            }""",
            arg=css,
        )
        seen[css] = page.evaluate(CONTRAST_OF_DIGIT)
    assert {css: contrast for css, contrast in seen.items() if contrast < 4.5} == {}


def commands_after(simulator, page, *keys) -> list:
    """What keys have the simulator do."""
    simulator.commands.clear()
    for key in keys:
        page.keyboard.press(key)
    page.evaluate("document.getElementById('clear').click()")
    wait_until(lambda: page_commands.Clear() in simulator.commands)
    return simulator.commands[:-1]


def test_arrow_keys_scroll_a_list_that_has_the_focus(simulator, page):
    page.focus("#frames .scroll")
    assert commands_after(simulator, page, "ArrowDown", "ArrowUp", "ArrowLeft", "e") == []
    page.evaluate("document.activeElement.blur()")
    assert commands_after(simulator, page, "ArrowUp") == [page_commands.Drive("turtle1", 2.0, 0.0)]


def test_arrow_keys_on_a_name_drive_the_turtle_of_that_name_only(simulator, open_page):
    simulator.world.spawn(2.0, 2.0, 0.0, "turtle2")
    page = opened(simulator, open_page)
    page.get_by_role("button", name="turtle2").focus()
    assert commands_after(simulator, page, "ArrowUp") == []  # it would drive turtle1
    page.keyboard.press("Enter")
    assert commands_after(simulator, page, "ArrowUp") == [page_commands.Drive("turtle2", 2.0, 0.0)]


def test_disabled_letter_keys_do_not_turn_the_turtle(simulator, page):
    turn = [page_commands.Rotate("turtle1", 0.7854)]
    assert page.is_checked("#letter-keys")
    assert commands_after(simulator, page, "t") == turn
    page.uncheck("#letter-keys")
    drive = [page_commands.Drive("turtle1", 2.0, 0.0)]
    assert commands_after(simulator, page, "t", "F", "ArrowUp") == drive
    page.reload()
    page.wait_for_selector("#roster tr")
    assert commands_after(simulator, page, "t", "ArrowUp") == drive
    page.check("#letter-keys")
    assert commands_after(simulator, page, "t") == turn


def test_a_row_is_named_by_its_turtle(simulator, open_page):
    simulator.world.spawn(2.0, 2.0, 0.0, "turtle2")
    page = opened(simulator, open_page)
    page.wait_for_selector("#roster tr:nth-child(2)")
    heads = page.locator("#roster").get_by_role("rowheader")
    assert heads.all_inner_texts() == ["turtle1", "turtle2"]
