"""`ros2bag.api`, `ros2run.api`, `ros2pkg.api` and `ros2launch.api`."""

import argparse
import io

import pytest

from ros2bag import api as bag
from ros2bag.verb.play import PlayVerb
from ros2interface.verb.show import ReadStdinPipe
from ros2launch import api as launch
from ros2launch.api.api import get_launch_file_paths, parse_launch_arguments
from ros2pkg import api as pkg
from ros2run import api as run
from ros2topic.verb.list import ListVerb
from ros2topic.verb.pub import read_msg_from_yaml


def test_values_of_bag(tmp_path):
    assert bag.check_positive_float("0.5") == 0.5
    assert bag.check_not_negative_int("0") == 0
    for check, text in (
        (bag.check_positive_float, "0"),
        (bag.check_not_negative_float, "-1"),
        (bag.check_not_negative_int, "1.5"),
        (bag.check_path_exists, str(tmp_path / "none")),
    ):
        with pytest.raises(argparse.ArgumentTypeError):
            check(text)
    assert bag.convert_service_to_service_event_topic(["/a"]) == ["/a/_service_event"]
    assert bag.dict_to_duration({"sec": 1, "nsec": 5}).nanoseconds == 1_000_000_005
    with pytest.raises(ValueError, match="both seconds and nanoseconds"):
        bag.dict_to_duration({"sec": 1})
    profiles = bag.convert_yaml_to_qos_profile({"/tf": {"depth": 3}})
    assert profiles["/tf"].depth == 3
    with pytest.raises(ValueError, match="depht"):
        bag.interpret_dict_as_qos_profile({"depht": 3})
    assert bag.create_bag_directory(str(tmp_path / "new")) is None
    assert bag.create_bag_directory(str(tmp_path / "new")).startswith("[ERROR] [ros2bag]: ")


def test_executables(capfd):
    path = run.get_executable_path(package_name="urdfdom", executable_name="check_urdf")
    assert path in pkg.get_executable_paths(package_name="urdfdom")
    assert run.get_executable_path(package_name="urdfdom", executable_name="none") is None
    with pytest.raises(pkg.PackageNotFound):
        pkg.get_executable_paths(package_name="no_such_package")
    assert pkg.get_prefix_path("urdfdom") in path
    assert "urdfdom" in pkg.get_package_names()
    assert run.run_executable(path=path, argv=["no_such_file.urdf"]) != 0
    assert "[ros2run]: Process exited with failure" in capfd.readouterr().out


def test_launch_files(tmp_path, capsys):
    file = tmp_path / "some.launch.xml"
    file.write_text('<launch><arg name="speed" default="2" description="how fast"/></launch>')
    assert launch.is_launch_file(str(file))
    assert not launch.is_launch_file("some.urdf")
    assert get_launch_file_paths(path=str(tmp_path)) == [str(file)]
    assert parse_launch_arguments(["a:=1", "a:=2"]) == [("a", "2")]
    launch.print_arguments_of_launch_file(launch_file_path=str(file))
    assert "'speed':\n        how fast\n        (default: '2')" in capsys.readouterr().out
    with pytest.raises(FileNotFoundError, match="file 'none' was not found in the share"):
        launch.get_share_file_path_from_package(package_name="urdfdom", file_name="none")
    assert (
        launch.launch_a_launch_file(
            launch_file_path=str(file), launch_file_arguments=["speed:=3"], noninteractive=True
        )
        == 0
    )


def test_the_messages_in_a_file(tmp_path):
    path = tmp_path / "points.yaml"
    path.write_text("{x: 1}\n---\n---\n{x: 2}\n")
    assert list(read_msg_from_yaml(str(path))) == [{"x": 1}, {"x": 2}]
    with pytest.raises(RuntimeError, match=r"Cannot read .*: No such file"):
        list(read_msg_from_yaml(str(tmp_path / "none.yaml")))


class Terminal(io.StringIO):
    def isatty(self):
        return True


def test_an_argument_is_read_from_stdin(monkeypatch, capsys):
    parser = argparse.ArgumentParser()
    parser.add_argument("type", nargs="?", action=ReadStdinPipe)
    assert parser.parse_args([]).type is None
    assert parser.parse_args(["std_msgs/msg/String"]).type == "std_msgs/msg/String"
    monkeypatch.setattr("sys.stdin", io.StringIO("std_msgs/msg/Bool\nmore\n"))
    assert parser.parse_args(["-"]).type == "std_msgs/msg/Bool"
    for stdin, error in ((io.StringIO(), "value is empty"), (Terminal(), "expected stdin pipe")):
        monkeypatch.setattr("sys.stdin", stdin)
        with pytest.raises(SystemExit):
            parser.parse_args(["-"])
        assert error in capsys.readouterr().err


def test_topics_as_a_verbose_list():
    info = [("/a", ["x/msg/A"], 1, 0), ("/b", ["x/msg/A", "x/msg/B"], 2, 3)]
    assert ListVerb.show_topic_info(info, True) == (
        "Published topics:\n * /a [x/msg/A] 1 publisher\n * /b [x/msg/A, x/msg/B] 2 publishers\n"
    )
    assert ListVerb.show_topic_info(info, False) == (
        "Subscribed topics:\n * /b [x/msg/A, x/msg/B] 3 subscribers\n"
    )


def test_a_playback_ends_at_the_time_in_seconds_or_nanoseconds():
    until = PlayVerb().get_playback_until_from_arg_group
    assert until(1.5, -1) == 1_500_000_000
    assert until(-1.0, 7) == 7
    assert until(-1.0, -1) == -1
