"""Actions for launch tests of ROS nodes.

======================  =============================================================
module                  what it holds
======================  =============================================================
`enable_rmw_isolation`  `EnableRmwIsolation`: nodes of other tests are out of reach
======================  =============================================================
"""

from __future__ import annotations

from .enable_rmw_isolation import EnableRmwIsolation

__all__ = ["EnableRmwIsolation"]
