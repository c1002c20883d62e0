"""Log lines about failed lookups on the console: with the hint, and without a flood."""

import pytest

import turtlewire
from rclpy.impl import failed_lookups, log_output
from rclpy.logging import get_logger
from turtlewire.errors import TransformException


@pytest.fixture
def clock(monkeypatch):
    """The time that decides about repetitions, in a list of one."""
    now = [0]
    monkeypatch.setattr(failed_lookups, "monotonic_ns", lambda: now[0])
    return now


@pytest.fixture
def buffer():
    buffer = turtlewire.Buffer()
    for child in "turtle1", "camera":
        buffer.set_transform("world", child, 1_000_000_000, (0, 0, 0), (0, 0, 0, 1))
    return buffer


@pytest.fixture
def rosout():
    records = []
    log_output.add_rosout_sink("listener", records.append)
    yield records
    log_output.remove_rosout_sink("listener", records.append)


def listener(buffer):
    """Do what a tutorial's listener does each time its timer fires."""
    logger = get_logger("listener")

    def on_timer(source):
        try:
            buffer.lookup_transform("world", source, None)
        except TransformException as ex:
            return logger.info(f"Could not transform: {ex}")

    return on_timer


TEXT = 'Could not transform: "{}" passed to lookupTransform argument source_frame does not exist. '


def test_the_hint_follows_and_ros_gets_the_text_alone(buffer, clock, rosout, capfd):
    assert listener(buffer)("camra") is True
    line, hint = capfd.readouterr().err.splitlines()
    assert line.startswith("[INFO] [")
    assert line.endswith(f"[listener]: {TEXT.format('camra')}")
    assert hint == "    Did you mean 'camera'?"
    assert [record.message for record in rosout] == [TEXT.format("camra")]


def test_the_console_repeats_a_failure_once_a_second(buffer, clock, rosout, capfd):
    on_timer = listener(buffer)
    for tick in range(25):
        clock[0] = tick * 100_000_000
        assert on_timer("camra") is True
    lines = capfd.readouterr().err.splitlines()
    assert [line.strip() for line in lines[1::2]] == [
        "Did you mean 'camera'?",
        *["Did you mean 'camera'? (9 more of these since the last.)"] * 2,
    ]
    assert len(rosout) == 25


def test_another_frame_is_another_failure(buffer, clock, capfd):
    on_timer = listener(buffer)
    for _ in range(3):
        on_timer("camra")
        on_timer("wrld")
    assert capfd.readouterr().err.count("Could not") == 2


def test_many_frames_are_not_remembered_without_end(buffer, clock, capfd):
    on_timer = listener(buffer)
    for number in range(150):
        on_timer(f"unknown{number}")
    on_timer("unknown149")
    on_timer("unknown0")
    assert capfd.readouterr().err.count("Could not") == 151


@pytest.mark.parametrize(("frames", "shown"), [(100, 100), (101, 102)])
def test_a_hundred_frames_are_remembered(buffer, clock, capfd, frames, shown):
    on_timer = listener(buffer)
    for number in (*range(frames), 0):
        on_timer(f"unknown{number}")
    assert capfd.readouterr().err.count("Could not") == shown


def test_other_lines_are_left_alone(buffer, clock, capfd):
    logger = get_logger("listener")
    for error in ValueError("a"), None:
        try:
            if error:
                raise error
            buffer.lookup_transform("world", "camra", None)
        except (ValueError, TransformException):
            for _ in range(3):
                logger.info("the lookup failed")
    assert capfd.readouterr().err.splitlines()[0].endswith("the lookup failed")
    for _ in range(3):
        logger.info("no error")
    assert len(capfd.readouterr().err.splitlines()) == 3


def test_the_log_file_has_every_line(buffer, clock, monkeypatch, tmp_path):
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path))
    log_output.configure(file=True, file_prefix="x", console=False)
    on_timer = listener(buffer)
    for _ in range(3):
        on_timer("camra")
    log_output.configure(file=False)
    (file,) = tmp_path.glob("x_*.log")
    assert file.read_text().count("Could not transform") == 3


def test_a_turtle_that_is_still_to_come_is_no_typo(buffer):
    with pytest.raises(TransformException) as caught:
        buffer.lookup_transform("turtle2", "turtle1", None)
    assert caught.value.hint.startswith("The frames are '")
