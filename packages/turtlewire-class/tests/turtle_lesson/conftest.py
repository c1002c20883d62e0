"""The built lesson, served to this machine; pages of it that report their errors, and Firefox.

Firefox is driven through WebDriver BiDi, which it speaks itself: no driver is installed.
"""

import contextlib
import itertools
import json
import re
import subprocess
import sys
import threading

import pytest
from tests.places import TOOLS
from tests.plain_server import LONG_MS, Host
from websockets.sync.client import connect


@pytest.fixture(scope="session")
def built(tmp_path_factory):
    """The lesson as `scripts/lesson` builds it."""
    folder = tmp_path_factory.mktemp("site") / "lesson"
    script = TOOLS / "lesson.py"
    done = subprocess.run(
        [sys.executable, str(script), "--output", str(folder)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return folder


@pytest.fixture
def host(built):
    host = Host(built)
    yield host
    host.close()


@pytest.fixture
def open_page(browser, host):
    """Opens the lesson in a fresh browser profile and waits until it runs."""
    contexts, errors = [], []

    def open_page(lesson="", **options):
        context = browser.new_context(**{"viewport": {"width": 1500, "height": 950}, **options})
        contexts.append(context)
        context.set_default_timeout(LONG_MS)
        page = context.new_page()
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.on(
            "request",
            lambda request: (
                errors.append(request.url)
                if not request.url.startswith((host.url, "blob:", "data:"))
                else None
            ),
        )
        page.goto(f"{host.url}#{lesson}")
        wait_until_loaded(page)
        return page

    yield open_page
    for context in contexts:
        context.close()
    assert errors == []


def wait_until_loaded(page):
    page.wait_for_function("() => document.body?.dataset.loadedMs !== undefined", timeout=LONG_MS)


_LISTENING = re.compile(r"WebDriver BiDi listening on (ws://\S+)")


class BidiError(Exception):
    """A command that Firefox refused, with its words."""


class Firefox:
    """A headless Firefox with a fresh profile.

    Args:
        program: Path of the program.
        profile: An empty folder.

    Attributes:
        errors: What pages have thrown and not caught.
    """

    def __init__(self, program, profile):
        self._numbers = itertools.count()
        self.errors = []
        with contextlib.ExitStack() as stack:
            process = stack.enter_context(
                subprocess.Popen(
                    [program, "--headless", "--profile", profile, "--remote-debugging-port", "0"],
                    stderr=subprocess.PIPE,
                    stdout=subprocess.DEVNULL,
                    text=True,
                )
            )
            drain = threading.Thread(target=process.stderr.read, daemon=True)
            stack.callback(process.terminate)
            heard = next(filter(None, map(_LISTENING.search, process.stderr)))
            drain.start()
            self._socket = stack.enter_context(
                connect(f"{heard[1]}/session", max_size=None, open_timeout=60)
            )
            self._ask("session.new", capabilities={})
            self._ask("session.subscribe", events=["log.entryAdded"])
            self._context = self._ask("browsingContext.getTree")["contexts"][0]["context"]
            stack.pop_all()
            self._process, self._drain = process, drain

    def close(self):
        """End Firefox."""
        self._socket.close()
        self._process.terminate()
        self._drain.join()
        self._process.wait()
        self._process.stderr.close()

    def open(self, url):
        """Open a page and wait until it is loaded."""
        self._ask("browsingContext.navigate", context=self._context, url=url, wait="complete")

    def evaluate(self, expression):
        """Return the awaited value of a JavaScript expression, as far as JSON can hold it."""
        answer = self._ask(
            "script.evaluate",
            expression=f"(async () => JSON.stringify(await ({expression})))()",
            target={"context": self._context},
            awaitPromise=True,
        )
        assert answer["type"] == "success", answer["exceptionDetails"]["text"]
        return json.loads(answer["result"].get("value", "null"))

    def wait_for(self, condition):
        """Wait until a JavaScript expression is true; the page looks at each animation frame."""
        look = (
            f"const look = () => ({condition}) ? resolve() : requestAnimationFrame(look); look();"
        )
        is_true = False
        while not is_true:  # where the page is reloaded meanwhile, its promise is gone
            with contextlib.suppress(BidiError):
                is_true = self.evaluate(f"new Promise((resolve) => {{ {look} }}).then(() => true)")

    def _ask(self, method, **parameters):
        number = next(self._numbers)
        self._socket.send(json.dumps({"id": number, "method": method, "params": parameters}))
        while True:
            told = json.loads(self._socket.recv(timeout=110))
            if told.get("id") == number:
                if told["type"] != "success":
                    raise BidiError(told["message"])
                return told["result"]
            if told.get("params", {}).get("type") == "javascript":
                self.errors.append(told["params"]["text"])
