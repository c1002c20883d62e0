"""`ros2 extensions`, `ros2 extension_points` and `ros2 doctor hello`."""

import re
import socket
import sys
import time

import pytest

import rclpy
from ros2cli.entry_points import declared
from ros2cli.main import main
from ros2doctor.verb.hello import (
    HelloMulticastUDPReceiver,
    HelloMulticastUDPSender,
    HelloPublisher,
    HelloSubscriber,
    SummaryTable,
)

ROS2 = "from ros2cli.main import main; import sys; sys.exit(main(sys.argv[1:]))"


def test_every_command_and_verb_is_listed(capsys):
    assert main(["extensions"]) == 0
    listed = capsys.readouterr().out
    for command in declared("ros2cli.command"):
        assert f"\n  {command}: " in listed
    assert "ros2doctor.verb\n  hello: " in listed
    assert main(["extensions", "-v"]) == 0
    assert "    module: ros2topic.verb.echo\n" in capsys.readouterr().out


def test_every_extension_point_is_listed(capsys):
    assert main(["extension_points"]) == 0
    points = capsys.readouterr().out.splitlines()
    assert main(["extensions"]) == 0
    titles = [line for line in capsys.readouterr().out.splitlines() if line[0] != " "]
    assert [point.partition(":")[0] for point in points] == titles


def test_the_table_counts_other_hosts(capsys):
    table = SummaryTable()
    table.increment_send()
    table.increment_send()
    table.increment_pub()
    table.increment_sub("mars")
    table.increment_receive("moon")
    table.increment_receive("moon")
    table.format_print_summary("/canyouhearme", 1.0)
    shown = capsys.readouterr().out
    assert shown.startswith(
        "Greetings in 1.0 s: 1 published, 2 sent\nTopic /canyouhearme: heard 1 other hosts\n"
    )
    assert re.search(r"mars +1\n", shown)
    assert "\nGroup 225.0.0.1:49150: heard 1 other hosts\n" in shown
    assert re.search(r"moon +2\n", shown)
    table.reset()
    table.format_print_summary("/canyouhearme", 1.0)
    assert "heard 0 other hosts" in capsys.readouterr().out


def test_greetings_of_other_hosts_are_counted(monkeypatch, capsys):
    ours, theirs = SummaryTable(), SummaryTable()
    with rclpy.init():
        node = rclpy.create_node("hello")
        monkeypatch.setattr("socket.gethostname", lambda: "mars")
        publisher = HelloPublisher(node, "hear_me", theirs)
        monkeypatch.undo()
        subscription = HelloSubscriber(node, "hear_me", ours)
        end = time.monotonic() + 60
        shown = ""
        while "mars" not in shown and time.monotonic() < end:
            publisher.publish()
            rclpy.spin_once(node, timeout_sec=0.1)
            ours.format_print_summary("hear_me", 1)
            shown = capsys.readouterr().out
        assert "Topic hear_me: heard 1 other hosts\n    mars" in shown
        publisher.destroy()
        subscription.destroy()


def test_datagrams_of_other_hosts_are_counted(monkeypatch, capsys):
    table = SummaryTable()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    receiver = HelloMulticastUDPReceiver(table, port=port, timeout=60)
    sender = HelloMulticastUDPSender(table, port=port, ttl=1)
    sender.send()
    receiver.recv()  # our own
    with monkeypatch.context() as moved:
        moved.setattr("socket.gethostname", lambda: "mars")
        sender.send()
    receiver.recv()
    receiver.shutdown()
    sender.shutdown()
    table.format_print_summary("/x", 1, port=port)
    shown = capsys.readouterr().out
    assert "Greetings in 1 s: 0 published, 2 sent\nTopic /x: heard 0 other hosts\n" in shown
    assert re.search(rf"Group 225.0.0.1:{port}: heard 1 other hosts\n    mars +1\n", shown)


def test_hello_ends_after_a_table(run):
    verb = run(sys.executable, "-c", ROS2, "doctor", "hello", "--once", "-pp", "0.2")
    verb.wait()
    assert verb.process.returncode == 0 or "Network is unreachable" in verb.text, verb.text


def test_unknown_options_show_the_usage_of_the_verb(capsys):
    with pytest.raises(SystemExit) as end:
        main(["topic", "list", "--nope"])
    assert end.value.code == 2
    told = capsys.readouterr().err
    assert told.startswith("usage: ros2 topic list [-h]")
    assert "ros2 topic list: error: unrecognized arguments: --nope" in told
