"""The command line of `ros2 launch`."""

import pytest

from ros2cli.main import main, make_parser
from ros2launch.command import launch


def parsed(*words):
    return make_parser(["launch", *words]).parse_args(["launch", *words])


def test_a_path_comes_with_its_arguments(tmp_path):
    file = tmp_path / "a.launch.py"
    file.touch()
    assert launch._file_and_arguments(parsed(str(file), "x:=1", "y:=2")) == (
        str(file),
        ["x:=1", "y:=2"],
    )
    assert launch._file_and_arguments(parsed(str(file))) == (str(file), [])


def test_a_file_of_a_package_is_found_below_its_share_folder(tmp_path, monkeypatch):
    share = tmp_path / "share" / "p" / "launch"
    share.mkdir(parents=True)
    index = tmp_path / "share/ament_index/resource_index/packages"
    index.mkdir(parents=True)
    (index / "p").touch()
    (share / "a.launch.py").touch()
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    assert launch._file_and_arguments(parsed("p", "a.launch.py", "x:=1")) == (
        str(share / "a.launch.py"),
        ["x:=1"],
    )
    with pytest.raises(
        RuntimeError, match=r"was not found in the share directory[\s\S]*Did you mean: a.launch.py"
    ):
        launch._file_and_arguments(parsed("p", "b.launch.py"))
    (tmp_path / "share/p/other").mkdir()
    (tmp_path / "share/p/other/a.launch.py").touch()
    with pytest.raises(
        RuntimeError, match=r"was found more than once in the share directory of package 'p': \['"
    ):
        launch._file_and_arguments(parsed("p", "a.launch.py"))


def test_the_last_of_equal_arguments_counts():
    assert launch.parsed_arguments(["x:=1", "y:=a:=b", "x:=2"]) == [("x", "2"), ("y", "a:=b")]


@pytest.mark.parametrize("word", ["x", "x=1", ":=1", "x:="])
def test_malformed_arguments(word):
    with pytest.raises(
        RuntimeError, match=r"^malformed launch argument '.*', expected format '<name>:=<value>'$"
    ):
        launch.parsed_arguments([word])


def test_a_path_that_is_not_there(capsys):
    assert main(["launch", "./nope.launch.py"]) == 1
    assert capsys.readouterr().err == "No launch file at './nope.launch.py'\n"


def test_a_file_without_arguments_says_so(tmp_path, capsys):
    file = tmp_path / "a.launch.py"
    file.write_text(
        "from launch import LaunchDescription\ndef generate_launch_description():\n    return "
        "LaunchDescription([])\n"
    )
    assert main(["launch", str(file), "-s"]) == 0
    assert (
        capsys.readouterr().out
        == "Arguments (pass arguments as '<name>:=<value>'):\n\n  No arguments.\n"
    )


def error_of(capsys, *words):
    try:
        status = main(["launch", *words])
    except SystemExit as end:
        status = end.code
    assert status in (1, 2)
    return capsys.readouterr().err.splitlines()


def test_a_path_that_is_nearly_right(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "demo.launch.py").touch()
    assert error_of(capsys, "./deom.launch.py")[1] == "Did you mean: demo.launch.py"
    assert error_of(capsys, "deom.launch.py")[1] == "Did you mean: demo.launch.py"
    assert error_of(capsys, "nowhere/demo.launch.py") == [
        "No launch file at 'nowhere/demo.launch.py'"
    ]
    assert error_of(capsys, ".") == ["'.' is a folder", "Launch files there: demo.launch.py"]


def test_a_package_alone_lists_its_launch_files(capsys):
    assert error_of(capsys, "turtlesim")[-1] == "Launch files there: multisim.launch.py"
    assert error_of(capsys, "turtlesm")[-2:] == [
        "Package 'turtlesm' not found",
        "Did you mean: turtlesim",
    ]


