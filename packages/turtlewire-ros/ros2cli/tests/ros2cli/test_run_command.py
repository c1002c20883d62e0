"""`ros2 run`: finding executables, and exit status."""

import signal
import sys

import pytest

from ros2cli.main import main


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


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP, signal.SIGINT])
def test_a_signal_to_ros2_run_ends_the_executable(run, package, number):
    package("stay", "#!/bin/sh\necho ready\nexec sleep 1000\n")
    program = run(
        sys.executable,
        "-c",
        "import sys; from ros2cli.main import main; sys.exit(main(['run', 'p', 'stay']))",
    )
    program.wait_for("ready")
    program.process.send_signal(number)
    assert program.wait() != 0
    assert program.survivors() == []
    assert "Traceback" not in program.text


@pytest.mark.parametrize("distro", ["jazzy", "kilted"])
@pytest.mark.parametrize(
    ("number", "name"),
    [(signal.SIGINT, "Interrupt"), (signal.SIGTERM, "Terminated"), (signal.SIGHUP, None)],
)
def test_the_signal_is_told_from_kilted_on(run, package, distro, number, name):
    package("stay", "#!/bin/sh\necho ready\nexec sleep 1000\n")
    program = run(
        sys.executable,
        "-c",
        "import sys; from ros2cli.main import main; sys.exit(main(['run', 'p', 'stay']))",
        environment={"ROS_DISTRO": distro},
    )
    program.wait_for("ready")
    program.process.send_signal(number)
    assert program.wait() != 0
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
