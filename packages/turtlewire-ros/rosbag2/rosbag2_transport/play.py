"""One playback from beginning to end."""

from __future__ import annotations

import sqlite3
import threading
from typing import TYPE_CHECKING

from rosbag2_transport.player import Player
from rosbag2_transport.player_clock import ClockPublisher
from rosbag2_transport.player_services import PlayerServices
from rosbag2_transport.progress import ProgressLine, time_text
from rosbag2_transport.session import BagSession, handle_keys, stopped_by_signals
from turtlewire.errors import BagError

if TYPE_CHECKING:
    import queue
    from collections.abc import Callable

    from rosbag2_transport.options import PlayOptions

__all__ = ["burst", "play"]

_NAME = "rosbag2_player"
_RATE_STEP = 0.1
_SECOND = 1_000_000_000
_KEYS = (
    "Adding keyboard callbacks.",
    "Press SPACE for Pause/Resume",
    "Press CURSOR_RIGHT for Play Next Message",
    "Press CURSOR_UP for Increase Rate 10%",
    "Press CURSOR_DOWN for Decrease Rate 10%",
)


def play(path: str, options: PlayOptions, stop: queue.SimpleQueue[None]) -> None:
    """Play a bag until its end, or until ``stop`` holds an item or SIGINT or SIGTERM comes.

    Args:
        path: The bag.
        options: What is played, and how.
        stop: Ends the playback.

    Raises:
        RuntimeError: The bag does not exist, or an option is invalid.
    """
    _with_player(path, options, stop, lambda _player: None)


def burst(path: str, options: PlayOptions, stop: queue.SimpleQueue[None], count: int) -> None:
    """Publish the first messages of a bag at once, then wait paused as `play` does.

    Args:
        path: The bag.
        options: What is played, and how.
        stop: Ends the playback.
        count: How many messages; 0 for all.

    Raises:
        RuntimeError: The bag does not exist, or an option is invalid.
    """
    options.start_paused = True
    _with_player(path, options, stop, lambda player: player.burst(count))


def _with_player(
    path: str,
    options: PlayOptions,
    stop: queue.SimpleQueue[None],
    first: Callable[[Player], object],
) -> None:
    words = [word for word in options.topic_remapping_options if ":=" in word]
    name = options.node_prefix + _NAME
    failures: list[Exception] = []
    try:
        with (
            stopped_by_signals(stop),
            BagSession(name, remap=tuple(words)) as session,
        ):
            player = Player(session.node, path, options)
            try:
                PlayerServices(session.node, player)
                bindings = _bindings(player, session, options)
                with (
                    handle_keys(bindings, not options.disable_keyboard_controls),
                    ClockPublisher(session.node, player, options),
                    ProgressLine(lambda: _progress(player)),
                ):
                    _run(player, stop, first, failures)
            finally:
                player.close()
    except (BagError, OSError) as error:
        raise RuntimeError(str(error)) from error
    if failures:
        raise RuntimeError(str(failures[0])) from failures[0]


def _run(
    player: Player,
    stop: queue.SimpleQueue[None],
    first: Callable[[Player], object],
    failures: list[Exception],
) -> None:
    """Play on a thread, so that this one can be interrupted."""

    def play_all() -> None:
        try:
            player.play()
        except (BagError, OSError, sqlite3.Error) as error:
            failures.append(error)
        finally:
            stop.put(None)

    thread = threading.Thread(target=play_all, name="bag-player", daemon=True)
    thread.start()
    starter = threading.Thread(target=first, args=(player,), name="bag-burst", daemon=True)
    starter.start()
    stop.get()
    player.stop()
    thread.join()
    starter.join()


def _bindings(
    player: Player, session: BagSession, options: PlayOptions
) -> dict[bytes, Callable[[], object]]:
    """Return the action of each key, and print the keys."""
    if not options.disable_keyboard_controls:
        for line in _KEYS:
            session.node.get_logger().info(line)
    return {
        b" ": player.toggle_paused,
        b"\x1b[C": player.play_next,
        b"\x1b[A": lambda: player.set_rate(round(player.clock.rate + _RATE_STEP, 9)),
        b"\x1b[B": lambda: player.set_rate(round(player.clock.rate - _RATE_STEP, 9)),
    }


def _progress(player: Player) -> str:
    with player.changed:
        now_ns = min(max(player.clock.now_ns(), player.start_ns), player.end_ns)
        rate, is_paused = player.clock.rate, player.clock.is_paused
    done, left = (now_ns - player.start_ns) / _SECOND, (player.end_ns - now_ns) / _SECOND
    whole = time_text((player.end_ns - player.start_ns) / _SECOND)
    rest = "paused" if is_paused else f"{time_text(left / rate)} left"
    speed = "" if rate == 1 else f" at {rate:g}x"
    return f"playing{speed}: {time_text(done)} of {whole}, {rest}"
