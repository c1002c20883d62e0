"""The command line of `ros2 launch`; executables and exit status of `ros2 run`."""

import signal
import sys

import pytest
from tests.programs import ROS2

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


# `ros2 run`.


@pytest.fixture
def package(tmp_path, monkeypatch):
    index = tmp_path / "share/ament_index/resource_index/packages"
    index.mkdir(parents=True)
    (index / "p").touch()
    library = tmp_path / "lib/p"
    library.mkdir(parents=True)
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))

    def add(name, text):
        script = library / name
        script.parent.mkdir(exist_ok=True)
        script.write_text(text)
        script.chmod(0o755)

    return add


def test_arguments_are_passed_and_the_status_comes_back(package, capfd):
    package("show", '#!/bin/sh\necho got "$@"\nexit 3\n')
    assert main(["run", "p", "show", "--ros-args", "-r", "a:=b"]) == 3
    assert (
        capfd.readouterr().out
        == "got --ros-args -r a:=b\n[ros2run]: Process exited with failure 3\n"
    )


def test_a_signal_is_named(package, capfd):
    package("die", "#!/bin/sh\nkill -TERM $$\n")
    assert main(["run", "p", "die"]) == -15
    assert capfd.readouterr().out == "[ros2run]: Terminated\n"


@pytest.mark.parametrize("distro", ["jazzy", "kilted"])
@pytest.mark.parametrize(
    ("number", "name"),
    [(signal.SIGINT, "Interrupt"), (signal.SIGTERM, "Terminated"), (signal.SIGHUP, None)],
)
def test_a_signal_ends_the_executable_and_is_told_from_kilted_on(
    run, package, distro, number, name
):
    package("stay", "#!/bin/sh\necho ready\nexec sleep 1000\n")
    program = run(*ROS2, "run", "p", "stay", environment={"ROS_DISTRO": distro})
    program.wait_for("ready")
    program.process.send_signal(number)
    assert program.wait() != 0
    assert program.survivors() == []
    assert "Traceback" not in program.text
    told = [line for line in program.text.splitlines() if "Received" in line]
    is_told = name is not None and distro == "kilted"
    assert told == ([f"[ros2run]: Received signal:  {name}"] if is_told else [])


def test_python_scripts_run_on_this_interpreter(package, capfd):
    package("which", "#!/nowhere/bin/python3\nimport sys\nprint(sys.executable)\n")
    assert main(["run", "p", "which"]) == 0
    assert capfd.readouterr().out.strip() == sys.executable


@pytest.mark.parametrize(
    ("option", "value", "error"),
    [
        (
            "-r",
            "foo",
            (
                "Couldn't parse remap rule: '-r foo'. Error: Expected lexeme type (19) not found, "
                "search ended at index 3"
            ),
        ),
        (
            "--params-file",
            "/nope.yaml",
            (
                "Couldn't parse params file: '--params-file /nope.yaml'. Error: Error opening YAML "
                "file"
            ),
        ),
        (
            "--params-file",
            "broken.yaml",
            (
                "Couldn't parse params file: '--params-file broken.yaml'. Error: "
                "Sequence should be of same type. Value type 'string' do not belong at line_num 3"
            ),
        ),
    ],
)
def test_a_bad_command_line_of_a_node_is_told_in_one_line(
    tmp_path, monkeypatch, capfd, option, value, error
):
    (tmp_path / "broken.yaml").write_text("/**:\n  ros__parameters:\n    a: [1, b]\n")
    monkeypatch.chdir(tmp_path)
    assert main(["run", "tf2_ros", "static_transform_publisher", "--ros-args", option, value]) == 1
    told = capfd.readouterr().err
    assert told.rstrip().endswith(error)
    assert "Traceback" not in told


def test_a_prefix_comes_before_the_executable(package, capfd):
    package("x", "#!/bin/sh\n")
    assert main(["run", "--prefix", "echo before", "p", "x"]) == 0
    assert capfd.readouterr().out.startswith("before ")


def test_missing_items(package, capfd):
    package("turtle", "#!/bin/sh\n")
    assert main(["run", "nope_pkg_x", "y"]) == 1
    error, hint = capfd.readouterr().err.splitlines()
    assert error == "Package 'nope_pkg_x' not found"
    assert "source the install/setup.bash there" in hint
    assert main(["run", "p", "trutle"]) == 1
    assert capfd.readouterr().err == "No executable found\nDid you mean: turtle\n"


def test_executables_of_one_name(package, capfd):
    package("x", "#!/bin/sh\n")
    package("deeper/x", "#!/bin/sh\n")
    assert main(["run", "p", "x"]) == 1
    assert capfd.readouterr().err.startswith("Multiple executables found:\n- ")
