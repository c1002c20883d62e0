"""Launch files in Python, and the errors for files that are not launch files."""

import pytest

from launch import LaunchDescription, LaunchDescriptionSource, LaunchIntrospector, LaunchService
from launch.actions import (
    DeclareLaunchArgument,
    EmitEvent,
    ExecuteProcess,
    GroupAction,
    IncludeLaunchDescription,
    LogInfo,
    RegisterEventHandler,
    Shutdown,
    TimerAction,
)
from launch.conditions import IfCondition
from launch.event_handlers import OnProcessExit
from launch.frontend import Parser
from launch.launch_description_sources import (
    AnyLaunchDescriptionSource,
    FrontendLaunchDescriptionSource,
    InvalidPythonLaunchFileError,
    PythonLaunchDescriptionSource,
    get_launch_description_from_python_launch_file,
)
from launch.substitutions import LaunchConfiguration


@pytest.fixture
def file(tmp_path):
    def write(name, content):
        path = tmp_path / name
        path.write_text(content)
        return str(path)

    return write


GOOD = """
from launch import LaunchDescription
from launch.actions import LogInfo

def generate_launch_description():
    return LaunchDescription([LogInfo(msg="from the file")])
"""


@pytest.mark.parametrize("source", [AnyLaunchDescriptionSource, PythonLaunchDescriptionSource])
def test_python(launch, file, tmp_path, source):
    path = file("x.launch.py", GOOD)
    assert launch(IncludeLaunchDescription(source(path))).messages == ["from the file"]
    assert [entry.name for entry in tmp_path.iterdir() if entry.name != "log"] == [
        "x.launch.py"
    ]  # no bytecode next to it
    source = source([str(tmp_path), "/", LaunchConfiguration("name", default="x.launch.py")])
    assert source.try_get_launch_description_without_context() is None
    assert source.location == f"'{tmp_path}' + '/' + LaunchConfig('name')"


def test_python_needs_no_parser_of_another_language(launch, file, tmp_path, monkeypatch):
    """A package whose parser cannot be imported fails only files that it might read."""
    (tmp_path / "others-1.0.dist-info").mkdir()
    entry = "[launch.frontend.parser]\ntoml = no_such_module:Parser\n"
    (tmp_path / "others-1.0.dist-info" / "entry_points.txt").write_text(entry)
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(Parser, "frontend_parsers", None)
    path = file("x.launch.py", GOOD)
    outcome = launch(IncludeLaunchDescription(AnyLaunchDescriptionSource(path)))
    assert outcome.messages == ["from the file"]
    outcome = launch(IncludeLaunchDescription(AnyLaunchDescriptionSource(file("x.toml", ""))))
    assert "No module named 'no_such_module'" in outcome.text


def test_python_without_the_function(file):
    path = file("x.launch.py", "x = 1")
    expected = (
        f"launch file at '{path}' does not contain the required function "
        "'generate_launch_description\\(\\)'"
    )
    with pytest.raises(InvalidPythonLaunchFileError, match=expected):
        get_launch_description_from_python_launch_file(path)


@pytest.mark.parametrize(
    ("name", "content", "errors"),
    [
        (
            "x.launch.py",
            "def f(:",
            [
                "SyntaxError: invalid syntax (x.launch.py, line 1)",
                "RuntimeError: Expected 'launch' as root tag",
            ],
        ),
        (
            "x.launch.py",
            "def generate_launch_description():\n    raise ValueError('boom')",
            ["ValueError: boom", "RuntimeError: Expected 'launch' as root tag"],
        ),
        (
            "x.launch.xml",
            "<launch>\n  <arg name='x'>\n</launch>",
            [
                (
                    "InvalidFrontendLaunchFileError: Caught exception when trying to load file of "
                    "format [xml]: "
                    "mismatched tag: line 3, column 2 (x.launch.xml, line 3)"
                ),
                "SyntaxError: invalid syntax (x.launch.xml, line 1)",
            ],
        ),
        (
            "x.launch.yaml",
            "launch:\n- log: {message: hello\n- log:",
            [
                (
                    "InvalidFrontendLaunchFileError: Caught exception when trying to load file of "
                    "format [yaml]: "
                    "expected ',' or '}', but got ':' (x.launch.yaml, line 3)"
                ),
                "SyntaxError: invalid syntax (x.launch.yaml, line 1)",
            ],
        ),
        (
            "x.launch.yaml",
            "- log",
            [
                (
                    "InvalidFrontendLaunchFileError: Caught exception when trying to load file of "
                    "format [yaml]: "
                    "Expected only one root element: a mapping with the key 'launch'"
                ),
                "NameError: name 'log' is not defined",
            ],
        ),
        ("x.launch.yaml", "start: []", ["RuntimeError: Expected 'launch' as root tag"]),
        (
            "x.launch.yaml",
            "launch:\n- jump: {}\n",
            ["RuntimeError: Unrecognized entity of the type: jump"],
        ),
    ],
)
def test_malformed_files(launch, file, name, content, errors):
    outcome = launch(IncludeLaunchDescription(file(name, content)))
    assert outcome.status == 1
    assert (
        outcome.error == "Caught multiple exceptions when trying to load file of format "
        f"[{name.rpartition('.')[2]}]:"
    )
    listed = [line.removeprefix(" - ") for line in outcome.lines if line.startswith(" - ")]
    assert listed[: len(errors)] == errors
    assert len(listed) == 2


