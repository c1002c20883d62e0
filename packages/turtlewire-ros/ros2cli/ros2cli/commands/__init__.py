"""The commands, each with a line for ``ros2 --help``."""

from __future__ import annotations

__all__ = ["COMMANDS"]

COMMANDS = {
    "action": "Goals that take time: list them, send one",
    "bag": "Look at recorded messages",
    "component": "Containers of nodes: list them, load and unload nodes",
    "daemon": "Status of the daemon (there is none, and none is needed)",
    "doctor": "Look for what is wrong with the setup and the traffic",
    "extension_points": "List the kinds of commands and verbs",
    "extensions": "List all commands and verbs",
    "interface": "Show the definitions of messages, services and actions",
    "launch": "Run a launch file",
    "lifecycle": "Show and change the states of managed nodes",
    "multicast": "Find out whether this network passes multicast on",
    "node": "List nodes, show what one of them offers",
    "param": "Read and set parameters of nodes",
    "pkg": "List and create packages",
    "run": "Run an executable of a package",
    "service": "List services, call one, watch the calls of others",
    "test": "Run a launch test in a domain of its own",
    "topic": "List topics, listen to one, publish to one",
    "wtf": "The same as doctor",
}
