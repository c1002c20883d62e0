"""Runs a function in a process that stays when this one ends, under ROS 2's names.

The function and its arguments reach the process as a pickle on its stdin, with the sockets among
them:

    daemonize(functools.partial(serve_and_close, server), tags={"name": "ros2-daemon"})

The tags stand on the command line of the process, where a list of processes shows them. The
process belongs to no launch and no terminal: neither Ctrl-C nor the end of either ends it.
"""

from ros2cli.background import PicklerForProcess, daemonize, main

__all__ = ["PicklerForProcess", "daemonize", "main"]
