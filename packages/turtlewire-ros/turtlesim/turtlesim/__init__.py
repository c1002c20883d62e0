"""turtlesim: the simulator of ROS 2's tutorials, with its screen in the browser.

===================================  =========================================================
module                               contents
===================================  =========================================================
`turtlesim_node`, `options`          the simulator's node; its command line
`pace`                               the speed of the simulation, and pauses
`model`, `physics`                   the turtles and their world; the formulas
`crowd`                              many turtles in one tick
`path`, `path_bulk`                  pixels that pens paint: one line, many lines
`turtle_endpoints`                   topics, services and action of one turtle
`missing_turtles`                    turtles that are referenced but were never spawned
`screen`, `picture`                  the page in the browser; the data that it draws
`drawing`                            the pens' lines, also for browsers that connect later; their
                                     colours
`page_commands`, `page_actions`      the commands of the page; their execution
`transform_view`                     frames and transforms on the page
`turtle_teleop_key`                  drives a turtle from a terminal
`draw_square`, `mimic`               ROS 2's two example nodes
`cpp_node`                           a node that looks like ROS 2's C++ nodes
`testing`                            simulator and nodes of a test in lock-step
`msg`, `srv`, `action`               generated interfaces
===================================  =========================================================
"""

import sys

from turtlewire.distro import KILTED, since

# Kilted moved the interfaces to their own package, with other names on the wire.
if since(KILTED):
    from turtlesim_msgs import action, msg, srv

    sys.modules.update(
        {f"{__name__}.action": action, f"{__name__}.msg": msg, f"{__name__}.srv": srv}
    )
