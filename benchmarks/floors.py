"""The least that the machine needs for the same work, without Python nodes."""

from __future__ import annotations

import mmap
import os
import re
import shutil
import socket
import subprocess
import sys
import threading
import time

from benchmarks.figures import Figure

#: ddsperf on loopback only. Its participants find each other without multicast.
_LOOPBACK = """
<General>
  <Interfaces><NetworkInterface name="lo"/></Interfaces><AllowMulticast>false</AllowMulticast>
</General>
<Discovery>
  <ParticipantIndex>auto</ParticipantIndex><Peers><Peer address="127.0.0.1"/></Peers>
</Discovery>
"""
_SECONDS = 5
_LINE = re.compile(r" size \d+ mean ([\d.]+)us .* 50% ([\d.]+)us .* 99% ([\d.]+)us")
_TICKS = 300


def one_way(rate: str = "1kHz") -> dict[str, Figure] | None:
    """Return half the round trip of ``ddsperf``, or None where cyclonedds-tools is not installed.

    Args:
        rate: How often it sends a ping; an empty text sends the next one after each answer.
    """
    if shutil.which("ddsperf") is None:
        print("floors: no ddsperf (apt install cyclonedds-tools)", file=sys.stderr)
        return None
    environment = {**os.environ, "CYCLONEDDS_URI": _LOOPBACK}
    command = ["ddsperf", "-i", "105", "-D"]
    with subprocess.Popen(
        [*command, str(_SECONDS + 2), "pong"], env=environment, stdout=subprocess.DEVNULL
    ):
        ping = subprocess.run(
            [*command, str(_SECONDS), "ping", *([rate] if rate else []), "size", "40"],
            env=environment,
            check=True,
            capture_output=True,
            text=True,
        )
    seconds = [tuple(map(float, match)) for match in _LINE.findall(ping.stdout)]
    means, medians, tails = zip(*seconds[1:], strict=True)  # the first second has the discovery
    found = {"mean": means, "p50": medians, "p99": tails}
    return {name: Figure.of(values, factor=1e3) for name, values in found.items()}


def sleep_cpu(period_s: float = 0.01) -> Figure:
    """Return the CPU time of one tick of a loop around ``clock_nanosleep``."""
    runs = []
    for _ in range(3):
        begin, due = time.process_time_ns(), time.monotonic()
        for _ in range(_TICKS):
            due += period_s
            time.sleep(max(0.0, due - time.monotonic()))
        runs.append((time.process_time_ns() - begin) / _TICKS)
    return Figure.of(runs)


def copying(count: int) -> Figure:
    """Return the CPU time per sample of copying stamps and poses into fresh memory of a buffer.

    A sample has 64 bytes; the memory is in huge pages as the buffer's is.
    """
    data = bytes(64 * count)
    runs = []
    for _ in range(20):
        private = mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS
        with mmap.mmap(-1, len(data), private) as memory:
            memory.madvise(mmap.MADV_HUGEPAGE)
            begin = time.process_time_ns()
            memory[:] = data
            runs.append((time.process_time_ns() - begin) / count)
    return Figure.of(runs)


def transfer(size: int) -> Figure:
    """Return the time in which one process gets ``size`` bytes from a thread over loopback."""
    data, count = bytes(size), 60
    times = []
    with socket.create_server(("127.0.0.1", 0)) as server:
        sender = threading.Thread(target=_send, args=(server.getsockname()[1], data, count))
        sender.start()
        connection, _ = server.accept()
        target = memoryview(bytearray(size))
        with connection:
            for _ in range(count):
                begin, filled = time.perf_counter_ns(), 0
                while filled < size:
                    filled += connection.recv_into(target[filled:])
                times.append(time.perf_counter_ns() - begin)
        sender.join()
    return Figure.of(times)


def _send(port: int, data: bytes, count: int) -> None:
    with socket.create_connection(("127.0.0.1", port)) as connection:
        for _ in range(count):
            connection.sendall(data)
