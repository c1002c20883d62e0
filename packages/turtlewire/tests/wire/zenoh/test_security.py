"""The commands of docs/how-to/secure_networks.md, and the errors of wrong settings."""

from __future__ import annotations

import os
import re
import shutil
import socket
import subprocess
import sys
from typing import TYPE_CHECKING

import pytest
from tests.places import HOW_TO, LEARNING, PATH

from turtlewire.wire.zenoh.router import explain

from ..hosts import DEMO, PEERS, delete_namespaces, ip, namespace

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = [
    pytest.mark.skipif(
        shutil.which("openssl") is None, reason="needs openssl (Debian: apt install openssl)"
    ),
    pytest.mark.skipif(shutil.which("bash") is None, reason="the page's commands are bash"),
]

PAGE = HOW_TO / "secure_networks.md"
TLS, MUTUAL = "TLS", "Mutual TLS"
USER, ACCESS = "User and password", "Access control"
LEVELS = [TLS, MUTUAL, USER, ACCESS]
LIMIT_S = 60


def blocks() -> list[tuple[str, str, str]]:
    """Each block of commands: its section, what its first line calls it, and the commands."""
    found, section = [], ""
    for part in re.split(
        r"^(## [^\n]*|```bash\n.*?^```)$", PAGE.read_text(), flags=re.MULTILINE | re.DOTALL
    ):
        if part.startswith("## "):
            section = part[3:]
        elif part.startswith("```"):
            commands = part.removeprefix("```bash\n").removesuffix("```")
            found.append((section, commands.splitlines()[0].removeprefix("# "), commands))
    return found


def commands(name: str, upto: str = ACCESS) -> str:
    """The blocks of that name, from the first section to ``upto``."""
    sections = ["Certificates", *LEVELS[: LEVELS.index(upto) + 1]]
    return "\n".join(
        text for section, called, text in blocks() if called == name if section in sections
    )


def environment(**more: str) -> dict[str, str]:
    path = PATH
    return {**os.environ, "PATH": path, "PYTHONUNBUFFERED": "1", **more}


AUTHORITY = """[ca]
default_ca = here
[here]
database = signed.txt
new_certs_dir = .
default_md = sha256
policy = names
rand_serial = yes
[names]
commonName = supplied
"""


def sign(folder: Path, name: str, authority: str, end: str) -> None:
    """One more certificate; valid from 2020 to ``end``, which `openssl x509` cannot have passed."""
    new, _ = commands("certificates").split("new ca ", 1)
    (folder / "authority.cnf").write_text(AUTHORITY)
    script = f"""{new}
test -e {authority}.pem || new {authority} -x509 -days 9 -out {authority}.pem
new {name} -out {name}.csr
touch signed.txt
openssl ca -batch -notext -config authority.cnf -cert {authority}.pem -keyfile {authority}.key \\
    -startdate 20200101000000Z -enddate {end} -in {name}.csr -out {name}.pem \\
    -extfile <(echo subjectAltName=DNS:{name})"""
    subprocess.run(["bash", "-euc", script], cwd=folder, check=True, capture_output=True)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with the certificates of the page, and some that are wrong."""
    made = tmp_path_factory.mktemp("keys")
    script = f"set -eu\n{commands('certificates')}"
    subprocess.run(["bash", "-c", script], cwd=made, check=True, capture_output=True)
    sign(made, "mallory", "otherca", end="20491231000000Z")
    sign(made, "late", "ca", end="20200102000000Z")
    return made


@pytest.fixture
def port():
    with socket.create_server(("127.0.0.1", 0)) as free:
        return str(free.getsockname()[1])


@pytest.fixture
def router(run, folder, port):
    """Starts the page's router with the settings up to a section."""

    def start(upto: str, change: str = ""):
        script = "\n".join([commands("router", upto), change, commands("start the router")])
        program = run(
            *("bash", "-c", script.replace("7447", port)), environment=environment(), cwd=folder
        )
        program.wait_for("Started Zenoh router")
        return program

    return start


