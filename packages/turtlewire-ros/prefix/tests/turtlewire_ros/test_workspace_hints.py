"""Hints about packages and files of a workspace that are not found."""

from importlib.metadata import entry_points

import pytest

from ros2cli.main import main
from turtlewire_ros import workspace_hints
from turtlewire_ros.rqt import equivalent
from turtlewire_ros.workspace_hints import executable_hint, file_hint, package_hint, path_hint

MANIFEST = "<package><name>{}</name><version>0.0.0</version></package>"
ELSEWHERE = (
    "If it is in a workspace of yours, source the install/setup.bash there, after colcon build"
)
SETUP = """entry_points={'console_scripts': ['hello = p.hello:main']}"""


class Workspace:
    """A workspace with the package `p`, whose files are written as colcon would."""

    def __init__(self, root, *, merged=False):
        self.root = root
        self.source = root / "src" / "deeper" / "p"
        self.install = root / "install"
        self.prefix = self.install if merged else self.install / "p"
        self.write(self.source / "package.xml", MANIFEST.format("p"))
        self.write(self.source / "setup.py", SETUP)
        self.write(root / "src" / "other" / "package.xml", MANIFEST.format("pp"))

    @staticmethod
    def write(path, text=""):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def build(self):
        self.write(self.install / ".colcon_install_layout", "isolated")
        self.write(self.install / "COLCON_IGNORE")
        self.write(self.install / "setup.bash")
        self.write(self.prefix / "share/p/package.xml", MANIFEST.format("p"))
        self.write(self.prefix / "share/ament_index/resource_index/packages/p")


@pytest.fixture(params=[False, True], ids=["isolated", "merged"])
def workspace(tmp_path, monkeypatch, request):
    root = tmp_path / "ws"
    root.mkdir()
    monkeypatch.chdir(root)
    monkeypatch.delenv("AMENT_PREFIX_PATH", raising=False)
    return Workspace(root, merged=request.param)


@pytest.fixture
def sourced(workspace, monkeypatch):
    workspace.build()
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(workspace.prefix))
    return workspace


def test_a_package_that_is_not_built(workspace):
    assert package_hint("p") == (
        "'p' is in src/deeper/p, but it is not built: "
        "colcon build --packages-select p && source install/setup.bash"
    )


def test_a_package_that_is_built_and_not_sourced(workspace, monkeypatch, capsys):
    workspace.build()
    hint = "'p' is built in install, but this shell does not know it: source install/setup.bash"
    assert package_hint("p") == hint
    assert main(["run", "p", "hello"]) == 1
    assert capsys.readouterr().err == f"Package 'p' not found\n{hint}\n"
    assert main(["launch", "p", "x.launch.py"]) == 1
    assert capsys.readouterr().err.splitlines()[-1] == hint
    monkeypatch.chdir(workspace.source)  # where students edit
    assert package_hint("p").endswith(f": source {workspace.install / 'setup.bash'}")
    monkeypatch.chdir(workspace.root.parent)
    assert package_hint("p").endswith(f": source {workspace.root.name}/install/setup.bash")


def test_a_package_of_a_workspace_that_was_moved(workspace, monkeypatch):
    """`colcon build --symlink-install` fails there until its folders are removed."""
    workspace.build()
    marker = workspace.prefix / "share/ament_index/resource_index/packages/p"
    marker.unlink()
    marker.symlink_to(workspace.root.parent / "old ws/build/p/resource/p")
    again = "rm -rf build install && colcon build --symlink-install && source install/setup.bash"
    assert package_hint("p").endswith(f" was removed. Type: {again}")
    moved = workspace.root.rename(workspace.root.parent / "new ws")
    monkeypatch.chdir(moved.parent)
    assert package_hint("p").endswith(f" was removed. Type: cd 'new ws' && {again}")


def test_a_package_whose_marker_is_not_installed(workspace):
    workspace.build()
    (workspace.prefix / "share/ament_index/resource_index/packages/p").unlink()
    assert "data_files of setup.py needs ('share/ament_index" in package_hint("p")


def test_a_package_that_nobody_has(workspace, monkeypatch):
    assert package_hint("nothing_of_this_name") == ELSEWHERE
    assert package_hint("turtlesm").startswith("Did you mean: turtlesim")
    ignored = workspace.root / "src" / "COLCON_IGNORE"
    ignored.touch()
    assert package_hint("p") == ELSEWHERE
    gone = workspace.root / "gone"
    gone.mkdir()
    monkeypatch.chdir(gone)
    gone.rmdir()
    assert package_hint("nothing_of_this_name") == ELSEWHERE


@pytest.mark.parametrize("package", ["my_turtle", "turtle_follow", "turtle_tf"])
def test_a_package_of_a_workspace_elsewhere_is_not_taken_for_turtlesim(workspace, package):
    assert package_hint(package) == ELSEWHERE


def test_the_tutorials_package_by_the_name_that_ros_2_gives_it(workspace, monkeypatch):
    install = workspace.root / "tutorial"
    for package in ("learning_tf2_py", "my_turtle"):
        workspace.write(install / "share/ament_index/resource_index/packages" / package)
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(install))
    assert package_hint("turtle_tf2_py").endswith(" in the package learning_tf2_py")
    monkeypatch.setattr(workspace_hints, "package_prefix", lambda _: None)
    assert package_hint("turtle_tf2_py") == ELSEWHERE


