"""Hosts as network namespaces of Linux, and the follow demo on two of them."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

PEERS = Path(__file__).parent / "peers"
#: Which host runs which node of the follow demo, and its arguments: each arrow of the data flow
#: goes from one host to the other.
DEMO = [
    ("here", "turtlesim.turtlesim_node", []),
    (
        "there",
        "learning_tf2_py.turtle_tf2_broadcaster",
        ["-r", "__node:=broadcaster1", "-p", "turtlename:=turtle1"],
    ),
    (
        "here",
        "learning_tf2_py.turtle_tf2_broadcaster",
        ["-r", "__node:=broadcaster2", "-p", "turtlename:=turtle2"],
    ),
    ("there", "learning_tf2_py.turtle_tf2_listener", ["-p", "target_frame:=turtle1"]),
]


def ip(*arguments: str) -> None:
    subprocess.run(["ip", *arguments], check=True, capture_output=True)


def namespace(host: str) -> str:
    return f"turtlewire-{host}-{os.getpid()}"


def delete_namespaces(*hosts: str) -> None:
    for host in hosts:
        subprocess.run(["ip", "netns", "delete", namespace(host)], check=False, capture_output=True)
