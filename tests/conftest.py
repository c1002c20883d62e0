"""Every test process gets a domain, a log directory and a loopback-only range of its own; children inherit them."""

from __future__ import annotations

import os
import tempfile

from hypothesis import settings

os.environ["ROS_DOMAIN_ID"] = str(1 + os.getpid() % 230)
os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
os.environ["ROS_LOG_DIR"] = tempfile.mkdtemp(prefix="turtlewire-test-log-")
os.environ.pop("RMW_IMPLEMENTATION", None)

settings.register_profile("turtlewire", deadline=None)
settings.load_profile("turtlewire")
