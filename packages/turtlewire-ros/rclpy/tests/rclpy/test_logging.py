from __future__ import annotations

import os
import re
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from typing import ClassVar

import pytest
from tests.programs import run_python

import rclpy.logging
from rclpy.clock import Clock, ClockType
from rclpy.impl import log_levels, log_output, rcutils_logger
from rclpy.impl.arguments import Arguments
from rclpy.impl.log_output import LineFormat
from rclpy.impl.logging_severity import LoggingSeverity
from rclpy.impl.rcutils_logger import RcutilsLogger
from rclpy.time import Time

ENVIRONMENT = (
    "RCUTILS_CONSOLE_OUTPUT_FORMAT",
    "RCUTILS_COLORIZED_OUTPUT",
    "RCUTILS_LOGGING_USE_STDOUT",
    "RCUTILS_LOGGING_BUFFERED_STREAM",
)


@pytest.fixture(autouse=True)
def fresh(monkeypatch):
    for variable in ENVIRONMENT:
        monkeypatch.delenv(variable, raising=False)
    log_levels.reset()
    log_output.configure(file=False)
    yield
    log_levels.reset()
    log_output.configure(file=False)


@pytest.fixture
def logger():
    return rclpy.logging.get_logger("robot.camera")


def errors(capfd):
    return capfd.readouterr().err.splitlines()


def messages(capfd):
    return [line.partition("]: ")[2] for line in errors(capfd)]


def test_the_line_is_ros_2s(logger, capfd):
    before = time.time_ns()
    assert logger.info("text") is True
    (line,) = errors(capfd)
    match = re.fullmatch(r"\[INFO\] \[(\d{10})\.(\d{9})\] \[robot\.camera\]: text", line)
    assert before <= int(match[1] + match[2]) <= time.time_ns()


def test_every_severity_has_its_method(logger, capfd):
    logger.set_level(LoggingSeverity.DEBUG)
    results = [
        logger.debug("x"),
        logger.info("x"),
        logger.warning("x"),
        logger.warning("x"),
        logger.error("x"),
        logger.fatal("x"),
        logger.log("x", LoggingSeverity.ERROR),
    ]
    assert all(result is True for result in results)
    shown = [line.split()[0] for line in errors(capfd)]
    assert shown == ["[DEBUG]", "[INFO]", "[WARN]", "[WARN]", "[ERROR]", "[FATAL]", "[ERROR]"]


def test_messages_are_converted_unless_the_level_is_off(logger, capfd):
    class Costly:
        def __str__(self):
            raise AssertionError("nobody reads this")

    assert logger.debug(Costly()) is False
    logger.info({"a": [1]})
    assert messages(capfd) == ["{'a': [1]}"]


def test_unencodable_characters_are_escaped(logger, capfd):
    logger.info("a\udce9é\nb")
    assert capfd.readouterr().err.endswith("a\\udce9é\nb\n")


def test_children_inherit_levels(capfd):
    parent = rclpy.logging.get_logger("a")
    child, grandchild = parent.get_child("b"), parent.get_child("b").get_child("c")
    assert grandchild.name == "a.b.c"
    assert grandchild.get_effective_level() is LoggingSeverity.INFO
    parent.set_level(LoggingSeverity.ERROR)
    assert grandchild.get_effective_level() is LoggingSeverity.ERROR
    assert not grandchild.is_enabled_for(LoggingSeverity.WARN)
    child.set_level(LoggingSeverity.DEBUG)
    assert grandchild.is_enabled_for(LoggingSeverity.DEBUG)
    assert rclpy.logging.get_logger_level("a.b.c") is LoggingSeverity.UNSET
    child.set_level(LoggingSeverity.UNSET)
    assert grandchild.get_effective_level() is LoggingSeverity.ERROR
    assert rclpy.logging.get_logger_effective_level("ab") is LoggingSeverity.INFO
    rclpy.logging.set_logger_level("", LoggingSeverity.FATAL)
    assert rclpy.logging.get_logger_effective_level("ab") is LoggingSeverity.FATAL
    assert errors(capfd) == []


def test_the_root_logger_can_be_unset():
    root = rclpy.logging._root_logger
    assert rclpy.logging.get_logger_level("") is LoggingSeverity.INFO
    for severity in LoggingSeverity:
        root.set_level(severity)
        assert root.get_effective_level() is severity
        assert rclpy.logging.get_logger_effective_level("a.b") is severity


