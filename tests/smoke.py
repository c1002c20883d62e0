"""The checks that `scripts/smoke` runs with each Python on the installed wheels.

The imports, a lookup, the commands, the start of the follow demo, exits beside daemon threads.

Usage: python smoke.py BIN, where BIN is the folder with the commands of the same venv.
"""

from __future__ import annotations

import os
import platform
import signal
import subprocess
import sys
from pathlib import Path


def check_lookup() -> None:
    """A chain of two links through the compiled core, and a real message back."""
    import rclpy.time
    import turtlewire
    from geometry_msgs.msg import TransformStamped
    from tf2_ros import Buffer

    buffer = turtlewire.Buffer()
    buffer.set_transform("world", "turtle1", 1, (1.0, 2.0, 0.0))
    buffer.set_transform("world", "turtle2", 1, (0.0, 2.0, 0.0))
    assert buffer.lookup_transform("turtle2", "turtle1").translation == (1.0, 0.0, 0.0)

    message = TransformStamped()
    message.header.frame_id, message.child_frame_id = "a", "b"
    message.transform.translation.x = 3.0
    ros_buffer = Buffer()
    ros_buffer.set_transform_static(message, "smoke")
    assert ros_buffer.lookup_transform("a", "b", rclpy.time.Time()).transform.translation.x == 3.0


def check_commands(bin_dir: Path) -> None:
    """`ros2` finds its packages, and the tutorial's launch file starts, follows a Ctrl-C and leaves
    cleanly.
    """
    ros2 = str(bin_dir / "ros2")
    executables = subprocess.run(
        [ros2, "pkg", "executables", "learning_tf2_py"], check=True, capture_output=True, text=True
    ).stdout
    assert "learning_tf2_py turtle_tf2_listener" in executables, executables

    env = dict(
        os.environ,
        ROS_DOMAIN_ID=str(1 + os.getpid() % 101),
        TURTLEWIRE_BROWSER="0",
        PYTHONUNBUFFERED="1",
    )
    launch = subprocess.Popen(
        [ros2, "launch", "learning_tf2_py", "turtle_tf2_demo.launch.py"],
        env=env,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    lines = []
    for line in launch.stdout:
        lines.append(line)
        if "Spawning turtle [turtle2]" in line:
            launch.send_signal(signal.SIGINT)
    assert launch.wait(timeout=60) == 0, "".join(lines)
    assert any("Spawning turtle [turtle2]" in line for line in lines), "".join(lines)
    assert not any("Traceback" in line for line in lines), "".join(lines)


def check_exits() -> None:
    """The interpreter ends quietly while daemon threads are in the native core."""
    program = Path(__file__).parent / "chaos" / "exits.py"
    for kind in ("wait", "batch", "intake", "change_listener", "spin", "spin_and_shutdown"):
        for _ in range(5):
            done = subprocess.run(
                [sys.executable, program, kind], stderr=subprocess.PIPE, text=True, check=False
            )
            assert (done.returncode, done.stderr) == (0, ""), (kind, done)


if __name__ == "__main__":
    check_lookup()
    check_commands(Path(sys.argv[1]))
    check_exits()
    print(f"Python {platform.python_version()}: imports, lookup, commands, demo and exits are fine")
