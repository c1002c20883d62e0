"""Destinations and formats of log lines."""

import os
import re
import sys

import pytest

from launch import LaunchDescription, LaunchService, logging
from launch.actions import ExecuteProcess, LogInfo
from launch.logging import config


@pytest.fixture(autouse=True)
def fresh(monkeypatch, tmp_path):
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "log"))
    logging.reset()
    yield
    logging.reset()


def test_default_folder(monkeypatch):
    monkeypatch.setenv("ROS_LOG_DIR", "/elsewhere")
    assert logging.default_log_dir() == "/elsewhere"
    monkeypatch.delenv("ROS_LOG_DIR")
    monkeypatch.setenv("ROS_HOME", "/home/turtle")
    assert logging.default_log_dir() == "/home/turtle/log"
    monkeypatch.delenv("ROS_HOME")
    assert logging.default_log_dir() == os.path.expanduser("~/.ros/log")


def test_a_folder_that_cannot_be_made_is_named_with_the_remedy(tmp_path):
    blocked = tmp_path / "file"
    blocked.touch()
    with pytest.raises(
        RuntimeError, match=r"cannot make the log folder .*Not a directory.*ROS_LOG_DIR"
    ):
        config.make_launch_log_dir(str(blocked / "log"))


def test_each_launch_has_a_folder_and_the_last_one_a_link(launch, tmp_path):
    first, second = launch(LogInfo(msg="one")), launch(LogInfo(msg="two"))
    assert first.log_dir != second.log_dir
    assert re.fullmatch(rf"\d{{4}}(-\d\d){{5}}-\d{{6}}-.+-{os.getpid()}", second.log_dir.name)
    link = tmp_path / "log" / "latest"
    assert link.is_symlink()
    assert link.resolve() == second.log_dir
    assert "[INFO] [launch.user]: two" in (link / "launch.log").read_text()


def test_the_main_file_may_have_another_name(tmp_path):
    for name in ("demo.log", "launch.log"):
        hello = ExecuteProcess(cmd=[sys.executable, "-c", "print('hello')"], output="log")
        service = LaunchService(noninteractive=True, log_file_name=name)
        service.include_launch_description(LaunchDescription([hello]))
        assert service.run() == 0
        written = (tmp_path / "log" / "latest" / name).read_text()
        assert "process started with pid" in written
        assert "hello" in written


def test_files_have_times_and_the_screen_has_none(launch):
    outcome = launch(LogInfo(msg="hello"))
    assert "[INFO] [launch.user]: hello" in outcome.lines
    assert re.search(
        r"^\d{10}\.\d{7} \[INFO\] \[launch\.user\]: hello$",
        (outcome.log_dir / "launch.log").read_text(),
        re.MULTILINE,
    )


def test_the_environment_sets_formats(launch, monkeypatch):
    monkeypatch.setenv("OVERRIDE_LAUNCH_SCREEN_FORMAT", "{levelname}/{message}")
    monkeypatch.setenv("OVERRIDE_LAUNCH_LOG_FORMAT", "LOG {message}")
    outcome = launch(LogInfo(msg="hello"))
    assert "INFO/hello" in outcome.lines
    assert "LOG hello\n" in (outcome.log_dir / "launch.log").read_text()


def test_times_on_the_screen(launch, monkeypatch):
    monkeypatch.setenv("OVERRIDE_LAUNCH_SCREEN_FORMAT", "default_with_timestamp")
    outcome = launch(LogInfo(msg="hello"), ExecuteProcess(cmd=["echo", "there"], output="screen"))
    assert re.search(
        r"^\d{10}\.\d{7} \[INFO\] \[launch\.user\]: hello$", outcome.text, re.MULTILINE
    )
    assert re.search(r"^\d{10}\.\d{7} \[echo-\d+\] there$", outcome.text, re.MULTILINE)


@pytest.mark.parametrize(
    ("style", "layout"), [("%", "<%(message)s>"), ("$", "<${message}>"), ("{", "<{message}>")]
)
def test_styles_of_formats(capsys, style, layout):
    logging.launch_config.set_screen_format(layout, screen_style=style)
    logging.launch_config.set_log_format(layout, log_style=style)
    try:
        logging.get_logger("launch.styles").warning("hello")
        path = logging.launch_config.get_log_file_path()
        assert capsys.readouterr().out == "<hello>\n"
        with open(path) as file:
            assert file.read().endswith("<hello>\n")
    finally:
        logging.reset()
    with pytest.raises(ValueError, match="the style of a log format is"):
        logging.launch_config.set_screen_format("x", screen_style="?")


