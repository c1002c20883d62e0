"""Loads node classes into this process, each with its own executor and thread."""

from __future__ import annotations

import importlib.util
import sys
import threading
import traceback
from typing import TYPE_CHECKING, Any

from composition_interfaces.srv import ListNodes, LoadNode, UnloadNode
from rclpy.executors import ExternalShutdownException, ShutdownException, SingleThreadedExecutor
from rclpy.node import Node, component_arguments
from rclpy.parameter import parameter_value_to_python
from turtlewire.terminal.printable import printable, printable_lines
from turtlewire_ros.prefix import package_prefix
from turtlewire_ros.workspace_hints import package_hint

if TYPE_CHECKING:
    from rclpy.context import Context


class ComponentManager(Node):
    """Offers ROS 2's services that load, unload and list components (``~/_container/load_node`` …).

    A component is a class of nodes, given as ``package.module.Class``; the name of a component of
    C++, ``package::Class``, stands for ``package.Class``. It is constructed without arguments, as
    its own ``main()`` would do it; name, namespace, parameters and remappings of the request apply
    to it like a command line's. Components do not wait for each other: each runs in a thread of its
    own.
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
        except _UnknownPluginError as error:
            self.get_logger().error(printable(error.reason))
            response.error_message = str(error)
            return response
        except Exception as error:  # noqa: BLE001  components are other people's code
            self.get_logger().error(
                printable_lines(
                    f"Component constructor threw an exception: {error}\n{traceback.format_exc()}"
                )
            )
            response.error_message = f"{type(error).__name__}: {error}"
            return response
        self._last_id += 1
        self._components[self._last_id] = _Component(node, self.context)
        response.success = True
        response.full_node_name = node.get_fully_qualified_name()
        response.unique_id = self._last_id
        return response

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
    """A node that runs in its own thread."""

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
        except Exception:  # noqa: BLE001  the other components keep running
            if self.node.context.ok():  # otherwise, it failed because the process is ending
                self.node.get_logger().fatal(
                    f"The component ends because a callback failed:\n{traceback.format_exc()}"
                )

    def unload(self) -> None:
        self._executor.shutdown()
        # The thread ends before the node, which its callbacks may use.
        self._thread.join()
        self.node.destroy_node()


class _UnknownPluginError(Exception):
    """The package is not installed, or no Python class has the name of this C++ component.

    Args:
        message: ROS 2's text for a package that is not installed or does not have the component.
        reason: What the log says.
    """

    def __init__(self, message: str, reason: str) -> None:
        super().__init__(message)
        self.reason = reason


def _check_package(name: str) -> None:
    """Raise `_UnknownPluginError` if neither ROS nor Python has a package of this name."""
    is_known = package_prefix(name) is not None or name in sys.modules
    # `find_spec` imports the package before a dot, and accepts no empty name.
    if not is_known and not (name.isidentifier() and importlib.util.find_spec(name)):
        raise _UnknownPluginError(
            "Could not find requested resource in ament index",
            f"Package '{name}' not found. {package_hint(name)}",
        )


def _component_class(plugin: str, package: str) -> Any:
    module_name, _, class_name = plugin.replace("::", ".").replace(":", ".").rpartition(".")
    if not module_name:
        raise ValueError(
            f"'{plugin}' is not a component of {package}; expected 'package.module.Class'"
        )
    if "::" not in plugin:
        return getattr(importlib.import_module(module_name), class_name)
    try:
        module = importlib.import_module(module_name)
    except ModuleNotFoundError as error:
        raise _UnknownPluginError(
            "Could not find requested resource in ament index",
            f"'{plugin}' is a C++ component, and no Python class has its name: {error}. "
            "Load a class of nodes in Python: 'package.module.Class'",
        ) from error
    if not hasattr(module, class_name):
        names = ", ".join(getattr(module, "__all__", ())) or "no components"
        raise _UnknownPluginError(
            "Failed to find class with the requested plugin name.",
            f"'{plugin}' is a C++ component, and no Python class has its name: "
            f"{module_name} has {names}",
        )
    return getattr(module, class_name)


def _construct(request: Any) -> Node:
    _check_package(request.package_name)
    node_class = _component_class(request.plugin_name, request.package_name)
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
        # YAML has no `array.array`.
        value = list(value) if hasattr(value, "typecode") else value
        # On one line; after a plain scalar, PyYAML appends a document end.
        text = (
            yaml.safe_dump(value, default_flow_style=True, width=10**6, allow_unicode=True)
            .removesuffix("...\n")
            .strip()
        )
        words += ["-p", f"{parameter.name}:={text}"]
    return words