@pytest.fixture
def client(folder, port):
    """The script of a client with the settings up to a section."""

    def script(upto: str, command: str = "ros2 node list", change: str = "") -> str:
        use = commands("use the client").replace("ros2 node list", command)
        return "\n".join([commands("client", upto), change, use]).replace("7447", port)

    return script


@pytest.fixture
def ended(folder):
    """Runs a script to its end."""

    def run_it(script: str, **variables: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            ["bash", "-c", script],
            cwd=folder,
            env=environment(**variables),
            capture_output=True,
            text=True,
            timeout=LIMIT_S,
            check=False,
        )

    return run_it


@pytest.mark.parametrize("side", ["router", "client"])
def test_the_settings_are_one_line_each(ended, side):
    show = 'for setting in "${SETTINGS[@]}"; do printf "%s" "$setting" | wc -l; done'
    counted = ended(f"{commands(side)}\n{show}").stdout.split()
    assert counted == ["0"] * len(counted)
    assert len(counted) == {"router": 9, "client": 8}[side]


@pytest.mark.parametrize("level", LEVELS)
def test_the_commands_of_each_section_work(level, router, client, run, ended, folder):
    router(level)
    talker = client(level, "ros2 run demo_nodes_py talker")
    run("bash", "-c", talker, environment=environment(), cwd=folder)
    heard = ended(client(level, "ros2 topic echo --once /chatter std_msgs/msg/String"))
    assert "data: 'Hello World" in heard.stdout, heard.stderr


def test_a_peer_without_a_certificate_sees_nothing(router, client, run, ended, folder):
    refusing = router(MUTUAL)
    talker = client(MUTUAL, "ros2 run demo_nodes_py talker")
    run("bash", "-c", talker, environment=environment(), cwd=folder)
    ended(client(MUTUAL, "ros2 topic echo --once /chatter std_msgs/msg/String"))
    assert ended(client(MUTUAL)).stdout == "/talker\n"
    without = ended(client(TLS))
    assert without.returncode == 1
    assert without.stdout == ""
    assert (
        "the other side requires a certificate (mutual TLS), but none was presented"
        in without.stderr
    )
    refusing.wait_for("refused a connection: it presents no certificate")
    beside = ended("ros2 node list", RMW_IMPLEMENTATION="rmw_zenoh_cpp")
    assert (beside.returncode, beside.stdout) == (0, "")


def with_certificate(name: str) -> str:
    return (
        f'SETTINGS+=("$TLS/connect_certificate=\\"$PWD/{name}.pem\\"" '
        f'"$TLS/connect_private_key=\\"$PWD/{name}.key\\"")'
    )


@pytest.mark.parametrize(
    ("level", "change", "said", "router_said"),
    [
        (
            MUTUAL,
            with_certificate("mallory"),
            "the other side does not know the authority that signed .*/mallory.pem",
            "its certificate is not signed by an authority",
        ),
        (MUTUAL, with_certificate("late"), "late.pem has expired", "its certificate has expired"),
        (
            MUTUAL,
            'SETTINGS+=("$TLS/root_ca_certificate=\\"$PWD/otherca.pem\\"")',
            "the certificate of the other side is not signed by .*/otherca.pem",
            "it does not know the authority that signed this router's certificate",
        ),
        (
            MUTUAL,
            with_certificate("nobody"),
            "nobody.pem cannot be read: No such file or directory",
            None,
        ),
        (
            MUTUAL,
            'SETTINGS+=("$TLS/connect_private_key=\\"$PWD/router.key\\"")',
            "alice.pem and .*/router.key are not a matching certificate and key",
            None,
        ),
        (
            TLS,
            "SETTINGS+=('connect/endpoints=[\"tls/127.0.0.1:7447\"]')",
            "the certificate of the other side is for another name than 127.0.0.1",
            None,
        ),
        (
            TLS,
            "SETTINGS+=('connect/endpoints=[\"tls/localhost:1\"]')",
            r"tls/localhost:1: no connection \(Connection refused\)",
            None,
        ),
        (
            TLS,
            "SETTINGS+=('connect/endpoints=[\"tcp/localhost:7447\"]')",
            "the peer at that address opened no session",
            "refused a connection without TLS",
        ),
        (
            USER,
            "SETTINGS+=('transport/auth/usrpwd/password=\"looking-glass\"')",
            "the other side rejects user 'alice' with this password",
            "its user and password are not in the file",
        ),
    ],
)
def test_each_fault_is_one_line_with_a_remedy(
    level, change, said, router_said, router, client, ended, port
):
    refusing = router(level)
    failed = ended(client(level, change=change.replace("7447", port)))
    assert failed.returncode == 1
    line, remedy = failed.stderr.splitlines()
    assert re.match(rf"cannot open a Zenoh session: .*{said}", line)
    assert remedy
    if router_said:
        refusing.wait_for(re.escape(router_said), timeout=LIMIT_S)