def test_a_program_of_cpp_that_was_left_out(sourced, capsys):
    index = sourced.prefix / "share/ament_index/resource_index"
    sourced.write(index / "turtlewire_compiled_targets/p", "library\ntalker")
    hint = (
        "talker is a C++ program, which turtlewire does not compile. Run it on a computer with "
        "ROS 2: its nodes and yours discover each other"
    )
    assert main(["run", "p", "talker"]) == 1
    assert capsys.readouterr().err == f"No executable found\n{hint}\n"
    assert executable_hint("p", "talkr") == "Did you mean: talker"


def test_a_file_that_is_not_installed(sourced, capsys):
    sourced.write(sourced.source / "launch" / "x.launch.py")
    hint = (
        "src/deeper/p/launch/x.launch.py exists, but it is not installed. setup.py needs "
        "('share/p/launch', ['launch/x.launch.py']) in data_files; then type: "
        "colcon build --packages-select p"
    )
    assert file_hint("p", "x.launch.py") == hint
    assert main(["launch", "p", "x.launch.py"]) == 1
    assert capsys.readouterr().err == (
        "file 'x.launch.py' was not found in the share directory of package 'p' which is at "
        f"'{sourced.prefix}/share/p'\n{hint}\n"
    )
    assert path_hint(f"{sourced.prefix}/share/p/launch/x.launch.py") == hint
    assert path_hint("/nowhere/x.launch.py") == path_hint("x.launch.py") == ""
    assert file_hint("p", "y.launch.py") == ""
    sourced.write(sourced.source / "CMakeLists.txt")
    assert "install(DIRECTORY launch DESTINATION" in file_hint("p", "x.launch.py")


def test_a_missing_file_in_a_launch_file(sourced, launch):
    from launch.actions import IncludeLaunchDescription
    from launch.launch_description_sources import PythonLaunchDescriptionSource
    from launch_ros.actions import Node

    sourced.write(sourced.source / "launch" / "x.launch.py")
    path = f"{sourced.prefix}/share/p/launch/x.launch.py"
    for included in path, PythonLaunchDescriptionSource(path):
        outcome = launch(IncludeLaunchDescription(included))
        assert any("setup.py needs ('share/p/launch'" in line for line in outcome.lines)
    sourced.write(sourced.source / "config" / "x.yaml")
    node = Node(
        package="turtlesim",
        executable="mimic",
        prefix="echo",  # in its place
        parameters=[f"{sourced.prefix}/share/p/config/x.yaml"],
    )
    outcome = launch(node)
    assert any("setup.py needs ('share/p/config'" in line for line in outcome.lines)


def test_an_executable_that_is_not_installed(sourced, monkeypatch, capsys):
    sourced.write(sourced.source / "p" / "two.py")
    hint = (
        "src/deeper/p/p/two.py exists, but it is not installed. setup.py needs "
        "'two = p.two:main' in console_scripts; then type: colcon build --packages-select p"
    )
    assert executable_hint("p", "two") == executable_hint("p", "two.py") == hint
    assert main(["run", "p", "two"]) == 1
    assert capsys.readouterr().err == f"No executable found\n{hint}\n"
    monkeypatch.chdir(sourced.source)
    assert executable_hint("p", "two").endswith(
        f"type: cd {sourced.root} && colcon build --packages-select p"
    )
    sourced.write(sourced.source / "CMakeLists.txt")
    assert "CMakeLists.txt needs install(PROGRAMS p/two.py DESTIN" in executable_hint("p", "two")


def test_an_executable_of_a_newer_source(sourced):
    assert executable_hint("p", "hello").startswith(
        "src/deeper/p/setup.py names 'hello', but the installed package is older."
    )
    assert executable_hint("p", "hell") == ""


def test_an_executable_that_went_to_bin(sourced):
    sourced.write(sourced.prefix / "bin" / "hello")
    assert "setup.cfg needs, below [install]: install_scripts=$base/lib/p" in executable_hint(
        "p", "hello"
    )


@pytest.mark.parametrize("program", ["rqt", "rqt_graph", "rqt_of_someone"])
def test_programs_of_rqt_name_what_shows_the_same(workspace, program, capsys):
    assert main(["run", program, program]) == 1
    error = capsys.readouterr().err
    assert error.startswith(f"Package '{program}' not found\nturtlewire has no {program}. Use ")
    assert "turtlewire" in error


def test_programs_of_rqt_are_commands_that_say_so(monkeypatch, capsys):
    scripts = entry_points(group="console_scripts")
    commands = {script.name for script in scripts if script.value == "turtlewire_ros.rqt:main"}
    assert {"rqt", "rqt_graph", "rqt_console", "rqt_plot", "rqt_tf_tree"} <= commands
    for name in commands:
        monkeypatch.setattr("sys.argv", [f"/bin/{name}"])
        (script,) = (script for script in scripts if script.name == name)
        assert script.load()() == 1
        assert capsys.readouterr().err == f"{equivalent(name)}\n"
        assert equivalent(name) != equivalent("rqt_unknown").replace("rqt_unknown", name) or (
            name == "rqt"
        )
    assert equivalent("turtlesim") == ""
    assert [script.value for script in scripts if script.name == "rviz2"] == ["rviz2.rviz2:main"]
