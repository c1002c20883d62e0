"""`SECURITY.md` is true: each of its points has tests, which the table below names."""

from __future__ import annotations

import io
import os
import re
import sys
from pathlib import Path

import numpy as np
import pytest
import yaml
from tests.places import ROOT
from tests.test_compatibility import functions_of, table

from turtlewire import Buffer, msg
from turtlewire.bag.definitions import learn_types
from turtlewire.errors import InterfaceError, TurtlewireError

PAGE = ROOT / "SECURITY.md"

# Beginning of a sentence, and below it its tests.
TESTED = """
Nodes discover other nodes on this computer only
  wire/test_environment.py test_the_range_is_localhost_unless_said_otherwise
  wire/test_two_hosts.py test_other_hosts_cannot_reach_nodes_by_default
  wire/test_two_hosts.py test_datagrams_from_outside_reach_no_socket_by_default
  wire/test_two_hosts.py test_zenoh_follows_no_call_from_outside_by_default
  wire/test_two_hosts.py test_static_peers_find_the_other_host_without_multicast
The web servers of turtlesim, the 3D view and the class listen on loopback only
  web/test_lan.py test_without_the_option_only_loopback_is_bound_and_no_token_needed
  web/test_server.py test_foreign_names_and_pages_are_refused
With `--lan` they serve the network
  web/test_lan.py test_every_route_demands_the_token test_with_it_every_address_answers_to_the_token
  web/test_lan.py test_two_runs_have_two_tokens
In a notebook of JupyterHub, Binder or Colab
  web/test_lan.py test_behind_a_proxy_only_loopback_is_bound
  view/test_remote_notebook.py test_a_hub_shows_the_view_in_an_isolated_output
  view/test_remote_notebook.py test_colab_shows_the_port_and_path_of_the_view
Every request needs a random token, and a WebSocket
  web/test_lan.py test_behind_a_proxy_any_host_needs_the_token
  web/test_lan.py test_behind_a_proxy_only_own_pages_open_the_websocket
  view/test_remote_notebook.py test_a_request_without_the_token_gets_403
  view/test_remote_notebook.py test_a_foreign_page_cannot_connect
Browsers embed such a view only in pages of that host
  view/test_remote_notebook.py test_a_foreign_page_with_the_token_cannot_embed_the_view
  view/test_remote_notebook.py test_colab_and_no_foreign_page_embeds_the_view
In other notebooks, only pages of this computer
  view/test_notebook.py test_a_notebook_at_another_port_shows_the_view
  view/test_notebook.py test_a_page_of_another_computer_cannot_embed_the_view
  view/test_notebook.py test_a_page_around_a_notebook_cannot_embed_the_view
The Foxglove server listens on loopback only
  foxglove/test_hostile.py test_a_foreign_name_is_refused_with_one_line
It refuses requests with another `Host`
  foxglove/test_hostile.py test_a_foreign_name_is_refused_with_one_line
  foxglove/test_hostile.py test_other_pages_are_refused_with_one_line
  foxglove/test_hostile.py test_pages_of_foxglove_and_of_this_machine_connect
`turtlewire mcp` speaks on stdin and stdout
  cli/test_mcp.py test_it_listens_on_no_port test_a_drive_that_is_ended_stops_the_robot
They can read, and publish to and call only what `--allow` names
  cli/test_mcp.py test_without_allow_nothing_is_changed test_the_assistant_does_what_is_allowed
  cli/test_assistant_limits.py test_names_are_allowed_as_a_whole_or_by_their_beginning
Limits hold for the calls in a minute
  cli/test_mcp.py test_too_many_calls_are_refused test_a_long_message_is_cut
  cli/test_mcp.py test_wrong_names_and_numbers_are_explained
  cli/test_mcp.py test_a_drive_that_is_ended_stops_the_robot
The daemon of `ros2 daemon start` listens on loopback only
  ros2cli/test_daemon.py test_any_program_may_ask_but_no_web_page
  ros2cli/test_daemon.py test_the_port_is_that_of_the_domain
  ros2cli/test_api.py test_only_this_host_may_call
`scripts/docs --serve` and `scripts/lesson --serve`
  site/test_static_server.py test_foreign_names_and_pages_are_refused
They list no folders
  site/test_static_server.py test_nothing_outside_the_folder_is_served test_folders_are_not_listed
Bytes from the network are checked
  wire/test_bad_input.py test_a_malformed_message_is_named_once_and_the_next_good_one_arrives
Names and strings from other processes are escaped
  terminal/test_printable.py test_no_character_leaves_a_control_behind
  ros2cli/test_output.py test_every_verb_is_escaped test_messages_on_stderr_are_escaped
Parameter files, bags, saved buffers, URDF and `.rviz` files are data
  test_security.py test_no_python_objects_come_out_of_yaml
  test_security.py test_a_buffer_of_pickled_objects_is_refused
  test_security.py test_a_definition_in_a_bag_cannot_hold_code
  urdf/test_parser.py test_entities_are_refused
During grading, a student's code can reach neither the checks nor their results
  turtle_class/test_forging.py test_an_attack_gives_no_points
  turtle_class/test_forging.py test_the_processes_of_the_graders_are_closed
DDS traffic is neither encrypted nor authenticated
  wire/test_two_hosts.py test_subnet_range_finds_the_other_host
  wire/test_two_hosts.py test_the_sockets_of_wider_ranges_hear_all_interfaces
On macOS and Windows, and on Linux before 5.7 without root
  wire/test_loopback.py test_a_kernel_that_refuses_is_warned_of
  wire/test_loopback.py test_new_sockets_at_the_domain_s_ports_are_bound
Otherwise use a network that you trust, a VPN, or [Zenoh with TLS]
  wire/zenoh/test_security.py test_the_commands_of_each_section_work
  wire/zenoh/test_security.py test_a_peer_without_a_certificate_sees_nothing
  wire/zenoh/test_security.py test_no_user_and_password
  wire/zenoh/test_security.py test_the_student_hears_and_does_not_speak
SROS 2 is not supported
  wire/test_security.py test_no_program_starts_in_the_clear
With `ROS_SECURITY_ENABLE=true` turtlewire warns
  wire/test_security.py test_permissive_security_is_warned_of_once
  wire/test_security.py test_no_program_starts_in_the_clear
A page that `--lan` opens is not encrypted
  web/test_lan.py test_with_it_every_address_answers_to_the_token
With another `--address`, the Foxglove server is not protected by a token
  foxglove/test_hostile.py test_all_names_are_served_to_the_network_and_to_all_pages
  foxglove/test_command.py test_an_address_for_others_is_said_plainly
The output of a cell with such a view contains its token
  view/test_remote_notebook.py test_the_output_of_a_hub_has_the_token_only_in_addresses
  view/test_remote_notebook.py test_the_link_opens_the_view_in_a_tab
An assistant that uses `turtlewire mcp`
  cli/test_mcp.py test_it_reads_and_subscribes_only_while_it_reads test_transforms
  cli/test_mcp.py test_a_long_message_is_cut
Names and texts of the robot's programs may contain instructions
  cli/test_mcp.py test_the_assistant_does_what_is_allowed
Launch files are programs
  test_security.py test_launching_a_file_runs_its_code
`ros2 launch --show-args` and `--print` run the code of Python files only
  ros2cli/test_launch_and_run.py test_arguments_are_shown_without_running_code
  test_security.py test_showing_the_arguments_of_a_python_file_runs_it
Xacro files evaluate expressions
  robots/test_urdf_tutorial.py test_xacro_finds_the_packages_of_the_workspace
Grading is not a sandbox
  test_security.py test_grading_runs_as_this_user
"""
#: The tests of each sentence.
BY_SENTENCE = table(TESTED)
# Advice, which nothing can test.
ADVICE = ("Run and open only files that you trust", "See [what remains]", "Clear the outputs")