@pytest.mark.parametrize(
    "program", ["ros2 run demo_nodes_py talker", "python -c 'import rclpy; rclpy.init()'"]
)
def test_a_node_with_a_wrong_file_ends_with_one_line(program, client, ended):
    failed = ended(client(MUTUAL, program, with_certificate("nobody")))
    assert failed.returncode == 1
    [line] = failed.stderr.splitlines()
    assert "nobody.pem cannot be read: No such file or directory. " in line
    assert line.endswith("connect_certificate names it.")


def test_no_user_and_password(router, client, ended):
    refusing = router(USER)
    failed = ended(client(MUTUAL))
    assert failed.returncode == 1
    assert "the peer at that address opened no session" in failed.stderr
    assert "requires a user and password" in failed.stderr
    refusing.wait_for("it gives no user and password")


def test_the_student_hears_and_does_not_speak(router, client, run, ended, folder):
    router(ACCESS)
    listener = run(
        *("bash", "-c", client(ACCESS, "ros2 topic echo /chatter std_msgs/msg/String")),
        environment=environment(),
        cwd=folder,
    )
    student = {"NAME": "student", "PASSWORD": "homework"}
    pupil = run(
        *("bash", "-c", client(ACCESS, "ros2 topic echo --once /chatter std_msgs/msg/String")),
        environment=environment(**student),
        cwd=folder,
    )
    pub = "ros2 topic pub -t 3 -r 10 -w {} /chatter std_msgs/msg/String 'data: {}'"
    told = ended(client(ACCESS, pub.format(1, "mine")), **student)
    assert told.returncode == 0, told.stderr
    ended(client(ACCESS, pub.format(2, "hers")))
    listener.wait_for("data: hers")
    pupil.wait_for("data: hers")
    assert "mine" not in listener.text


def test_a_subject_without_a_policy_sees_nobody(router, client, run, ended, folder):
    telling = router(ACCESS, "echo mallory:secret >> users")
    talker = client(ACCESS, "ros2 run demo_nodes_py talker")
    run("bash", "-c", talker, environment=environment(), cwd=folder)
    ended(client(ACCESS, "ros2 topic echo --once /chatter std_msgs/msg/String"))
    seen = ended(client(ACCESS), NAME="mallory", PASSWORD="secret")
    assert (seen.returncode, seen.stdout) == (0, "")
    telling.wait_for("matches no subject of access_control")


def test_a_peer_is_warned_once_of_what_keeps_it_from_its_router(client, ended, router):
    router(MUTUAL)
    change = with_certificate("mallory") + "\nSETTINGS+=('mode=\"peer\"')"
    program = (
        f"{sys.executable} -c '"
        "from threading import enumerate; from turtlewire.wire import open_context; "
        "context = open_context(); "
        '[one.join() for one in enumerate() if one.name == "turtlewire-tls"]; context.close()\''
    )
    done = ended(client(MUTUAL, program, change))
    [line] = done.stderr.splitlines()
    assert "the other side does not know the authority that signed" in line