def test_a_file_that_is_not_there(launch):
    assert launch(IncludeLaunchDescription("nowhere.launch.py")).error.endswith(
        "No such file or directory: 'nowhere.launch.py'"
    )


def test_text_of_another_encoding(launch, tmp_path):
    (tmp_path / "x.launch.xml").write_bytes(b"<launch>\xff</launch>")
    assert launch(IncludeLaunchDescription(str(tmp_path / "x.launch.xml"))).status == 1


def test_a_frontend_source_reads_all_languages(launch, file):
    path = file("x.launch.xml", "<launch><log message='hello'/></launch>")
    assert launch(IncludeLaunchDescription(FrontendLaunchDescriptionSource(path))).messages == [
        "hello"
    ]


def test_a_source_without_description_or_loader():
    service = LaunchService()
    with pytest.raises(NotImplementedError, match="without a launch description"):
        LaunchDescriptionSource(location="x").get_launch_description(service.context)


def test_a_deprecated_description_warns(launch, capsys):
    outcome = launch(LaunchDescription([], deprecated_reason="use the other"))
    assert (
        "[WARNING] [launch]: This LaunchDescription is deprecated: use the other" in outcome.lines
    )


def test_arguments_of_a_description_and_of_those_it_includes():
    inner = LaunchDescription([DeclareLaunchArgument("inner"), DeclareLaunchArgument("outer")])
    conditional = DeclareLaunchArgument("conditional", condition=IfCondition("true"))
    description = LaunchDescription(
        [
            DeclareLaunchArgument("outer"),
            IncludeLaunchDescription(LaunchDescriptionSource(inner)),
            TimerAction(period=1.0, actions=[DeclareLaunchArgument("later")]),
            conditional,
            GroupAction([DeclareLaunchArgument("grouped")]),
        ]
    )
    found = description.get_launch_arguments()
    assert [argument.name for argument in found] == [
        "outer",
        "inner",
        "later",
        "conditional",
        "grouped",
    ]
    assert [argument.name for argument in found if argument.conditionally_included] == [
        "later",
        "conditional",
    ]


def test_the_tree_of_a_description():
    process = ExecuteProcess(
        cmd=["echo", LaunchConfiguration("x")], env={"A": "b"}, on_exit=[Shutdown()]
    )
    description = LaunchDescription(
        [
            LogInfo(msg=["a ", LaunchConfiguration("x")]),
            TimerAction(
                period=2.0, actions=[EmitEvent(event=Shutdown().event), LogInfo(msg="later")]
            ),
            RegisterEventHandler(
                OnProcessExit(target_action=process, on_exit=[LogInfo(msg="ended")])
            ),
            process,
        ]
    )
    lines = LaunchIntrospector().format_launch_description(description).splitlines()
    assert lines[1] == "├── LogInfo('a ' + LaunchConfig('x'))"
    assert lines[2] == "├── Action('TimerAction(period='2.0', actions=<actions>)')"
    assert lines[3] == "│   └── after '2.0' sec"
    assert lines[4:6] == [
        "│       ├── EmitEvent(event='launch.events.Shutdown')",
        "│       └── LogInfo('later')",
    ]
    assert lines[6].startswith(
        "├── RegisterEventHandler('<launch.event_handlers.on_process_exit.OnProcessExit object at "
    )
    assert lines[7].startswith(
        "│   └── OnProcessExit(matcher='event == ProcessExited and event.action == "
        "<launch.actions.execute_process."
    )
    assert lines[8] == "│       └── LogInfo('ended')"
    assert (
        lines[9] == "└── ExecuteProcess(cmd=['echo', LaunchConfig('x')], cwd=None, env={'A': 'b'}, "
        "shell=False)"
    )
    assert lines[10].startswith(
        "    └── process '[[<launch.substitutions.text_substitution.TextSubstitution object at "
    )
    assert lines[11] == "        └── EmitEvent(event='launch.events.Shutdown')"


