"""The lesson in Chromium: Python in the tab, without a network once it is loaded.

The lesson in Firefox: each lesson is solved by its solution, served and opened as a file.
"""

import json
import re
import shutil

import pytest
from tests.places import LESSONS
from tests.plain_server import LONG_MS, Host

from turtle_lesson.lesson import load_lesson

from .conftest import Firefox, wait_until_loaded
from .wrong_answers import WRONG_ANSWERS

pytestmark = [pytest.mark.slow, pytest.mark.timeout(600)]
ORDER = json.loads((LESSONS / "order.json").read_text(encoding="utf-8"))
LISTENER = "turtle_tf2_listener.py"
#: Opens a lesson with files in the editors, as if they had been typed, and runs it.
HAND_IN = """async ([lesson, files]) => {
    const kept = JSON.parse(localStorage.getItem("turtlewire-lesson") ?? "{}");
    kept.files = { ...kept.files, [lesson]: files };
    localStorage.setItem("turtlewire-lesson", JSON.stringify(kept));
    for (const hash of [`elsewhere-${performance.now()}`, lesson]) {
        await new Promise((resolve) => {  // the page has listened for longer: it is first
            addEventListener("hashchange", resolve, { once: true });
            location.hash = hash;
        });
    }
}"""

#: Presses `Check my solution`; each result as [passed, texts]. The button is disabled at once, and
#: may be enabled again before the next picture.
CHECK = """(async () => {
    const button = document.getElementById("check");
    button.click();
    await new Promise((resolve) => {
        const tell = () => button.disabled || resolve();
        new MutationObserver(tell).observe(button, { attributes: true });
    });
    const items = [...document.querySelectorAll("#results li")];
    return items.map((item) => [item.dataset.passed, item.textContent]);
})()"""


def hand_in(page, lesson, files):
    """Open a lesson with these files in the editors, as if they had been typed, and run it."""
    page.evaluate(HAND_IN, [lesson, files])


def check(page):
    """Press `Check my solution`; each result as (passed, texts)."""
    page.wait_for_selector("#check:enabled")
    return page.evaluate(CHECK)


def listener_with(old, new):
    files = load_lesson(LESSONS / "listener").starter()
    assert old in files[LISTENER]
    return {**files, LISTENER: files[LISTENER].replace(old, new)}


def wait_for_words(page, pattern):
    """Wait until the sentence about turtle1 and turtle2 matches."""
    page.wait_for_function(
        "(pattern) => new RegExp(pattern).test("
        "document.getElementById('relation-words').textContent)",
        arg=pattern,
    )


@pytest.fixture(scope="module")
def offline_page(browser, built):
    """The lesson, loaded once and then again without host and network."""
    errors = []
    host = Host(built)
    context = browser.new_context(viewport={"width": 1500, "height": 950})
    context.set_default_timeout(LONG_MS)
    page = context.new_page()
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(host.url)
    wait_until_loaded(page)
    page.reload()  # a busy machine may have started without the service worker
    wait_until_loaded(page)
    context.set_offline(True)
    host.close()
    page.reload()
    wait_until_loaded(page)
    yield page
    context.close()
    assert errors == []


@pytest.mark.parametrize("name", ORDER)
def test_offline_a_lesson_is_solved_and_typical_mistakes_get_their_hint(offline_page, name):
    page, lesson = offline_page, load_lesson(LESSONS / name)
    assert page.evaluate("crossOriginIsolated")
    hand_in(page, name, lesson.solution())
    results = check(page)
    assert len(results) >= 3
    assert all(passed == "yes" for passed, _ in results), results
    assert page.is_visible("#verdict")
    assert page.locator("#lessons a[aria-current]").get_attribute("data-solved") == "yes"
    for wrong in [wrong for wrong in WRONG_ANSWERS if wrong.exercise == name]:
        hand_in(page, name, wrong.files(lesson))
        passed, text = check(page)[-1]
        assert passed == "no", wrong
        assert re.search(wrong.hint, text), (wrong, text)


def test_turtle2_follows_and_the_arrow_keys_drive(open_page):
    page = open_page("listener")
    wait_for_words(page, r"^turtle1 is 0\.\d+ m ahead")
    page.locator("#clock").click()
    page.keyboard.press("ArrowUp")
    wait_for_words(page, r"^turtle1 is 1\.\d+ m ahead")
    page.wait_for_function(  # it is told when the turtles are drawn
        "() => document.getElementById('turtles').getAttribute('aria-label').includes('turtle2 at')"
    )
    tree = page.text_content("#tree")
    assert "turtle1" in tree
    assert "Hz" in tree
    page.locator("summary", has_text="tf2_echo").click()
    page.wait_for_function(
        "() => document.getElementById('tf-echo').textContent.includes('- Translation: [')"
    )
    page.locator("summary", has_text="ros2 topic echo").click()
    page.select_option("#topic", "/turtle1/pose")
    page.wait_for_function(
        "() => document.getElementById('topic-echo').textContent.includes('linear_velocity')"
    )