def test_a_program_may_add_a_filter(logger, capfd, monkeypatch):
    class EveryOther(rcutils_logger.LoggingFilter):
        params: ClassVar = {"every_other": None}

        @staticmethod
        def should_log(context):
            context["count"] = context.get("count", 0) + 1
            return context["count"] % 2 == 1

    monkeypatch.setitem(rcutils_logger.supported_filters, "every_other", EveryOther)
    written = [logger.info(str(number), every_other=True) for number in range(4)]
    assert written == [True, False, True, False]
    assert messages(capfd) == ["0", "2"]


def test_a_message_may_go_to_another_name(logger, capfd):
    logger.info("a", name=None)
    logger.info("b", name="other")
    assert re.findall(r"\[([\w.]+)\]: \w", capfd.readouterr().err) == [logger.name, "other"]


def test_errors_of_names_and_levels(logger):
    with pytest.raises(ValueError, match=r"^Logger name must not be empty\.$"):
        rclpy.logging.get_logger("")
    with pytest.raises(ValueError, match=r"^Child logger name must not be empty\.$"):
        logger.get_child("")
    for call in (
        lambda: logger.set_level(15),
        lambda: logger.log("x", 15),
        lambda: rclpy.logging.set_logger_level("x", 15),
    ):
        with pytest.raises(ValueError):
            call()
    assert rclpy.logging.get_logging_severity_from_string("warn") is LoggingSeverity.WARN
    with pytest.raises(RuntimeError, match="choose from UNSET, DEBUG, INFO, WARN, ERROR, FATAL"):
        rclpy.logging.get_logging_severity_from_string("loud")


def test_once_and_skip_first_belong_to_the_line(logger, capfd):
    for index in range(3):
        logger.info(f"once {index}", once=True)
        logger.info(f"other {index}", once=True)
        logger.info(f"skip {index}", skip_first=True)
        logger.info(f"both {index}", skip_first=True, once=True)
        logger.info(f"none {index}", once=False, skip_first=False)
    assert messages(capfd) == [
        "once 0",
        "other 0",
        "none 0",
        "skip 1",
        "both 1",
        "none 1",
        "skip 2",
        "none 2",
    ]


def test_a_logger_says_if_it_wrote_a_line(logger):
    assert [logger.info("x", once=True) for _ in range(2)] == [True, False]


class SettableClock(Clock):
    """A steady clock that shows what the test says."""

    def __new__(cls):
        self = super().__new__(cls, clock_type=ClockType.STEADY_TIME)
        self.now_ns = 10**9
        return self

    def _now_ns(self):
        return self.now_ns

    def now(self):
        return Time(nanoseconds=self.now_ns, clock_type=self.clock_type)


def test_throttle(logger, capfd):
    clock = SettableClock()
    for seconds in (1.0, 1.5, 1.99, 2.0, 2.5, 0.1, 0.2):
        clock.now_ns = int(seconds * 1e9)
        logger.info(str(seconds), throttle_duration_sec=1, throttle_time_source_type=clock)
    assert messages(capfd) == ["1.0", "2.0", "0.1"]


@pytest.mark.parametrize(
    ("keywords", "error", "text"),
    [
        ({"foo": 1}, TypeError, 'parameter "foo" is not one of the recognized logging options'),
        (
            {"throttle_time_source_type": Clock()},
            TypeError,
            'required parameter "throttle_duration_sec" not specified',
        ),
        (
            {"throttle_duration_sec": 1, "throttle_time_source_type": 5},
            ValueError,
            "is not a clock instance",
        ),
    ],
)
def test_wrong_options(logger, keywords, error, text):
    with pytest.raises(error, match=text):
        logger.info("x", **keywords)


@pytest.mark.parametrize(
    ("first", "second", "text"),
    [
        ({"severity": 20}, {"severity": 30}, "Logger severity cannot be changed between calls."),
        (
            {"severity": 20, "name": "a"},
            {"severity": 20, "name": "b"},
            "Logger name cannot be changed between calls.",
        ),
        (
            {"severity": 20, "once": True},
            {"severity": 20},
            "Requested logging filters cannot be changed between calls.",
        ),
        (
            {"severity": 20, "throttle_duration_sec": 1},
            {"severity": 20, "throttle_duration_sec": 2},
            "Logging filter parameters cannot be changed between calls.",
        ),
    ],
)
def test_a_line_must_not_change(logger, first, second, text):
    calls = iter((first, second))

    def same_line():
        logger.log("x", **next(calls))

    same_line()
    with pytest.raises(ValueError) as caught:
        same_line()
    assert str(caught.value) == text


