"""The nodes of ROS 2's tutorials under the name of their C++ package, with the same log lines.

Component containers load the classes below as ``demo_nodes_cpp::Talker`` and so on.

======================  ==============================================
module                  contents
======================  ==============================================
`topics`                ``talker`` and ``listener``
`services`              ``add_two_ints_server`` and its clients
`parameter_blackboard`  a node that holds any parameters
======================  ==============================================
"""

from demo_nodes_cpp.parameter_blackboard import ParameterBlackboard
from demo_nodes_cpp.services import ServerNode
from demo_nodes_cpp.topics import Listener, Talker

__all__ = ["Listener", "ParameterBlackboard", "ServerNode", "Talker"]
