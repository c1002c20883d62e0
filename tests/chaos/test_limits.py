"""Processes with few file descriptors or little memory go on, or end and say why."""

import signal
import sys

import pytest

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(sys.platform != "linux", reason="reads /proc, and limits address space"),
]

#: A node that hears itself. The limit is what it has open, plus a number.
NODE = """
import os, resource, sys
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String

def limit_files(spare):
    used = max(map(int, os.listdir("/proc/self/fd"))) + 1
    resource.setrlimit(resource.RLIMIT_NOFILE, (used + spare, used + spare))

def limit_memory(spare):
    used = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (used + spare, used + spare))

{limit}({spare})
rclpy.init()
node = rclpy.create_node("limited")
heard = []
node.create_subscription(String, "words", heard.append, 10)
publisher = node.create_publisher(String, "words", 10)
while not heard:
    publisher.publish(String(data="word"))
    rclpy.spin_once(node, timeout_sec=0.1)
rclpy.shutdown()
print("heard")
"""


@pytest.mark.parametrize("spare", [*range(20), 30, 40, 64])
def test_few_file_descriptors_are_an_error_or_enough(spare, python, ends_well):
    program = python(NODE.format(limit="limit_files", spare=spare))
    if ends_well(program) == 0:
        assert program.lines[-1][1] == "heard"
    else:
        assert spare < 64, program.text
        assert any(word in program.text for word in ("Error", "Too many open files")), program.text


@pytest.mark.parametrize("megabytes", [1, 20, 40, 60, 100, 1000])
def test_little_memory_is_an_error_or_enough(megabytes, python):
    """Cyclone DDS itself ends the process with SIGABRT when it gets no memory, as malloc's user."""
    program = python(NODE.format(limit="limit_memory", spare=megabytes * 2**20))
    status = program.wait(120)
    assert status in {0, 1, -signal.SIGABRT}, program.text
    if megabytes == 1000:
        assert program.lines[-1][1] == "heard"


def test_a_buffer_without_memory_raises_and_stays_usable(python, ends_well):
    program = python(
        """
        import itertools, resource
        from turtlewire import Buffer

        pose = (1.0, 2.0, 3.0), (0.0, 0.0, 0.0, 1.0)
        buffer = Buffer()
        hard = resource.getrlimit(resource.RLIMIT_AS)[1]
        used = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
        resource.setrlimit(resource.RLIMIT_AS, (used + 20 * 2**20, hard))
        try:
            for count in itertools.count(1):
                buffer.set_transform("world", f"robot{count % 50}", count, *pose)
        except MemoryError:
            resource.setrlimit(resource.RLIMIT_AS, (hard, hard))
        print(buffer.lookup_transform("world", "robot1").translation)
        buffer.set_static_transform("robot1", "later", *pose)
        print(buffer.can_transform("world", "later"))
        """
    )
    assert ends_well(program) == 0, program.text
    assert program.lines[-1][1] == "True"