LATE = """
from launch import LaunchDescription
from launch.actions import OpaqueFunction

def late(context):
    return [][3]

def generate_launch_description():
    return LaunchDescription([OpaqueFunction(function=late)])
"""


@pytest.mark.parametrize(
    ("name", "content", "line"),
    [
        (
            "x.launch.py",
            "import os\n\ndef generate_launch_description():\n    return os.nope()\n",
            4,
        ),
        ("x.launch.py", "from launch import LaunchDescription\nimport nowhere_at_all\n", 2),
        ("x.launch.py", LATE, 6),
        ("x.launch.xml", "<launch>\n  <group>\n    <nope/>\n  </group>\n</launch>", 3),
        ("x.launch.xml", "<launch>\n  <log message='a' massage='b'/>\n</launch>", 2),
        ("x.launch.yaml", "launch:\n- log:\n    message: hello\n- let:\n    name: x\n", 4),
        ("x.launch.yaml", "launch:\n- group:\n  - nope: {}\n", 3),
    ],
)
def test_errors_in_files_are_named_with_their_lines(launch, file, name, content, line):
    path = file(name, content)
    outcome = launch(IncludeLaunchDescription(path))
    assert outcome.status == 1
    assert outcome.lines[-1] == f"  raised in {path}:{line}"


@pytest.mark.parametrize(
    ("result", "message", "hint"),
    [
        ("None", "returned None, not a LaunchDescription", "Its `return` is missing."),
        ("[1]", "returned [1], not a LaunchDescription", None),
        ("LaunchDescription", "LaunchDescription'>, not a LaunchDescription", None),
        ("LaunchDescription(['x'])", "contains 'x', which is not an action", None),
        (
            "LaunchDescription([(Shutdown(),)])",
            "which is not an action",
            "Remove the comma after the action.",
        ),
    ],
)
def test_a_file_that_returns_something_else_is_rejected(launch, file, result, message, hint):
    content = (
        "from launch import LaunchDescription\nfrom launch.actions import Shutdown\n\n"
        f"def generate_launch_description():\n    return {result}\n"
    )
    path = file("x.launch.py", content)
    lines = launch(IncludeLaunchDescription(path)).lines
    if hint:
        assert lines.pop() == hint
    assert f"in '{path}' " in lines[-1]
    assert lines[-1].endswith(message)


def test_the_innermost_line_of_a_file_is_named(launch, file):
    """Not the line that called the function in which the error was raised."""
    content = (
        "def outer():\n    inner()\n\ndef inner():\n    int('seven')\n\n"
        "def generate_launch_description():\n    outer()\n"
    )
    path = file("x.launch.py", content)
    assert launch(IncludeLaunchDescription(path)).lines[-1] == f"  raised in {path}:5"


def test_the_innermost_of_files_that_include_each_other_is_named(launch, file):
    inner = file("inner.launch.py", "def generate_launch_description():\n    int('seven')\n")
    outer = file(
        "outer.launch.py",
        "from launch import LaunchDescription\n"
        "from launch.actions import IncludeLaunchDescription, OpaqueFunction\n\n"
        "def include(context):\n"
        f"    return IncludeLaunchDescription({inner!r}).visit(context)\n\n"
        "def generate_launch_description():\n"
        "    return LaunchDescription([OpaqueFunction(function=include)])\n",
    )
    assert launch(IncludeLaunchDescription(outer)).lines[-1] == f"  raised in {inner}:2"


def test_errors_of_a_file_that_is_only_shown_are_named_with_their_lines(tmp_path, capsys):
    from ros2cli.main import main

    path = tmp_path / "x.launch.py"
    path.write_text("def generate_launch_description():\n    raise ValueError('boom')\n")
    for option in ("--show-args", "--print"):
        assert main(["launch", option, str(path)]) == 1
        assert capsys.readouterr().err.splitlines()[1:] == [
            " - ValueError: boom",
            " - RuntimeError: Expected 'launch' as root tag",
            f"  raised in {path}:2",
        ]