def test_one_character_of_an_argument_is_missing(tmp_path, capsys):
    (tmp_path / "a.launch.py").touch()
    path = str(tmp_path / "a.launch.py")
    assert error_of(capsys, path, "x=1")[1:] == ["Did you mean: x:=1"]
    assert error_of(capsys, path, "x:=")[1:] == []
    assert error_of(capsys, path, "word")[1:] == []


def test_print_shows_named_nodes_as_ros_does(tmp_path, capsys):
    file = tmp_path / "a.launch.py"
    file.write_text(
        """
from launch import LaunchDescription
from launch_ros.actions import Node

def generate_launch_description():
    node = Node(
        package="turtlesim", executable="mimic", name="m", namespace="n", arguments=["a"],
        ros_arguments=["--log-level", "debug"], remappings=[("x", "y")], parameters=[{"p": 1}],
    )
    return LaunchDescription([node, Node(package="turtlesim", executable="mimic")])
"""
    )
    assert main(["launch", str(file), "-p"]) == 0
    mimic = "ExecInPkg(pkg='turtlesim', exec='mimic')"
    named = f"{mimic}, 'a', '--ros-args', '--log-level', 'debug', '-r', LocalVar('node name')"
    assert capsys.readouterr().out.splitlines()[1:] == [
        f"├── ExecuteProcess(cmd=[{named}], cwd=None, env=None, shell=False)",
        f"└── ExecuteProcess(cmd=[{mimic}, '--ros-args'], cwd=None, env=None, shell=False)",
    ]


@pytest.mark.parametrize(
    ("package", "executable", "meant"),
    [("turtlesm", "mimic", "turtlesim"), ("turtlesim", "mimik", "mimic")],
)
def test_names_in_a_launch_file_that_are_nearly_right(launch, package, executable, meant):
    from launch_ros.actions import Node

    outcome = launch(Node(package=package, executable=executable))
    assert outcome.lines[-1] == f"Did you mean: {meant}"


RUNS = {
    "launch.xml": """<launch>
  <arg name="a" default="$(eval '__import__(&quot;pathlib&quot;).Path(&quot;ran&quot;).touch()')"/>
  <arg name="b" default="x $(command 'touch ran')"/>
  <arg name="c" default="turtle1"/>
  <arg name="d" default="$(env HOME)" description="$(eval 1)"/>
  <let name="e" value="$(command 'touch ran')"/>
  <include file="$(command 'touch ran')"/>
  <group if="$(eval '__import__(&quot;pathlib&quot;).Path(&quot;ran&quot;).touch()')">
    <node pkg="p" exec="$(command 'touch ran')" name="$(command 'touch ran')"/>
  </group>
</launch>""",
    "launch.yaml": """launch:
- arg:
    name: a
    default: "$(eval '__import__(\\"pathlib\\").Path(\\"ran\\").touch()')"
- arg: {name: b, default: "x $(command 'touch ran')"}
- arg: {name: c, default: turtle1}
- arg: {name: d, default: $(env HOME)}
- let: {name: e, value: "$(command 'touch ran')"}
- include: {file: "$(command 'touch ran')"}
""",
}


@pytest.mark.parametrize("suffix", RUNS)
def test_arguments_are_shown_without_running_code(tmp_path, monkeypatch, capsys, suffix):
    monkeypatch.chdir(tmp_path)
    (tmp_path / f"x.{suffix}").write_text(RUNS[suffix], encoding="utf-8")
    for option in ("--print", "--show-args"):
        assert main(["launch", f"x.{suffix}", option]) == 0
        shown = capsys.readouterr().out
    assert not (tmp_path / "ran").exists()
    defaults = [line.strip() for line in shown.splitlines() if "(default: " in line]
    assert defaults[1:] == [
        "(default: 'x ' + Command('touch ran'))",
        "(default: 'turtle1')",
        "(default: EnvVar('HOME'))",
    ]
    assert defaults[0].startswith("(default: PythonExpr('__import__(")
