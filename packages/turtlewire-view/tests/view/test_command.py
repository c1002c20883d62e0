"""`turtlewire view`: its words, its address, and its end."""

import json
import signal
import socket
from urllib.request import urlopen

import pytest
from tests.bags import write_bag
from tests.places import TURTLEWIRE
from websockets.sync.client import connect

from .fake_view import decode_packet


@pytest.fixture
def view(run):
    def start(*words, **options):
        return run(TURTLEWIRE, "view", *words, **options)

    return start


def address_of(program):
    return program.wait_for(r"The view is at http(://127\.0\.0\.1:\d+/)")[0][1]


def end(program):
    program.process.send_signal(signal.SIGTERM)
    assert program.wait() == 0


def test_it_tells_its_address_serves_and_ends_at_ctrl_c(view):
    program = view("--port", "0", terminal=True)
    with connect(f"ws{address_of(program)}live", max_size=None) as page:
        assert decode_packet(page.recv())["source"]["kind"] == "live"
        program.type("\x03")
        assert program.wait() == 130
    assert "Traceback" not in program.text


def test_a_port_in_use_is_said(view):
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
        program = view("--port", str(port))
        assert not address_of(program).endswith(f":{port}/")
        end(program)
    assert program.text.startswith(f"Port {port} is in use: the view uses a free port\n")


def test_a_bag_is_shown_without_the_network(view, tmp_path):
    bag = write_bag(tmp_path / "made")
    program = view(bag, "--port", "0", environment={"ROS_DOMAIN_ID": "9999"})
    with connect(f"ws{address_of(program)}live", max_size=None) as page:
        assert decode_packet(page.recv())["source"] == {"kind": "bag", "name": "made"}
    end(program)


def test_a_robot_is_shown_with_meshes_of_a_named_package(view, tmp_path):
    mesh = "package://arm/tip.stl"
    (tmp_path / "tip.stl").write_text("tip")
    (tmp_path / "arm.urdf").write_text(
        f'<robot name="arm"><link name="base"><visual><geometry><mesh filename="{mesh}"/>'
        "</geometry></visual></link></robot>"
    )
    program = view(tmp_path / "arm.urdf", "--package", f"arm={tmp_path}", "--port", "0")
    address = address_of(program)
    with connect(f"ws{address}live", max_size=None) as page:
        page.send(json.dumps({"type": "add", "id": "a", "kind": "robot_model",
                              "topic": "/robot_description", "options": {}}))  # fmt: skip
        packets = map(decode_packet, page)
        robot = next(each for each in packets if each["type"] == "display")
    shown = robot["links"][0]["visuals"][0]["mesh"]
    assert shown == {"name": mesh, "url": "/mesh/arm/tip.stl"}
    with urlopen(f"http{address}mesh/arm/tip.stl") as answer:
        assert answer.read() == b"tip"
    end(program)


def test_a_fixed_frame_that_does_not_exist_is_hinted_at(view, tmp_path):
    bag = write_bag(tmp_path / "made")
    hint = "There is no frame 'bas_link'. Did you mean: base_link"
    program = view(bag, "--port", "0", "--fixed-frame", "bas_link")
    with connect(f"ws{address_of(program)}live", max_size=None) as page:
        packets = map(decode_packet, page)
        status = next(each for each in packets if each["type"] == "status")
    assert (status["level"], status["text"]) == ("warn", hint)
    end(program)
    assert program.text.startswith(f"{hint}\n")


def test_a_file_of_rviz_is_what_the_page_shows_first(view, tmp_path):
    file = tmp_path / "robot.rviz"
    file.write_text(
        "Visualization Manager:\n"
        "  Displays: [{Class: rviz_default_plugins/Path, Topic: {Value: /plan}}]\n"
        "  Global Options: {Fixed Frame: odom}\n"
    )
    program = view("-d", file, "--port", "0")
    with connect(f"ws{address_of(program)}live", max_size=None) as page:
        packets = [decode_packet(page.recv()) for _ in range(2)]
    (shown,) = packets[1]["displays"]
    assert (packets[1]["type"], packets[1]["fixed"], packets[1]["first"]) == ("view", "odom", True)
    assert (shown["kind"], shown["topic"]) == ("path", "/plan")
    end(program)


@pytest.mark.parametrize(
    ("words", "answer"),
    [
        (["-d", "none.rviz"], "none.rviz cannot be read: No such file or directory"),
        (["-d", __file__], "test_command.py is not an RViz view: "),
        (["--port", "99999"], "'99999' is not a port number, from 0 (any) to 65535"),
        (["--max-frames", "1"], "'1' is not a number of frames, at least 2"),
        (["--fixed-fram", "map"], "Did you mean: --fixed-frame"),
        (["no_such_bag"], "turtlewire view: "),
        (["robot.rviz"], "robot.rviz is not a bag. To load an RViz file: -d robot.rviz"),
        (["a", "b"], "unrecognized arguments: b"),
        (["none.urdf"], "none.urdf: No such file or directory"),
        (["no_robot"], "pip install 'turtlewire-view[robots]'"),
        (["a.urdf", "--topic", "/r/tf"], "--topic and --static-topic are for the network"),
        (["--package", "arm"], "argument --package: 'arm' is not NAME=FOLDER, such as arm=src/arm"),
    ],
)
def test_wrong_words(view, words, answer):
    program = view(*words)
    assert program.wait() == 2
    assert answer in program.text
    assert "Traceback" not in program.text


def test_two_views_have_names_of_their_own(view):
    first, second = view("--port", "0"), view("--port", "0")
    for program in (first, second):
        address_of(program)
    for program in (first, second):
        end(program)
        assert "another process runs a node" not in program.text


def test_rviz2_names_the_words_that_it_ignores(run):
    headless = {"TURTLEWIRE_PORT": "0", "TURTLEWIRE_BROWSER": "0"}
    words = ("run", "rviz2", "rviz2", "robot.rviz", "--no-such")
    program = run(TURTLEWIRE.parent / "ros2", *words, environment=headless)
    program.wait_for(r"ignored: robot\.rviz --no-such\. To show a file: -d robot\.rviz")
    program.wait_for(r"\[rviz2\]: The view is at http://")
    program.process.send_signal(signal.SIGINT)
    program.wait()
    assert "Traceback" not in program.text


def test_without_a_network_it_says_so(view):
    program = view("--port", "0", environment={"ROS_DOMAIN_ID": "9999"})
    assert program.wait() == 2
    assert program.text.startswith("turtlewire view: ")
    assert "Traceback" not in program.text