def test_messages_that_the_router_forwards():
    head = (
        "\x1b[2m2026-11-22T23:05:18.0Z\x1b[0m {} acc-0 ThreadId(05) "
        "\x1b[2mzenoh_link_tls::unicast\x1b[0m: "
    )
    warned = head.format("\x1b[33m WARN\x1b[0m") + "something new at /a/b.rs:12."
    assert explain(warned) == "something new"
    assert explain(head.format("DEBUG") + "New transport link accepted") == ""
    for what in ("interest", "subscriber", "token"):
        assert explain(head.format("ERROR") + f"Unknown {what}") == ""
    assert explain("thread 'main' panicked") == "thread 'main' panicked"


# Two networks that nothing joins but a router with a leg in each.

#: The addresses of the router and of the host in each network.
NETWORKS = {"here": ("10.78.1.1", "10.78.1.2"), "there": ("10.78.2.1", "10.78.2.2")}


@pytest.fixture
def networks():
    """Three hosts in namespaces: `here` and `there`, and the router between them."""
    if not hasattr(os, "geteuid") or os.geteuid() != 0 or shutil.which("ip") is None:
        pytest.skip("network namespaces need root and ip (Debian: apt install iproute2)")
    hosts = ("router", *NETWORKS)
    try:
        for host in hosts:
            ip("netns", "add", namespace(host))
            ip("-n", namespace(host), "link", "set", "lo", "up")
        for host, (of_router, own) in NETWORKS.items():
            link = f"tw-{host}"
            ip(
                *("link", "add", link, "netns", namespace("router")),
                *("type", "veth", "peer", "name", link, "netns", namespace(host)),
            )
            for place, address in ("router", of_router), (host, own):
                ip("-n", namespace(place), "addr", "add", f"{address}/24", "dev", link)
                ip("-n", namespace(place), "link", "set", link, "up")
        yield
    except subprocess.CalledProcessError as error:
        pytest.skip(f"this container has no network namespaces: {error.stderr.decode().strip()}")
    finally:
        delete_namespaces(*hosts)


def on_host(host: str, script: str) -> list[str]:
    return ["ip", "netns", "exec", namespace(host), "bash", "-c", script]


@pytest.mark.slow
def test_the_follow_demo_runs_across_two_networks_over_a_router_with_tls(
    networks, run, client, tmp_path
):
    """With mutual TLS and passwords; `here` and `there` have no route to each other."""
    keys = commands("certificates").replace(
        "DNS:$ROUTER", ",".join(f"IP:{of_router}" for of_router, _ in NETWORKS.values())
    )
    subprocess.run(["bash", "-euc", keys], cwd=tmp_path, check=True, capture_output=True)
    serving = "\n".join([commands("router", USER), commands("start the router")])
    router = run(*on_host("router", serving), environment=environment(), cwd=tmp_path)
    router.wait_for("Started Zenoh router")

    def start(host: str, command: str):
        of_router, _ = NETWORKS[host]
        lines = client(USER, command, "").replace("ROUTER=localhost", f"ROUTER={of_router}")
        learning = str(LEARNING)
        quiet = {"TURTLEWIRE_PORT": "0", "TURTLEWIRE_BROWSER": "0", "PYTHONPATH": learning}
        script = re.sub(r"tls/\$ROUTER:\d+", "tls/$ROUTER:7447", lines)
        return run(*on_host(host, script), environment=environment(**quiet), cwd=tmp_path)

    nodes = [
        start(
            host,
            f"exec {sys.executable} -c 'from {module} import main; main()' "
            f"--ros-args {' '.join(arguments)}",
        )
        for host, module, arguments in DEMO
    ]
    driver = start("here", f"exec {sys.executable} {PEERS / 'follow.py'}")
    said = "\n".join(program.text for program in [router, *nodes])
    assert driver.wait(100) == 0, driver.text + said
    way_of_turtle2, final_distance = (float(word) for word in driver.text.split())
    assert way_of_turtle2 > 1.5
    assert final_distance <= 0.3
    assert all(node.process.poll() is None for node in nodes), said
    assert "Traceback" not in said
