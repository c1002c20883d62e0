"""The implementation of scripts/soak.

Runs a robot's processes while other processes start and end, and measures the former.
"""

from __future__ import annotations

import os
import random
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import IO, NamedTuple

from early_options import soak as soak_options
from soak_actors import BROADCASTERS

from turtlewire import wire
from turtlewire.program import program
from turtlewire.testing import isolated_domain

ACTORS = Path(__file__).with_name("soak_actors.py")
BIN = Path(sys.executable).parent
VISITS_PER_MINUTE = 60
MOST_VISITORS = 12  # at a time: a slow machine gets fewer, and the table says how many
KILLED = 3  # one of this many visitors
SAMPLES = 60
#: How much more than in the middle third a process may hold at least in the last third. Packets
#: fill a receive buffer of 1 MB before Cyclone frees it, so memory goes up and down by that much.
MEMORY_LIMIT = 3 << 18
#: What is at least so large is given back to the system when it is freed. The C library would keep
#: Cyclone's freed receive buffers in its arenas: two of them more or less, as their order happens.
GIVEN_BACK = 1 << 18
START_LIMIT_S = 120
END_LIMIT_S = 60


class MemorySample(NamedTuple):
    """The memory, descriptors and threads of a process at a moment."""

    memory: int
    descriptors: int
    threads: int