def sentences() -> list[str]:
    """The sentences of the page, each in one line."""
    text = PAGE.read_text(encoding="utf-8").partition("## Supported")[0]
    points = re.split(r"^- |^#.*$", text, flags=re.MULTILINE)
    lines = [" ".join(point.split()) for point in points]
    split = [sentence for line in lines for sentence in re.split(r"(?<=\.) (?=[A-Z`])", line)]
    return [sentence for sentence in split if sentence and not sentence.startswith(ADVICE)]


def test_every_sentence_has_its_tests():
    for sentence in sentences():
        assert sum(sentence.startswith(beginning) for beginning in BY_SENTENCE) == 1, sentence
    assert len(sentences()) == len(BY_SENTENCE)
    assert all(BY_SENTENCE.values())


@pytest.mark.parametrize(
    ("file", "name"), sorted({pair for pairs in BY_SENTENCE.values() for pair in pairs})
)
def test_the_tests_are_there(file, name):
    assert name in functions_of(file)


# What no other room tests


@pytest.fixture
def ran(tmp_path, monkeypatch):
    """A file that hostile content would make, in the working folder."""
    monkeypatch.chdir(tmp_path)
    return tmp_path / "ran"


def test_no_python_objects_come_out_of_yaml(ran, tmp_path):
    from rclpy.parameter import parameter_dict_from_yaml_file
    from turtlewire.bag.reader import open_bag
    from turtlewire_view.rviz_file import RvizFileError, read_rviz

    hostile = "!!python/object/apply:pathlib.Path.touch [!!python/object/apply:pathlib.Path [ran]]"
    file = tmp_path / "metadata.yaml"
    file.write_text(f"/**: {{ros__parameters: {{a: {hostile}}}}}")
    with pytest.raises((RuntimeError, yaml.YAMLError)):
        parameter_dict_from_yaml_file(str(file))
    file.write_text(f"rosbag2_bagfile_information: {hostile}")
    with pytest.raises(TurtlewireError):
        open_bag(tmp_path)
    with pytest.raises(RvizFileError):
        read_rviz(f"Panels: {hostile}")
    assert not ran.exists()