def test_keys_in_the_editor_are_for_the_editor(open_page):
    page = open_page("listener")
    page.click("#editors .cm-content")
    page.keyboard.press("Control+Home")
    page.keyboard.press("ArrowDown")
    page.keyboard.type("# typed ")
    assert page.text_content("#editors .cm-line:nth-child(2)").startswith("# typed import math")
    page.reload()
    wait_until_loaded(page)
    page.click("#editors .cm-content")
    page.keyboard.press("Control+Home")  # the editor only holds the lines around what it shows
    page.wait_for_function(
        "() => document.querySelector('#editors .cm-content').textContent"
        ".includes('# typed import math')"
    )
    page.click("#reset")
    page.wait_for_function(
        "() => !document.querySelector('#editors .cm-content').textContent.includes('typed')"
    )


def test_a_mistake_is_marked_at_its_line(open_page):
    page = open_page("listener")
    hand_in(page, "listener", listener_with("msg = Twist()", "msg = Twits()"))
    page.wait_for_selector("#mistake:not([hidden])")
    text = page.text_content("#mistake")
    assert text.startswith(f"{LISTENER}, line 54: NameError: name 'Twits' is not defined")
    assert "Import the name" in text
    marked = page.locator("#editors .cm-lintRange-error:visible")
    assert marked.text_content() == "msg = Twits()"
    assert page.text_content("#status") == "stopped"


@pytest.mark.parametrize("where", ["callback", "start", "check"])
def test_an_endless_loop_is_stopped_and_the_tab_lives_on(open_page, where):
    page = open_page("listener")
    if where == "start":
        files = listener_with("node = TurtleTF2Listener()", "while True: pass")
    else:
        files = listener_with("msg = Twist()", "\n        while True: pass")
    if where == "check":
        page.evaluate("window.before = true")
    hand_in(page, "listener", files)
    page.wait_for_selector("#mistake:not([hidden])")
    assert "did not return" in page.text_content("#mistake")
    if where == "check":
        passed, text = check(page)[-1]
        assert passed == "no"
        assert "did not return" in text
    page.click("#reset")
    page.wait_for_function("() => document.getElementById('status').textContent === 'running'")
    wait_for_words(page, r"^turtle1 is 0\.\d+ m ahead")


#: A call to a function that WebAssembly does not have.
CRASH = "import ctypes; ctypes.CFUNCTYPE(None)(10**7)()"


@pytest.mark.parametrize(
    ("code", "sentence"),
    [
        (CRASH, "crashed Python, which has restarted"),
        ("import threading; threading.Thread(target=print).start()", "A tab has one thread"),
        ("[0] * 10**10", "more than the memory of a tab"),
        ("input('who? ')", "no keyboard input here"),
        ("f = lambda: f(); f()", "calls itself again and again"),
        (  # on a slow machine the time is over before all memory is filled
            "kept = []\n        while True: kept.append(bytearray(10**8))",
            "the memory of a tab|Python ran out of memory|did not return",
        ),
        (f"kept = [bytearray(10**8) for _ in range(16)]; {CRASH}", "Python ran out of memory"),
        ("import time; time.sleep(1e9)", "did not return"),
        ("while True: print('a line')", "did not return"),
        ("import os; os._exit(1)", "ended Python itself"),
    ],
)
def test_code_that_does_harm_ends_in_a_sentence(offline_page, code, sentence):
    page = offline_page
    hand_in(page, "listener", listener_with("msg = Twist()", f"\n        {code}"))
    page.wait_for_selector("#mistake:not([hidden])")
    assert re.search(sentence, page.text_content("#mistake"))
    page.click("#reset")
    page.wait_for_function("() => document.getElementById('status').textContent === 'running'")
    wait_for_words(page, "^turtle1 is ")


def test_code_that_swallows_the_interrupt_is_stopped_by_another_worker(open_page):
    page = open_page("listener")
    loop = (
        "\n        while True:\n            try:\n                while True: pass\n"
        "            except BaseException: pass"
    )
    hand_in(page, "listener", listener_with("msg = Twist()", loop))
    page.wait_for_selector("#mistake:not([hidden])")
    page.click("#reset")
    page.wait_for_function("() => document.getElementById('status').textContent === 'running'")


def test_without_a_service_worker_the_loop_is_stopped_by_another_worker(open_page):
    page = open_page("listener", service_workers="block")
    assert not page.evaluate("crossOriginIsolated")
    hand_in(page, "listener", listener_with("msg = Twist()", "\n        while True: pass"))
    page.wait_for_selector("#mistake:not([hidden])")
    assert "did not return" in page.text_content("#mistake")
    page.click("#reset")
    wait_for_words(page, r"^turtle1 is 0\.\d+ m ahead")


