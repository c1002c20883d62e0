"""The lesson by keyboard and with a screen reader, and its messages while it loads."""

import pytest
from tests.plain_server import LONG_MS

from .conftest import wait_until_loaded

pytestmark = [pytest.mark.slow, pytest.mark.timeout(600)]
#: Notes each stage that is shown as the current one.
WATCH_STAGES = """
addEventListener("DOMContentLoaded", () => {
    globalThis.stages = [];
    new MutationObserver(() => {
        const current = document.querySelector("#stages li[data-state=current]");
        const name = current?.dataset.stage;
        if (name && name !== stages.at(-1)) stages.push(name);
    }).observe(document.getElementById("stages"), { subtree: true, attributes: true });
});
"""
#: Counts the pieces of text that are added to the log, and those that are removed.
WATCH_LOG = """
addEventListener("DOMContentLoaded", () => {
    globalThis.added = globalThis.removed = 0;
    new MutationObserver((changes) => changes.forEach(({ addedNodes, removedNodes }) => {
        added += addedNodes.length;
        removed += removedNodes.length;
    })).observe(document.getElementById("log"), { childList: true });
});
"""
STAGES = ["prepare", "fetch", "python", "turtlewire", "run"]


def test_the_stages_that_run_waits_for_are_shown(browser, host):
    context = browser.new_context()
    context.set_default_timeout(LONG_MS)
    page = context.new_page()
    page.add_init_script(WATCH_STAGES)
    page.goto(host.url)
    page.wait_for_selector("#stages li[data-stage=python][data-state=current]")
    assert page.is_disabled("#run")
    assert "Run is waiting for Python" in page.inner_text("#loading-text")
    assert page.inner_text("#status") == "starting Python …"
    wait_until_loaded(page)
    assert page.evaluate("stages") == STAGES
    assert page.is_hidden("#loading")
    assert page.is_enabled("#run")
    context.close()


def test_a_lesson_that_cannot_be_loaded_says_so_above_everything(browser, host):
    context = browser.new_context(viewport={"width": 390, "height": 844}, service_workers="block")
    context.set_default_timeout(LONG_MS)
    page = context.new_page()
    page.route("**/python_stdlib.zip", lambda route: route.fulfill(status=404))
    page.goto(host.url)
    page.wait_for_selector("#status[data-state=lost]")
    text = page.locator("#loading-text")
    assert "could not be loaded" in text.inner_text()
    assert text.bounding_box()["y"] < 300
    assert page.is_hidden("#stages")
    context.close()


def test_tab_indents_and_after_escape_it_leaves_the_editor(open_page):
    page = open_page("listener")
    editor = page.locator("#editors .cm-content:visible")
    hint = page.locator(f"#{editor.get_attribute('aria-describedby')}")
    assert hint.inner_text() == "Tab indents. Escape, then Tab leaves the editor."
    assert hint.is_visible()
    is_inside = "document.getElementById('editors').contains(document.activeElement)"
    editor.focus()
    before = editor.inner_text()
    page.keyboard.press("Tab")
    assert page.evaluate(is_inside)
    assert editor.inner_text() != before
    page.keyboard.press("Escape")
    page.keyboard.press("Tab")
    assert not page.evaluate(is_inside)
    page.keyboard.press("Shift+Tab")  # back: Tab indents again
    page.keyboard.type("x")
    page.keyboard.press("Tab")
    assert page.evaluate(is_inside)


def test_lines_are_added_to_the_log_and_it_is_not_replaced(browser, host):
    context = browser.new_context()
    context.set_default_timeout(LONG_MS)
    page = context.new_page()
    page.add_init_script(WATCH_LOG)
    page.goto(f"{host.url}#listener")
    log = page.get_by_role("log", name="Log")
    log.get_by_text("turtle2").first.wait_for()
    lines = log.inner_text().strip().splitlines()
    assert len(lines) >= 2
    added, removed = page.evaluate("[added, removed]")
    assert added >= len(lines)
    assert removed == 0
    context.close()