class Touch:
    def __reduce__(self):
        return Path.touch, (Path("ran"),)


def test_a_buffer_of_pickled_objects_is_refused(ran, tmp_path):
    data = io.BytesIO()
    np.savez(data, header=np.array([Touch()], dtype=object))
    (tmp_path / "buffer.npz").write_bytes(data.getvalue())
    with pytest.raises(ValueError, match="is not a saved buffer"):
        Buffer.load(tmp_path / "buffer.npz")
    assert not ran.exists()


TOUCH = "__import__('pathlib').Path('ran').touch()"
PYTHON = f"""
from launch import LaunchDescription
def generate_launch_description():
    {TOUCH}
    return LaunchDescription()
"""


@pytest.mark.parametrize(
    ("text", "is_refused"),
    [
        (f"int32 x={TOUCH}", True),
        (f"int32 {TOUCH}", True),
        (f"int32 x {TOUCH}", True),
        (f"int32[{TOUCH}] x", True),
        (f"string<={TOUCH} x", True),
        (f"int32[] x [{TOUCH}]", True),
        (f"string x \"'+{TOUCH}+'\"", False),
        (f'string x "\\\\"+{TOUCH}#"', False),
        (f"string X='+{TOUCH}+'", False),
        (f'string x \'"""+{TOUCH}+"""\'', False),
    ],
)
def test_a_definition_in_a_bag_cannot_hold_code(ran, request, text, is_refused):
    name = f"hostile_msgs/msg/T{abs(hash(request.node.name))}"
    if is_refused:
        with pytest.raises(InterfaceError):
            learn_types(name, text)
    else:
        learn_types(name, text)
        kind = msg.get_message(name)
        assert msg.deserialize(kind, msg.serialize(kind())) == kind()
    assert not ran.exists()


@pytest.mark.parametrize(
    "content",
    [
        "<let name='a' value=\"$(command 'touch ran')\"/>",
        f'<let name="a" value="$(eval &quot;{TOUCH}&quot;)"/>',
        '<include file="$(dirname)/b.launch.py"/>',
    ],
)
def test_launching_a_file_runs_its_code(ran, tmp_path, content):
    from launch import LaunchService
    from launch.actions import IncludeLaunchDescription
    from launch.launch_description_sources import AnyLaunchDescriptionSource

    file = tmp_path / "a.launch.xml"
    file.write_text(f"<launch>{content}</launch>")
    (tmp_path / "b.launch.py").write_text(PYTHON)
    service = LaunchService(noninteractive=True)
    service.include_launch_description(
        IncludeLaunchDescription(AnyLaunchDescriptionSource(str(file)))
    )
    assert service.run() == 0
    assert ran.exists()


@pytest.mark.parametrize("option", ["--show-args", "--print"])
def test_showing_the_arguments_of_a_python_file_runs_it(ran, tmp_path, option):
    from ros2cli.main import main

    (tmp_path / "b.launch.py").write_text(PYTHON)
    assert main(["launch", "b.launch.py", option]) == 0
    assert ran.exists()


@pytest.mark.skipif(sys.platform == "win32", reason="Windows knows no numbers of users")
def test_grading_runs_as_this_user(tmp_path):
    from turtle_class.catalogue import chosen
    from turtle_class.runner import Limits, Runner

    (static,) = chosen(["static"])
    (name,) = static.files
    (tmp_path / name).write_text("import os\nprint('user', os.getuid())\n", encoding="utf-8")
    outcome = Runner(Limits(seconds=250.0)).run(static, tmp_path, 99)
    assert f"user {os.getuid()}\n" in outcome.log
