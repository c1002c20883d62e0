"""turtlesim: the simulator of ROS 2's tutorials, with its screen in the browser."""

import os
import sys

# Kilted moved the interfaces to a package of their own, with other names on the wire. The names of
# the distributions follow the alphabet.
if os.environ.get("ROS_DISTRO", "jazzy") >= "kilted":
    from turtlesim_msgs import action, msg, srv

    sys.modules.update(
        {f"{__name__}.action": action, f"{__name__}.msg": msg, f"{__name__}.srv": srv}
    )
