"""Guards callbacks on shared threads, which an exception would end."""

from __future__ import annotations

import threading
from collections.abc import Callable
from contextlib import suppress

#: Bounds the table for programs that generate code; beyond it, lines are reported again.
_MOST_PLACES = 1000
_reported: set[tuple[str, int, type[BaseException]]] = set()


def call_guarded(call: Callable[..., object], *arguments: object) -> None:
    """Call ``call(*arguments)``, and report an exception instead of raising it.

    ``threading.excepthook`` reports it, once for each line that raises: a callback that fails for
    one message often fails for a thousand each second.
    """
    try:
        call(*arguments)
    except KeyboardInterrupt:  # of the main thread, which calls in a browser tab
        raise
    except BaseException as error:  # noqa: BLE001 - the thread must continue
        _report(error)


def _report(error: BaseException) -> None:
    raised = error.__traceback__
    assert raised is not None
    while raised.tb_next is not None:
        raised = raised.tb_next
    place = raised.tb_frame.f_code.co_filename, raised.tb_lineno, type(error)
    if place in _reported:
        return
    if len(_reported) >= _MOST_PLACES:
        _reported.clear()
    _reported.add(place)
    arguments = threading.ExceptHookArgs(
        (type(error), error, error.__traceback__, threading.current_thread())
    )
    with suppress(Exception):  # stderr may be closed; then there is nobody to tell
        threading.excepthook(arguments)