@pytest.mark.parametrize(
    ("layout", "style", "error"),
    [
        (
            "nofields",
            None,
            r"'nofields' is not a log format of the style '\{', as '\{message\}' is",
        ),
        ("%(message)s", None, r"'%\(message\)s' is not a log format of the style '\{'"),
        (
            "{message}",
            "%",
            r"'\{message\}' is not a log format of the style '%', as '%\(message\)s'",
        ),
        ("default", "%", "the format 'default' has its own style"),
        ("default_with_timestamp", "{", "the format 'default_with_timestamp' has its own style"),
    ],
)
def test_formats_that_are_wrong_are_refused_at_once(capsys, layout, style, error):
    with pytest.raises(ValueError, match=error):
        logging.launch_config.set_screen_format(layout, screen_style=style)
    with pytest.raises(ValueError, match=error):
        logging.launch_config.set_log_format(layout, log_style=style)
    logging.get_logger("launch.formats").warning("as before")
    assert capsys.readouterr().out == "[WARNING] [launch.formats]: as before\n"


def test_a_named_format_after_one_of_another_style(capsys):
    try:
        logging.launch_config.set_screen_format("%(message)s", screen_style="%")
        logging.launch_config.set_screen_format("default")
        logging.get_logger("launch.named").warning("hello")
        assert capsys.readouterr().out == "[WARNING] [launch.named]: hello\n"
    finally:
        logging.reset()


def test_the_folder_can_be_chosen_before_its_first_use(tmp_path):
    logging.launch_config.log_dir = str(tmp_path / "mine")
    logging.get_logger("launch.test").warning("hello")
    assert "hello" in (tmp_path / "mine" / "launch.log").read_text()
    with pytest.raises(RuntimeError, match="already in use"):
        logging.launch_config.log_dir = str(tmp_path / "other")


def test_loggers_of_launch_files(capsys):
    logging.get_logger("my_file").info("hello")
    assert capsys.readouterr().out == "[INFO] [my_file]: hello\n"


def test_the_log_folder_cannot_be_made(ros2_launch, tmp_path):
    (tmp_path / "file").touch()
    launch = ros2_launch("", environment={"ROS_LOG_DIR": str(tmp_path / "file")})
    assert launch.wait() == 1
    assert "Traceback" not in launch.text
    assert str(tmp_path / "file") in launch.text


@pytest.mark.parametrize(("no_color", "level"), [("", "\033[33mWARNING\033[0m"), ("1", "WARNING")])
def test_colours_on_a_terminal(ros2_launch, no_color, level):
    content = """
from launch import LaunchDescription
from launch.logging import get_logger

def generate_launch_description():
    get_logger("mine").warning("careful")
    return LaunchDescription([])
"""
    launch = ros2_launch(content, terminal=True, environment={"NO_COLOR": no_color})
    assert launch.wait() == 0
    assert f"[{level}] [mine]: careful" in launch.text


def test_handlers_with_a_format_for_each_logger():
    import io
    import logging
    from logging import handlers as standard

    from launch.logging import handlers

    stream = io.StringIO()
    handler = handlers.StreamHandler(stream)
    assert isinstance(handler, logging.StreamHandler)
    assert handlers.StreamHandler is type(handler)
    assert issubclass(handlers.RotatingFileHandler, standard.RotatingFileHandler)
    first, second = (logging.getLogger(f"handlers_{name}") for name in ("first", "second"))
    handler.setFormatter(logging.Formatter("all %(message)s"))
    handler.setFormatterFor(first, logging.Formatter("own %(message)s"))
    for logger in (first, second):
        logger.propagate = False
        logger.addHandler(handler)
        logger.warning("x")
    handler.unsetFormatterFor(first)
    handler.unsetFormatterFor(second)
    first.warning("y")
    assert stream.getvalue() == "own x\nall x\nall y\n"
    for name in ("Nothing", "Logger"):
        with pytest.raises(AttributeError, match=f"has no attribute '{name}'"):
            getattr(handlers, name)


def test_the_main_file_is_named_on_the_command_line(ros2_launch, tmp_path):
    content = """
from launch import LaunchDescription
from launch.actions import LogInfo

def generate_launch_description():
    return LaunchDescription([LogInfo(msg="careful")])
"""
    launch = ros2_launch(content, "-f", "demo")
    assert launch.wait() == 0
    assert "careful" in (tmp_path / "log" / "latest" / "demo.log").read_text()
    assert not (tmp_path / "log" / "latest" / "launch.log").exists()
