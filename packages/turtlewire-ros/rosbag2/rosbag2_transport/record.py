"""One recording from beginning to end, and the file of topics that it does not wait for."""

from __future__ import annotations

import contextlib
import os
import time
from collections.abc import Callable
from typing import TYPE_CHECKING

from rclpy.logging import get_logger
from rosbag2_transport.progress import ProgressLine, time_text
from rosbag2_transport.recorder import BagRecorder
from rosbag2_transport.recorder_services import RecorderServices
from rosbag2_transport.session import BagSession, handle_keys, stopped_by_signals
from rosbag2_transport.topic_filter import EVENT_TOPIC, check_patterns
from turtlewire.bag.metadata import METADATA_FILE
from turtlewire.bag.qos_yaml import load_yaml
from turtlewire.bag.recording import Recording
from turtlewire.bag.times import size_text
from turtlewire.distro import LYRICAL, since
from turtlewire.errors import BagError
from turtlewire.terminal.printable import printable
from turtlewire.wire.names import (
    validate_full_topic_name,
    validate_node_name,
    validate_topic_name,
)
from turtlewire.wording import counted

if TYPE_CHECKING:
    import queue

    from rosbag2_transport.options import RecordOptions
    from turtlewire.bag.writer import BagWriter

_STATIC_TOPICS = "static_topics_and_types_list"
_STATIC_EXAMPLE = f"""
Such a file is, for example:
{_STATIC_TOPICS}:
- [/chatter, std_msgs/msg/String]"""


def record(
    make_writer: Callable[[], BagWriter],
    options: RecordOptions,
    stop: queue.SimpleQueue[None],
    *,
    node_name: str = "rosbag2_recorder",
    cache_bytes: int = 0,
    cache_ns: int = 0,
    snapshot: bool = False,
    on_start: Callable[[BagRecorder], object] = lambda _recorder: None,
) -> None:
    """Record until ``stop`` holds an item, SIGINT or SIGTERM comes, or the disk is full.

    Args:
        make_writer: Makes the bag, which is closed at the end; called when all else is there.
        options: Options of the recording.
        stop: Ends the recording.
        node_name: Name of the recorder's node.
        cache_bytes: How many bytes may wait for the disk; 0 for no limit.
        cache_ns: How long a span of time the messages of a snapshot may have; 0 for no limit.
        snapshot: Whether only snapshots are written.
        on_start: Called with the recorder when it has started.

    Raises:
        RuntimeError: An option is wrong, or the bag could not be written any more.
    """
    # All checks come before the bag's folder is made.
    check_patterns(options)
    _check_names(options)
    static = read_static_topics(options.static_topics_uri) if options.static_topics_uri else {}
    if snapshot and not cache_bytes and not cache_ns:
        what = "Either the max cache size or the maximum cache duration"
        raise RuntimeError(
            f"{what if since(LYRICAL) else 'Max cache size'} must be greater than 0 when snapshot"
            " mode is enabled"
        )
    name = options.node_prefix + node_name
    if fault := validate_node_name(name):
        raise RuntimeError(f"'{name}' cannot be the name of a node: {fault.message}")
    with (
        stopped_by_signals(stop),  # an interrupt never leaves a bag without metadata
        BagSession(name, use_sim_time=options.use_sim_time) as session,
        contextlib.ExitStack() as at_end,  # the node still reports the last files
    ):
        writer = make_writer()
        recording = Recording(
            writer,
            cache_bytes=cache_bytes,
            cache_ns=cache_ns,
            snapshot=snapshot,
            on_failure=lambda _: stop.put(None),
        )
        at_end.callback(_finish, recording, writer)
        recorder = BagRecorder(session.node, recording, options, static)
        services = RecorderServices(session.node, recorder, recording, snapshot=snapshot)
        writer.on_split = lambda closed, opened: _split(services, closed, opened)
        writer.on_compress = _say_that_it_compresses
        _run(session, recorder, recording, options, stop, on_start)