class Resident:
    """A process that stays, and its samples."""

    def __init__(self, name: str, *command: str | Path, log: IO[str]) -> None:
        self.name = name
        self.samples: list[MemorySample] = []
        self.process = subprocess.Popen(
            [str(word) for word in command], stdout=subprocess.DEVNULL, stderr=log
        )

    def sample(self) -> None:
        """Record a sample of the process, unless it has ended."""
        folder = Path(f"/proc/{self.process.pid}")
        try:
            pages = int((folder / "statm").read_text().split()[1])
            descriptors = len(list((folder / "fd").iterdir()))
            threads = len(list((folder / "task").iterdir()))
        except (OSError, IndexError):
            return
        self.samples.append(MemorySample(pages * os.sysconf("SC_PAGE_SIZE"), descriptors, threads))

    def ends_within(self, seconds: float) -> bool:
        """Return True if it ends in that time by itself; it is killed otherwise."""
        try:
            self.process.wait(seconds)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
            return False
        return True

    def faults(self) -> list[str]:
        """Return the problems at the end of the run."""
        if self.process.poll() is not None:
            return [f"ended with status {self.process.returncode}"]
        middle, last = self.thirds()[1:]
        found = []
        if last.memory - middle.memory > MEMORY_LIMIT:
            found.append(f"grew by {(last.memory - middle.memory) / 2**20:.1f} MB")
        for what in ("descriptors", "threads"):
            before, after = getattr(middle, what), getattr(last, what)
            if after > before:
                found.append(f"{what}: {before} became {after}")
        return found

    def thirds(self) -> list[MemorySample]:
        """Return the minimum memory, descriptors and threads in each third of the run.

        The minimum leaves out what visitors and full receive buffers need for a while.
        """
        size = max(1, len(self.samples) // 3)
        parts = [self.samples[:size], self.samples[size:-size], self.samples[-size:]]
        return [
            MemorySample(
                min(sample.memory for sample in part),
                min(sample.descriptors for sample in part),
                min(sample.threads for sample in part),
            )
            for part in parts
        ]


class Visitors:
    """Starts and ends processes on a separate thread; kills one of three."""

    def __init__(self, page: str, seconds: float, log: IO[str]) -> None:
        self.come = self.killed = 0
        self.failures: list[str] = []
        self._page = page
        self._seconds = seconds
        self._log = log
        self._stop = threading.Event()
        self._seats = threading.Semaphore(MOST_VISITORS)
        self._random = random.Random(1)  # the same visits in each run
        self._visits: list[threading.Thread] = []
        self._thread = threading.Thread(target=self._run)

    def __enter__(self) -> Visitors:  # noqa: PYI034 -- typing.Self comes with Python 3.11
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._stop.set()
        self._thread.join()
        for visit in self._visits:
            visit.join()

    def _run(self) -> None:
        started = time.monotonic()
        for number in range(round(self._seconds * VISITS_PER_MINUTE / 60)):
            due = started + number * 60 / VISITS_PER_MINUTE
            self._seats.acquire()
            if self._stop.wait(max(0.0, due - time.monotonic())):
                return
            self.come += 1
            lifetime = self._random.uniform(0.2, 2.0) if number % KILLED == 0 else None
            visit = threading.Thread(target=self._visit, args=(number, lifetime))
            self._visits.append(visit)
            visit.start()

    def _visit(self, number: int, lifetime: float | None) -> None:
        """Run one to its end, or one that stays, and kill it after its lifetime."""
        process = subprocess.Popen(
            self._command(number, stays=lifetime is not None),
            stdout=subprocess.DEVNULL,
            stderr=self._log,
        )
        try:
            status = process.wait(START_LIMIT_S if lifetime is None else lifetime)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
            if lifetime is None:
                self.failures.append(f"visitor {number} did not end")
            else:
                self.killed += 1
        else:
            if status:
                self.failures.append(f"visitor {number} ended with status {status}")
        self._seats.release()

    def _command(self, number: int, *, stays: bool) -> list[str]:
        kinds = {
            "visiting_listener": str(number),
            "visiting_node": str(number),
            "visiting_page": self._page,
        }
        if number % 10 == 9:
            return [str(BIN / "ros2"), "topic", *(("hz", "/tf") if stays else ("list",))]
        kind = list(kinds)[number // KILLED % len(kinds)]
        return [sys.executable, str(ACTORS), kind, kinds[kind], *(("again",) if stays else ())]


def main() -> int:
    """Run the soak; the exit status."""
    arguments = soak_options(sys.argv[1:])
    log_path = BIN.parent / "log" / f"soak-{os.getpid()}.txt"
    log_path.parent.mkdir(exist_ok=True)
    print(
        f"[soak] {arguments.minutes:g} minutes; what the processes say goes to {log_path}",
        flush=True,
    )
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:  # of a shell that started it with "&"
        signal.signal(signal.SIGINT, signal.default_int_handler)  # or its children would ignore it
    with isolated_domain(), log_path.open("w") as log:
        return soak(arguments.minutes * 60, log, log_path)


def soak(seconds: float, log: IO[str], log_path: Path) -> int:
    """Run everything for a number of seconds, and judge it."""
    residents: list[Resident] = []
    faults: list[str] = []
    try:
        page = start_residents(residents, log, log_path)
        with Visitors(page, seconds, log) as visitors:
            watch(residents, seconds)
        report(residents, visitors)
        faults += [f"{each.name} {fault}" for each in residents for fault in each.faults()]
        faults += visitors.failures
    finally:
        faults += stop(residents)
    for fault in faults:
        print(f"[soak] FAULT: {fault}")
    print(f"[soak] {'failed' if faults else 'passed'}")
    return 1 if faults else 0


def start_residents(residents: list[Resident], log: IO[str], log_path: Path) -> str:
    """Start what stays; the page's address."""
    os.environ |= {"TURTLEWIRE_PORT": "0", "TURTLEWIRE_BROWSER": "0", "PYTHONUNBUFFERED": "1"}
    os.environ["MALLOC_MMAP_THRESHOLD_"] = str(GIVEN_BACK)
    # Not with `ros2 run`, which would be the process that is measured.
    node = ("-c", "from turtlesim.turtlesim_node import main; main()")
    residents.append(Resident("turtlesim_node", sys.executable, *node, log=log))
    page = wait_for_page(residents[0], log_path)
    residents += [actor("broadcaster", name, log) for name in BROADCASTERS]
    residents += [actor(name, "", log) for name in ("listener", "watcher", "server", "client")]
    residents.append(actor("viewer", page, log))
    wait_for_nodes({f"broadcaster_{name}" for name in BROADCASTERS} | {"listener", "client"})
    return page


def wait_for_nodes(names: set[str]) -> None:
    """Block until the graph has nodes of these names."""
    context = wire.open_context()
    try:
        graph = context.graph
        if not graph.wait_for(
            lambda: names <= {node.name for node in graph.nodes()}, START_LIMIT_S * 10**9
        ):
            raise SystemExit(f"[soak] not all of {', '.join(sorted(names))} started")
    finally:
        context.close()


def actor(name: str, argument: str, log: IO[str]) -> Resident:
    """Return a resident of soak_actors.py."""
    label = f"{name} {argument}" if name == "broadcaster" else name
    return Resident(label, sys.executable, ACTORS, name, argument, log=log)


def wait_for_page(simulator: Resident, log_path: Path) -> str:
    """Return the address that the simulator logs."""
    import re

    end = time.monotonic() + START_LIMIT_S
    while time.monotonic() < end and simulator.process.poll() is None:
        match = re.search(r"http://127\.0\.0\.1:\d+/", log_path.read_text())
        if match:
            return match[0]
        time.sleep(0.2)  # a file does not notify when it grows
    raise SystemExit(f"[soak] the simulator did not start: see {log_path}")


def watch(residents: list[Resident], seconds: float) -> None:
    """Sample all residents until the time is over; ends early when one of them has ended."""
    for number in range(SAMPLES):
        time.sleep(seconds / SAMPLES)
        for resident in residents:
            resident.sample()
        ended = [resident.name for resident in residents if resident.process.poll() is not None]
        if ended:
            print(f"[soak] ended too early: {', '.join(ended)}")
            return
        if number % (SAMPLES // 6) == SAMPLES // 6 - 1:
            print(f"[soak] {(number + 1) * seconds / SAMPLES / 60:.1f} min", flush=True)


def report(residents: list[Resident], visitors: Visitors) -> None:
    """Print the table: the minima of the thirds of the run."""
    print(f"\n{'process':20} {'memory [MB], by thirds':>24} {'descriptors':>15} {'threads':>15}")
    for resident in residents:
        if len(resident.samples) < 3:
            continue
        thirds = resident.thirds()
        memory = " ".join(f"{third.memory / 2**20:7.2f}" for third in thirds)
        descriptors = " ".join(f"{third.descriptors:4}" for third in thirds)
        threads = " ".join(f"{third.threads:4}" for third in thirds)
        print(f"{resident.name:20} {memory:>24} {descriptors:>15} {threads:>15}")
    print(f"\nvisitors: {visitors.come}, of them killed: {visitors.killed}\n")


def stop(residents: list[Resident]) -> list[str]:
    """Interrupt all residents; which of them did not end as they should."""
    for resident in residents:
        if resident.process.poll() is None:
            resident.process.send_signal(signal.SIGINT)
    return [
        f"{resident.name} did not end after SIGINT"
        for resident in residents
        if not resident.ends_within(END_LIMIT_S)
    ]


if __name__ == "__main__":
    sys.exit(program(main)())
