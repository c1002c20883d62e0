"""Tests of programs that a launch description starts, with unittest, pytest or ``launch_test``.

================================  ==============================================================
module                            contents
================================  ==============================================================
`loader`                          finds the tests of a module, before and after the shutdown
`test_runner`                     runs a launch and its tests; their results
`launch_test`                     the command ``launch_test``
`junitxml`                        results as JUnit's XML
`pytest`                          the same tests, collected by pytest
`actions`                         ``ReadyToTest``, and actions that run test programs
`event_handlers`                  waits for a text on stdout
`proc_info_handler`               which processes started, and how they ended
`io_handler`                      the output of the processes
`asserts`                         assertions about exit codes and output
`tools`                           patterns of expected output; processes that one test starts
`util`                            finds processes by name and arguments
`decorator`, `markers`            mark classes as post-shutdown tests; marks of descriptions
`legacy`                          tests as actions of a launch
`parametrize`                     runs the tests once for each set of arguments
`ready_to_test_action_timeout`    how long a launch may take to become ready
`ready_aggregator`                calls a function when several callers are ready
`parse_arguments`                 arguments ``name:=value``
`print_arguments`                 shows the arguments of a launch description
================================  ==============================================================
"""

from launch_testing import tools, util
from launch_testing.decorator import post_shutdown_test
from launch_testing.io_handler import ActiveIoHandler, IoHandler
from launch_testing.parametrize import parametrize
from launch_testing.proc_info_handler import ActiveProcInfoHandler, ProcInfoHandler
from launch_testing.ready_aggregator import ReadyAggregator
from launch_testing.ready_to_test_action_timeout import ready_to_test_action_timeout

__all__ = [
    "ActiveIoHandler",
    "ActiveProcInfoHandler",
    "IoHandler",
    "ProcInfoHandler",
    "ReadyAggregator",
    "parametrize",
    "post_shutdown_test",
    "ready_to_test_action_timeout",
    "tools",
    "util",
]