@pytest.mark.parametrize(
    ("format_text", "line"),
    [
        ("{severity} {name} {message}", "WARN a.b text"),
        ("{time}|{time_as_nanoseconds}", "0000000001.000000002|0000000001000000002"),
        ("{function_name}@{file_name}:{line_number}", "run@/x.py:7"),
        (r"{message}\t{nope} {{message} {", "text\t{nope} {text {"),
        ("plain}", "plain}"),
    ],
)
def test_formats(format_text, line):
    record = log_output.LogRecord(10**9 + 2, 30, "a.b", "text", "/x.py", "run", 7)
    assert LineFormat(format_text).line(record) == line


def test_the_date(monkeypatch):
    monkeypatch.setenv("TZ", "UTC")
    time.tzset()
    record = log_output.LogRecord(86_400 * 10**9 + 5_000_000, 30, "a", "text", "", "", 0)
    assert LineFormat("{date_time_with_ms}").line(record) == "1970-01-02 00:00:00.005"


def test_the_caller_is_known(logger, monkeypatch, capfd):
    monkeypatch.setenv("RCUTILS_CONSOLE_OUTPUT_FORMAT", "{function_name} {file_name} {line_number}")
    log_output.configure(file=False)
    logger.info("x")
    line = sys._getframe().f_lineno - 1
    assert errors(capfd) == [f"test_the_caller_is_known {__file__} {line}"]


def test_colours(logger, monkeypatch, capfd):
    monkeypatch.setenv("RCUTILS_COLORIZED_OUTPUT", "1")
    monkeypatch.setenv("RCUTILS_CONSOLE_OUTPUT_FORMAT", "{message}")
    log_output.configure(file=False)
    logger.set_level(LoggingSeverity.DEBUG)
    logger.debug("x")
    logger.info("x")
    logger.warning("x")
    logger.error("x")
    logger.fatal("x")
    reset = "\033[0m"
    assert errors(capfd) == [
        f"\033[32mx{reset}",
        f"{reset}x{reset}",
        f"\033[33mx{reset}",
        f"\033[31mx{reset}",
        f"\033[31mx{reset}",
    ]


def test_stdout_and_wrong_values(logger, monkeypatch, capfd):
    monkeypatch.setenv("RCUTILS_LOGGING_USE_STDOUT", "1")
    monkeypatch.setenv("RCUTILS_LOGGING_BUFFERED_STREAM", "7")
    log_output.configure(file=False)
    logger.info("x")
    captured = capfd.readouterr()
    assert captured.out.endswith("]: x\n")
    assert (
        captured.err
        == "RCUTILS_LOGGING_BUFFERED_STREAM has the value '7', which is neither 0 nor 1: it is "
        "ignored.\n"
    )


def test_the_command_line_decides(logger, capfd):
    words = "--ros-args --log-level warn --log-level robot:=debug --disable-external-lib-logs"
    Arguments.parse(words.split()).configure_logging()
    logger.debug("shown")
    rclpy.logging.get_logger("other").info("hidden")
    assert messages(capfd) == ["shown"]
    Arguments.parse(
        ["--ros-args", "--disable-stdout-logs", "--disable-external-lib-logs"]
    ).configure_logging()
    logger.error("hidden")
    assert messages(capfd) == []


def test_a_configuration_file_is_ignored_with_a_warning(logger, capfd):
    Arguments.parse(
        ["--ros-args", "--log-config-file", "spdlog.conf", "--disable-external-lib-logs"]
    ).configure_logging()
    logger.info("shown")
    assert messages(capfd) == [
        "Configuration files of logging are not supported: 'spdlog.conf' is ignored",
        "shown",
    ]


def test_the_log_file(logger, tmp_path, monkeypatch, capfd):
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "a" / "b"))
    log_output.configure(file_prefix="robot")
    assert not (tmp_path / "a").exists()
    logger.info("first")
    logger.debug("hidden")
    logger.error("second")
    (path,) = (tmp_path / "a" / "b").iterdir()
    assert re.fullmatch(rf"robot_{os.getpid()}_\d{{13}}\.log", path.name)
    assert path.read_text() == capfd.readouterr().err
    rclpy.logging.shutdown()
    logger.info("third")
    assert len(path.read_text().splitlines()) == 2