def test_buttons_and_other_lessons_do_no_harm_while_it_loads(browser, host):
    context = browser.new_context()
    context.set_default_timeout(LONG_MS)
    page = context.new_page()
    errors = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(f"{host.url}#listener")
    page.wait_for_selector("#editors .cm-content")
    page.click("#reset")
    page.evaluate("location.hash = 'static'")
    page.click("#editors .cm-content")
    page.keyboard.press("Control+Enter")
    wait_until_loaded(page)
    page.wait_for_function(
        "() => document.getElementById('tree').textContent.includes('my_static_')"
    )
    page.click("#check")
    page.evaluate("location.hash = 'faults'")  # the results of the other lesson do not follow
    page.wait_for_function("() => document.getElementById('tree').textContent.includes('tower')")
    assert page.locator("#results li").count() == 0
    context.close()
    assert errors == []


def test_faults_show_in_the_tree_and_the_doctor_names_them(open_page):
    page = open_page("faults")
    page.wait_for_function("() => document.getElementById('tree').textContent.includes('turtle2')")
    page.locator("summary", has_text="turtlewire doctor").click()
    page.click("#examine")
    page.check("#faults input[value=two_publishers]")  # restarts the programs
    page.wait_for_function(
        "() => document.getElementById('doctor').textContent.includes('second_broadcaster')"
    )
    page.click("#run")
    page.click("#examine")  # before the programs run again
    assert page.text_content("#doctor").startswith("Listening")
    page.wait_for_function(
        "() => document.getElementById('doctor').textContent.includes('second_broadcaster')"
    )
    page.uncheck("#faults input[value=two_publishers]")
    # By the keyboard: a report that arrives just now moves the boxes away from a click.
    page.press("#faults input[value=delay]", "Space")
    page.wait_for_selector("#tree li[data-kind=stale]")


def test_a_hidden_fault_is_guessed(open_page):
    page = open_page("faults")
    page.evaluate("Math.random = () => 0.99")  # the last of the list
    page.click("#surprise")
    page.click("#faults input[value=delay]")
    assert "Not this one" in page.text_content("#guess")
    page.check("#faults input[value=two_publishers]")
    assert "Two publishers" in page.text_content("#guess")
    page.click("#surprise")  # another one
    assert page.locator("#faults input:checked").count() == 0


def test_the_weight_is_said_and_small_enough(built):
    manifest = json.loads((built / "manifest.json").read_text(encoding="utf-8"))
    assert manifest["compressed"] <= 15_000_000
    named = {file["path"] for file in manifest["files"]}
    there = {path.relative_to(built).as_posix() for path in built.rglob("*") if path.is_file()}
    assert there - named == {"manifest.json", "sw.js", "folder.js"}


def test_opened_as_a_file_it_runs_and_stops_endless_loops(browser, built):
    context = browser.new_context(offline=True)
    context.set_default_timeout(LONG_MS)
    page = context.new_page()
    told = []
    page.on("pageerror", lambda error: told.append(str(error)))
    page.on("console", lambda message: told.append(message.text))
    page.goto(f"{(built / 'index.html').as_uri()}#listener")
    wait_until_loaded(page)
    wait_for_words(page, r"^turtle1 is 0\.\d+ m ahead")
    hand_in(page, "listener", listener_with("msg = Twist()", "\n        while True: pass"))
    page.wait_for_selector("#mistake:not([hidden])")
    hand_in(page, "listener", load_lesson(LESSONS / "listener").solution())
    assert all(passed == "yes" for passed, _ in check(page))
    context.close()
    assert told == []


def test_the_frames_are_drawn_on_the_field_until_they_are_hidden(open_page):
    page = open_page("static")
    red = """(() => {  // how many pixels have the colour of an x axis
        const { width, height } = document.getElementById("turtles");
        const context = document.getElementById("turtles").getContext("2d");
        const { data } = context.getImageData(0, 0, width, height);
        const isRed = (k) => data[k] > 230 && data[k + 1] < 130 && data[k + 2] < 150;
        return data.filter((_, k) => k % 4 === 0 && isRed(k)).length;
    })()"""
    page.wait_for_function(f"() => {red} > 20")
    page.click("#axes")
    assert page.get_attribute("#axes", "aria-pressed") == "false"
    page.wait_for_function(f"() => {red} === 0")


FIREFOX = shutil.which("firefox-esr") or shutil.which("firefox")


@pytest.fixture
def firefox(tmp_path):
    if FIREFOX is None:
        pytest.skip("no firefox in PATH (Debian: apt install firefox-esr)")
    firefox = Firefox(FIREFOX, tmp_path)
    yield firefox
    firefox.close()
    assert firefox.errors == []


@pytest.mark.parametrize("kind", ["served", "file"])
def test_the_lessons_are_solved(firefox, kind, host, built):
    firefox.open(host.url if kind == "served" else (built / "index.html").as_uri())
    firefox.wait_for("document.body?.dataset.loadedMs !== undefined")
    assert firefox.evaluate("crossOriginIsolated") == (kind == "served")
    for name in ORDER if kind == "served" else ORDER[:1]:
        files = load_lesson(LESSONS / name).solution()
        firefox.evaluate(f"({HAND_IN})({json.dumps([name, files])})")
        results = firefox.evaluate(CHECK)
        assert len(results) >= 3
        assert all(passed == "yes" for passed, _ in results), results
