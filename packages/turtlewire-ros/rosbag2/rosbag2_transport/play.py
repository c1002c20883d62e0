"""One playback from beginning to end."""

from __future__ import annotations

import contextlib
import sqlite3
import threading
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING

from rosbag2_transport.player import BagPlayer
from rosbag2_transport.player_services import ClockPublisher, PlayerServices
from rosbag2_transport.progress import ProgressLine, time_text
from rosbag2_transport.session import BagSession, handle_keys, stopped_by_signals
from turtlewire.errors import BagError

if TYPE_CHECKING:
    import queue

    from rosbag2_transport.options import PlayOptions

_RATE_STEP = 0.1
_SECOND = 1_000_000_000
_KEYS = (
    "Adding keyboard callbacks.",
    "Press SPACE for Pause/Resume",
    "Press CURSOR_RIGHT for Play Next Message",
    "Press CURSOR_UP for Increase Rate 10%",
    "Press CURSOR_DOWN for Decrease Rate 10%",
)


def play(paths: Sequence[str], options: PlayOptions, stop: queue.SimpleQueue[None]) -> None:
    """Play bags to their end, or until ``stop`` holds an item or SIGINT or SIGTERM comes.

    Args:
        paths: The bags.
        options: Options of the playback.
        stop: Ends the playback.

    Raises:
        RuntimeError: A bag does not exist, or an option is invalid.
    """
    _with_player(paths, options, stop, lambda _player: None)


def burst(
    paths: Sequence[str], options: PlayOptions, stop: queue.SimpleQueue[None], count: int
) -> None:
    """Publish the first messages of bags at once, then wait paused as `play` does.

    Args:
        paths: The bags.
        options: Options of the playback.
        stop: Ends the playback.
        count: How many messages; 0 for all.

    Raises:
        RuntimeError: A bag does not exist, or an option is invalid.
    """
    options.start_paused = True
    _with_player(paths, options, stop, lambda player: player.burst(count))


def _with_player(
    paths: Sequence[str],
    options: PlayOptions,
    stop: queue.SimpleQueue[None],
    first: Callable[[BagPlayer], object],
) -> None:
    failures: list[Exception] = []
    try:
        with (
            stopped_by_signals(stop),
            served_player(paths, options) as (player, session),
            handle_keys(_bindings(player, session, options), not options.disable_keyboard_controls),
            ProgressLine(lambda: _progress(player), options.progress_bar_update_rate),
        ):
            _run(player, stop, first, failures)
    except (BagError, OSError) as error:
        raise RuntimeError(str(error)) from error
    if failures:
        raise RuntimeError(str(failures[0])) from failures[0]


@contextlib.contextmanager
def served_player(
    paths: Sequence[str], options: PlayOptions, node_name: str = "rosbag2_player"
) -> Iterator[tuple[BagPlayer, BagSession]]:
    """Open bags to play, on a node with the player's services and clock.

    Args:
        paths: The bags.
        options: Options of the playback.
        node_name: Name of the node.

    Raises:
        BagError: A bag cannot be read.
        FileNotFoundError: A bag does not exist.
        RuntimeError: An option is invalid.
    """
    words = [word for word in options.topic_remapping_options if ":=" in word]
    with BagSession(options.node_prefix + node_name, remap=tuple(words)) as session:
        player = BagPlayer(session.node, paths, options)
        try:
            PlayerServices(session.node, player)
            with ClockPublisher(session.node, player, options):
                yield player, session
        finally:
            player.close()


def _run(
    player: BagPlayer,
    stop: queue.SimpleQueue[None],
    first: Callable[[BagPlayer], object],
    failures: list[Exception],
) -> None:
    """Play on a thread, so that this one can be interrupted."""

    def play_all() -> None:
        try:
            player.play()
        except (BagError, OSError, sqlite3.Error) as error:
            failures.append(error)
        finally:
            # Ends the wait below, whether the bag is over or has failed.
            stop.put(None)

    thread = threading.Thread(target=play_all, name="bag-player", daemon=True)
    thread.start()
    # On its own thread: a burst waits for the player, and this thread for `stop`.
    starter = threading.Thread(target=first, args=(player,), name="bag-burst", daemon=True)
    starter.start()
    stop.get()
    player.stop()
    thread.join()
    starter.join()


def _bindings(
    player: BagPlayer, session: BagSession, options: PlayOptions
) -> dict[bytes, Callable[[], object]]:
    """Return the action of each key, and print the keys."""
    if not options.disable_keyboard_controls:
        for line in _KEYS:
            session.node.get_logger().info(line)
    return {
        b" ": player.toggle_paused,
        b"\x1b[C": player.play_next,
        # Rounded, because steps of 0.1 would add up to rates such as 1.2000000000000002.
        b"\x1b[A": lambda: player.set_rate(round(player.clock.rate + _RATE_STEP, 9)),
        b"\x1b[B": lambda: player.set_rate(round(player.clock.rate - _RATE_STEP, 9)),
    }


def _progress(player: BagPlayer) -> str:
    with player.changed:
        now_ns = min(max(player.clock.now_ns(), player.start_ns), player.end_ns)
        rate, is_paused = player.clock.rate, player.clock.is_paused
    done, left = (now_ns - player.start_ns) / _SECOND, (player.end_ns - now_ns) / _SECOND
    whole = time_text((player.end_ns - player.start_ns) / _SECOND)
    rest = "paused" if is_paused else f"{time_text(left / rate)} left"
    speed = "" if rate == 1 else f" at {rate:g}x"
    return f"playing{speed}: {time_text(done)} of {whole}, {rest}"