def test_a_line_during_the_shutdown_reaches_no_other_file(logger, tmp_path, monkeypatch, capfd):
    """Another thread closes the log file, and opens a file, which may get the same descriptor."""
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path))
    others, write_line = [], log_output._write_line

    def write_after_shutdown(fd, line):
        if fd > 2 and not others:
            log_output.shutdown()
            others.append((tmp_path / "other").open("wb"))
        return write_line(fd, line)

    monkeypatch.setattr(log_output, "_write_line", write_after_shutdown)
    log_output.configure(file_prefix="robot")
    file = log_output._file
    logger.info("a")
    file.write("b")
    others[0].close()
    written = {path.name.partition("_")[0]: path.read_text() for path in tmp_path.iterdir()}
    assert written == {"other": "", "robot": capfd.readouterr().err}


def test_log_folder(monkeypatch, tmp_path):
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("ROS_LOG_DIR", "/x")
    assert str(rclpy.logging.get_logging_directory()) == "/x"
    monkeypatch.setenv("ROS_LOG_DIR", "")
    monkeypatch.setenv("ROS_HOME", "~/y")
    assert rclpy.logging.get_logging_directory() == tmp_path / "y" / "log"
    monkeypatch.delenv("ROS_HOME")
    assert rclpy.logging.get_logging_directory() == tmp_path / ".ros" / "log"


def test_a_log_directory_that_cannot_be_made_is_told_once(logger, tmp_path, monkeypatch, capfd):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "file" / "x"))
    log_output.configure()
    logger.info("one")
    logger.info("two")
    lines = errors(capfd)
    assert len(lines) == 3
    assert sum(line.startswith("No log file is written: ") for line in lines) == 1


def test_records_reach_the_sink_of_their_node(logger):
    records = []
    log_output.add_rosout_sink("robot.camera", records.append)
    try:
        logger.warning("own")
        logger.get_child("lens").info("child")
        rclpy.logging.get_logger("robot").info("parent")
        rclpy.logging.get_logger("robot.camera2").info("other")
    finally:
        log_output.remove_rosout_sink("robot.camera", records.append)
    logger.info("late")
    shown = [
        (record.severity, record.name, record.message, record.function_name, record.file_name)
        for record in records
    ]
    here = ("test_records_reach_the_sink_of_their_node", __file__)
    assert shown == [(30, "robot.camera", "own", *here), (20, "robot.camera.lens", "child", *here)]


def test_two_nodes_of_one_name_share_the_first_sink(logger, capfd):
    first, second = [], []
    log_output.add_rosout_sink("robot.camera", first.append)
    log_output.add_rosout_sink("robot.camera", second.append)
    (warning,) = errors(capfd)
    assert (
        "[rcl.logging_rosout]: Publisher already registered for node name: 'robot.camera'."
        in warning
    )
    log_output.remove_rosout_sink("robot.camera", second.append)
    logger.info("x")
    for _ in range(2):
        log_output.remove_rosout_sink("robot.camera", first.append)
    logger.info("y")
    assert (len(first), len(second)) == (1, 0)


def test_lines_of_threads_do_not_mix(logger, capfd):
    def work(name):
        for index in range(200):
            logger.info(f"{name}{index} " + name * 50)

    with ThreadPoolExecutor(4) as pool:
        list(pool.map(work, "abcd"))
    lines = messages(capfd)
    assert len(lines) == 800
    assert all(re.fullmatch(r"([abcd])\d+ \1{50}", line) for line in lines)


def test_once_is_once_for_all_threads(capfd):
    logger = RcutilsLogger("x")
    barrier = threading.Barrier(8)

    def work(_):
        barrier.wait()
        logger.info("only", once=True)

    with ThreadPoolExecutor(8) as pool:
        list(pool.map(work, range(8)))
    assert messages(capfd) == ["only"]


def test_a_closed_stream_does_not_end_the_program():
    program = (
        "import os; os.close(2); import rclpy.logging; "
        "print(rclpy.logging.get_logger('x').info('y'))"
    )
    run = run_python(program, timeout=300)
    assert run.stdout == "True\n"
