"""Messages of all topics of a bag; the libraries take turns in one process. CPU time."""

import gc
import sys
import tempfile
import time
from importlib.util import find_spec
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))
from mcap.reader import make_reader
from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_typestore

from benchmarks.clock import report, summary
from benchmarks.robot_bag import write_robot_bag, write_ros1_bag
from turtlewire.bag import open_bag

RUNS = 7


def turtlewire(path, is_decoded):
    with open_bag(path) as bag:
        for message in bag.messages():
            if is_decoded:
                message.decode()


def rosbags(path, is_decoded):
    with AnyReader([path], default_typestore=get_typestore(Stores.ROS2_JAZZY)) as reader:
        for connection, _, data in reader.messages():
            if is_decoded:
                reader.deserialize(data, connection.msgtype)


def mcap(path, is_decoded):
    """Iterate with the library of MCAP, and decode with the faster of its two decoders."""
    (file,) = path.glob("*.mcap")
    with file.open("rb") as stream:
        if not is_decoded:
            for _ in make_reader(stream).iter_messages():
                pass
            return
        from mcap_ros2_support_fast.decoder import DecoderFactory

        reader = make_reader(stream, decoder_factories=[DecoderFactory()])
        for _ in reader.iter_decoded_messages():
            pass


def measure(functions, *arguments):
    """Return the figure of each function; they are called in turns."""
    runs = {name: [] for name in functions}
    for _ in range(RUNS):
        for name, function in functions.items():
            gc.collect()
            start = time.process_time_ns()
            function(*arguments)
            runs[name].append(time.process_time_ns() - start)
    return {name: summary(figures) for name, figures in runs.items()}


def main():
    figures = {}
    with tempfile.TemporaryDirectory(prefix="turtlewire-bench-") as name:
        folder = Path(name)
        write_robot_bag(folder / "mcap")
        write_robot_bag(folder / "sqlite3", "sqlite3")
        write_ros1_bag(folder / "mcap", folder / "ros1.bag")
        for bag in ("mcap", "sqlite3", "ros1.bag"):
            for is_decoded in (True, False):
                libraries = {"turtlewire": turtlewire, "rosbags": rosbags}
                if bag == "mcap" and not is_decoded:
                    libraries["mcap"] = mcap
                elif bag == "mcap" and find_spec("mcap_ros2_support_fast"):
                    libraries["mcap-ros2-support-fast"] = mcap
                case = f"{bag} {'decoded' if is_decoded else 'bytes'}"
                for library, figure in measure(libraries, folder / bag, is_decoded).items():
                    figures[f"{case} {library}"] = figure
    report(figures)


if __name__ == "__main__":
    main()
