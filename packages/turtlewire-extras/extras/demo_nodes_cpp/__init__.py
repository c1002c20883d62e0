"""The nodes of ROS 2's tutorials under the name of their C++ package, with the same log lines.

Component containers load the classes below as ``demo_nodes_cpp::Talker`` and so on.

=======  ==============================
module   contents
=======  ==============================
`nodes`  the nodes, and the executables
=======  ==============================
"""

from demo_nodes_cpp.nodes import Listener, ParameterBlackboard, ServerNode, Talker

__all__ = ["Listener", "ParameterBlackboard", "ServerNode", "Talker"]
