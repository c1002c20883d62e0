"""Several nodes in one process: a container that loads node classes when it is asked to.

=====================  ====================================================
module                 contents
=====================  ====================================================
`component_container`  the executables: a process that waits for components
`component_manager`    `ComponentManager`: loads and unloads node classes
=====================  ====================================================
"""

from rclpy_components.component_manager import ComponentManager

__all__ = ["ComponentManager"]
