"""Loads node classes into this process, each with an executor and a thread of its own."""

from __future__ import annotations

import importlib
import threading
import traceback
from typing import TYPE_CHECKING, Any

from composition_interfaces.srv import ListNodes, LoadNode, UnloadNode
from rclpy.executors import ExternalShutdownException, ShutdownException, SingleThreadedExecutor
from rclpy.node import Node, component_arguments
from rclpy.parameter import parameter_value_to_python
from turtlewire.terminal.printable import printable, printable_lines

if TYPE_CHECKING:
    from rclpy.context import Context

__all__ = ["ComponentManager"]


class ComponentManager(Node):
    """Offers ROS 2's services that load, unload and list components (``~/_container/load_node`` …).

    A component is a class of nodes, given as ``package.module.Class``. It is constructed without
    arguments, as its own ``main()`` would do it; name, namespace, parameters and remappings of the
    request apply to it like a command line's. Components do not wait for each other: each
    runs in a thread of its own.
    """

    def __init__(self, node_name: str = "ComponentManager", **options: Any) -> None:
        super().__init__(node_name, start_parameter_services=False, **options)
        self._components: dict[int, _Component] = {}
        self._last_id = 0
        self.create_service(LoadNode, "~/_container/load_node", self.load)
        self.create_service(UnloadNode, "~/_container/unload_node", self._on_unload)
        self.create_service(ListNodes, "~/_container/list_nodes", self._on_list)

    def destroy_node(self) -> None:
        """Unload all components, then end."""
        while self._components:
            self._components.popitem()[1].unload()
        super().destroy_node()

    def load(self, request: Any, response: Any) -> Any:
        """Load a component, as the service ``load_node`` does; returns the filled response."""
        try:
            node = _construct(request)
        except Exception as error:  # noqa: BLE001  components are other people's code
            response.error_message = self._told(error, request)
            return response
        self._last_id += 1
        self._components[self._last_id] = _Component(node, self.context)
        response.success = True
        response.full_node_name = node.get_fully_qualified_name()
        response.unique_id = self._last_id
        return response

    def _told(self, error: Exception, request: Any) -> str:
        """Log why a component was not loaded; returns the text of the response."""
        if isinstance(error, ModuleNotFoundError) and "::" in request.plugin_name:
            self.get_logger().error(
                printable(f"'{request.plugin_name}' is a component of C++: {error}")
            )
            return "Could not find requested resource in ament index"
        self.get_logger().error(
            printable_lines(
                f"Component constructor threw an exception: {error}\n{traceback.format_exc()}"
            )
        )
        return f"{type(error).__name__}: {error}"

    def _on_unload(self, request: Any, response: Any) -> Any:
        component = self._components.pop(request.unique_id, None)
        if component is None:
            response.error_message = f"No node found with unique_id: {request.unique_id}"
            self.get_logger().warning(response.error_message)
            return response
        component.unload()
        response.success = True
        return response

    def _on_list(self, _request: Any, response: Any) -> Any:
        response.unique_ids = list(self._components)
        response.full_node_names = [
            component.node.get_fully_qualified_name() for component in self._components.values()
        ]
        return response


class _Component:
    """A node that runs in a thread of its own."""

    def __init__(self, node: Node, context: Context) -> None:
        self.node = node
        self._executor = SingleThreadedExecutor(context=context)
        self._executor.add_node(node)
        self._thread = threading.Thread(target=self._run, name=node.get_name(), daemon=True)
        self._thread.start()

    def _run(self) -> None:
        try:
            self._executor.spin()
        except (ExternalShutdownException, ShutdownException):
            pass
        except Exception:  # noqa: BLE001  the other components of the process go on
            if self.node.context.ok():  # otherwise it failed because the process ends meanwhile
                self.node.get_logger().fatal(
                    f"The component ends, for a callback failed:\n{traceback.format_exc()}"
                )

    def unload(self) -> None:
        self._executor.shutdown()
        self._thread.join()
        self.node.destroy_node()


def _construct(request: Any) -> Node:
    module_name, _, class_name = request.plugin_name.replace(":", ".").rpartition(".")
    if not module_name:
        raise ValueError(
            f"'{request.plugin_name}' is not a component of {request.package_name}; "
            "expected 'package.module.Class'"
        )
    node_class = getattr(importlib.import_module(module_name), class_name)
    token = component_arguments.set(_words(request))
    try:
        node = node_class()
    finally:
        component_arguments.reset(token)
    if not isinstance(node, Node):
        raise TypeError(
            f"'{request.plugin_name}' creates a {type(node).__name__}, which is not a node"
        )
    if request.log_level:
        node.get_logger().set_level(request.log_level)
    return node


def _words(request: Any) -> list[str]:
    """Return the request as a command line."""
    import yaml

    rules = list(request.remap_rules)
    rules += [f"__node:={request.node_name}"] * bool(request.node_name)
    rules += [f"__ns:={request.node_namespace}"] * bool(request.node_namespace)
    words = ["--ros-args"]
    for rule in rules:
        words += ["-r", rule]
    for parameter in request.parameters:
        value = parameter_value_to_python(parameter.value)
        value = list(value) if hasattr(value, "typecode") else value
        text = (
            yaml.safe_dump(value, default_flow_style=True, width=10**6, allow_unicode=True)
            .removesuffix("...\n")
            .strip()
        )
        words += ["-p", f"{parameter.name}:={text}"]
    return words
