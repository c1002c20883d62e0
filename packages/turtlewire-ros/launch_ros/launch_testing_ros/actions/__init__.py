"""Actions for launch tests of ROS nodes.

======================  =============================================================
module                  contents
======================  =============================================================
`enable_rmw_isolation`  `EnableRmwIsolation`: isolates the nodes of a test
======================  =============================================================
"""

from .enable_rmw_isolation import EnableRmwIsolation

__all__ = ["EnableRmwIsolation"]
