"""Calls of a service, one after the other: our rclpy and the real one on Fast DDS as clients of one
server, which is ours.

The real one is what `scripts/peers` installs; its address space is limited.
"""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from benchmarks.figures import Figure, Row

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

TITLE = "services: a call and its answer, two processes, std_srvs/SetBool"
PEER = Path(__file__).parents[1] / "build" / "peers" / "jazzy" / "bin" / "python"
ROUNDS, CALLS, WARM_UP = 4, 2000, 200
ADDRESS_SPACE_KB = 4_000_000
ENVIRONMENT = {
    "HOME": os.environ["HOME"],
    "PATH": "/usr/bin:/bin",
    "ROS_DOMAIN_ID": "102",
    "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
}
SERVER = """
import rclpy
from std_srvs.srv import SetBool

rclpy.init()
node = rclpy.create_node("server")
node.create_service(SetBool, "switch", lambda request, response: response)
print("up", flush=True)
try:
    rclpy.spin(node)
except rclpy.executors.ExternalShutdownException:  # SIGTERM
    pass
"""
#: The same program for both, in the way that is fastest with the real rclpy: one executor for all
#: calls, and `spin_once` (with `spin_until_future_complete`, a call took it 12 ms).
CLIENT = f"""
import json, time
import rclpy
from rclpy.executors import SingleThreadedExecutor
from std_srvs.srv import SetBool

rclpy.init()
node = rclpy.create_node("client")
client = node.create_client(SetBool, "switch")
executor = SingleThreadedExecutor()
executor.add_node(node)
assert client.wait_for_service(30.0)
times = []
for _ in range({WARM_UP + CALLS}):
    start = time.perf_counter_ns()
    future = client.call_async(SetBool.Request(data=True))
    while not future.done():
        executor.spin_once(10.0)
    times.append(time.perf_counter_ns() - start)
print(json.dumps(times[{WARM_UP}:]))
"""


def rows() -> Iterator[Row]:
    clients = {"ours": [sys.executable]}
    if PEER.exists():
        limited = f'ulimit -v {ADDRESS_SPACE_KB}; exec "$@"'
        clients["real rclpy"] = ["sh", "-c", limited, "sh", str(PEER)]
    else:
        print("services: no real rclpy (run scripts/peers)", file=sys.stderr)
    runs: dict[str, list[list[int]]] = {client: [] for client in clients}
    with subprocess.Popen(
        [sys.executable, "-c", SERVER], env=ENVIRONMENT, stdout=subprocess.PIPE, text=True
    ) as server:
        assert server.stdout is not None
        assert server.stdout.readline() == "up\n"
        for _ in range(ROUNDS):
            for client, command in clients.items():
                runs[client].append(measure(command))
        server.terminate()
    for what, summary, budget in (
        ("p50", statistics.median, "real rclpy: >= 2x"),
        ("p99", lambda times: sorted(times)[len(times) * 99 // 100], ""),
        ("mean (its inverse is calls a second)", statistics.mean, "real rclpy: >= 2x"),
    ):
        figures = {client: _figure(map(summary, times)) for client, times in runs.items()}
        yield Row(what, figures.pop("ours"), figures, budget)


def _figure(values: Iterable[float]) -> Figure:
    values = list(values)
    return Figure(min(values), statistics.median(values))


def measure(command: list[str]) -> list[int]:
    """The nanoseconds of each call of one client."""
    client = [*command, "-c", CLIENT]
    output = subprocess.run(client, env=ENVIRONMENT, check=True, capture_output=True, text=True)
    times: list[int] = json.loads(output.stdout)
    return times