def read_static_topics(path: str) -> dict[str, str]:
    """Return the types by topic of those that are subscribed to before they have a publisher.

    Raises:
        RuntimeError: The file cannot be read, or does not hold such a list.
    """
    try:
        with open(path, encoding="utf-8") as file:
            content = load_yaml(file.read(), path)
    except (BagError, OSError, UnicodeDecodeError) as error:
        raise RuntimeError(f"cannot read the topics in {path}: {error}") from error
    pairs = content.get(_STATIC_TOPICS) if isinstance(content, dict) else None
    if not isinstance(pairs, list):
        raise RuntimeError(  # noqa: TRY004 - the file is wrong, not the call
            f"{path}: the key '{_STATIC_TOPICS}' with a list is missing.{_STATIC_EXAMPLE}"
        )
    found: dict[str, str] = {}
    for pair in pairs:
        words = [word for word in pair if isinstance(word, str)] if isinstance(pair, list) else []
        if len(words) != 2 or len(pair) != 2:
            raise RuntimeError(f"{path}: {pair!r} is not a topic and its type.{_STATIC_EXAMPLE}")
        topic, type_name = words
        if fault := validate_full_topic_name(topic):
            raise RuntimeError(f"{path}: '{topic}' cannot be the name of a topic: {fault.message}")
        found[topic] = type_name
    return found


def _check_names(options: RecordOptions) -> None:
    """Reject names that no topic or service can have; they would be waited for in vain."""
    for kind, names in (
        ("topic", options.topics),
        ("service", options.services),
        ("action", options.actions),
    ):
        for name in (each.removesuffix(EVENT_TOPIC) for each in names):
            if fault := validate_topic_name(name):
                text = fault.message.replace("topic", kind, 1)
                raise RuntimeError(f"'{name}' cannot be the name of a {kind}: {text}")


def _finish(recording: Recording, writer: BagWriter) -> None:
    """Write what waits, and raise why the bag could not be written, if so."""
    failure: Exception | None = None
    try:
        recording.close()
    except OSError as error:
        failure = error
    _report_lost(recording)
    failure = recording.failure or failure
    if failure is not None:
        is_whole = os.path.exists(os.path.join(writer.path, METADATA_FILE))
        remedy = "" if is_whole else "; free some space, and repair it with `ros2 bag reindex`"
        raise RuntimeError(
            f"Recording stopped: {failure}. What was recorded before is in {writer.path}{remedy}"
        )


def _run(
    session: BagSession,
    recorder: BagRecorder,
    recording: Recording,
    options: RecordOptions,
    stop: queue.SimpleQueue[None],
    on_start: Callable[[BagRecorder], object],
) -> None:
    logger = session.node.get_logger()
    with handle_keys({b" ": recorder.toggle_paused}, not options.disable_keyboard_controls):
        if not options.disable_keyboard_controls:
            logger.info("Press SPACE for pausing/resuming")
        logger.info("Event publisher thread: Starting")
        logger.info("Listening for topics...")
        recorder.start()
        paused = "Wait for recording: Press SPACE to start."
        logger.info(paused if options.start_paused else "Recording...")
        on_start(recorder)
        started = time.monotonic()
        with ProgressLine(lambda: _progress(recorder, recording, time.monotonic() - started)):
            stop.get()
    recorder.stop()  # takes what has arrived, which a pause would drop
    recorder.pause()
    _say_that_it_writes()
    logger.info("Event publisher thread: Exiting")
    logger.info("Recording stopped")


def _split(services: RecorderServices, closed: str, opened: str) -> None:
    _say_that_it_writes()
    services.report_split(closed, opened)


def _say_that_it_writes() -> None:
    get_logger("rosbag2_cpp").info(
        "Writing remaining messages from cache to the bag. It may take a while"
    )


def _say_that_it_compresses(path: str) -> None:
    get_logger("rosbag2_compression").info(f"Compressing file: {path}")


def _progress(recorder: BagRecorder, recording: Recording, seconds: float) -> str:
    status = recording.status
    lost = f", {status.lost} lost" if status.lost else ""
    state = "paused" if recorder.is_paused else "recording"
    return (
        f"{state} {time_text(seconds)}: {counted(recorder.topics, 'topic')}, "
        f"{counted(status.messages, 'message')}, {size_text(status.data_bytes)}{lost}"
    )


def _report_lost(recording: Recording) -> None:
    for topic, (count, reason) in recording.refused.items():
        messages = "message was" if count == 1 else "messages were"
        text = f"{topic}: {count} {messages} not recorded: {reason}"
        get_logger("rosbag2_cpp").warning(printable(text))
    if recording.lost:
        lines = "".join(f"\n\t{topic}: {count}" for topic, count in recording.lost.items())
        total = sum(recording.lost.values())
        get_logger("rosbag2_cpp").warning(
            f"Cache buffers lost messages per topic: {lines}\nTotal lost: {total}"
        )
