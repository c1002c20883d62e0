"""Components: installed ones, and those in containers."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from ros2cli.node.direct import DirectNode
from ros2component.containers import COMPONENT_ARGUMENTS, LIST_TIMEOUT_S, ask, container_names

if TYPE_CHECKING:
    import subprocess

    from ros2node.api import NodeName

COMPONENTS_RESOURCE_TYPE = "rclcpp_components"


class ComponentInfo(NamedTuple):
    """A node in a container: its number there, and its full name."""

    uid: int
    name: str


def get_package_names_with_component_types() -> list[str]:
    """Return the names of the packages that register components."""
    from ament_index_python import get_resources

    return list(get_resources(COMPONENTS_RESOURCE_TYPE))


def get_package_component_types(*, package_name: str | None = None) -> list[str]:
    """Return the names of the components that a package registers.

    Raises:
        LookupError: The package registers no components.
    """
    from ament_index_python import get_resource

    text = get_resource(COMPONENTS_RESOURCE_TYPE, package_name or "")[0]
    # A line is `class;library`.
    return [line.partition(";")[0] for line in text.splitlines()]


def get_registered_component_types() -> list[tuple[str, list[str]]]:
    """Return the names of all packages with components, each with its components."""
    return [
        (name, get_package_component_types(package_name=name))
        for name in get_package_names_with_component_types()
    ]


def find_container_node_names(*, node: Any, node_names: Sequence[NodeName]) -> list[NodeName]:
    """Return the names of the component containers."""
    known = container_names(DirectNode.around(node).graph)
    return [name for name in node_names if name.full_name in known]


def get_components_in_container(
    *, node: Any, remote_container_node_name: str, timeout: float | None = LIST_TIMEOUT_S
) -> tuple[bool, list[ComponentInfo] | str]:
    """Return the nodes in a container: true and a list, or false and the reason.

    Args:
        node: The node that asks.
        remote_container_node_name: Full name of the container.
        timeout: Seconds to wait for its answer; None waits while it exists.
    """
    from composition_interfaces.srv import ListNodes

    try:
        answer = ask(
            DirectNode.around(node),
            remote_container_node_name,
            "list_nodes",
            ListNodes,
            ListNodes.Request(),
            timeout,
        )
    except RuntimeError as error:
        return False, str(error)
    pairs = zip(answer.unique_ids, answer.full_node_names, strict=True)
    return True, [ComponentInfo(uid, name) for uid, name in pairs]


def get_components_in_containers(
    *,
    node: Any,
    remote_containers_node_names: Sequence[str],
    timeout: float | None = LIST_TIMEOUT_S,
) -> dict[str, tuple[bool, list[ComponentInfo] | str]]:
    """Return `get_components_in_container` of each container, by name."""
    return {
        name: get_components_in_container(
            node=node, remote_container_node_name=name, timeout=timeout
        )
        for name in remote_containers_node_names
    }


def load_component_into_container(
    *,
    node: Any,
    remote_container_node_name: str,
    package_name: str,
    plugin_name: str,
    node_name: str | None = None,
    node_namespace: str | None = None,
    log_level: int | None = None,
    remap_rules: Sequence[str] | None = None,
    parameters: Sequence[Any] | None = None,
    extra_arguments: Sequence[Any] | None = None,
    timeout: float | None = None,
) -> tuple[int, str]:
    """Load a component; return the number and full name of its node.

    Args:
        node: The node that asks.
        remote_container_node_name: Full name of the container.
        package_name: Package of the component.
        plugin_name: Name of the component.
        node_name: Name of its node.
        node_namespace: Namespace of its node.
        log_level: Number of the least severity that is logged.
        remap_rules: Remappings, as ``from:=to``.
        parameters: ``rcl_interfaces/msg/Parameter`` messages.
        extra_arguments: The same, for the container.
        timeout: Seconds to wait for its answer; None waits while it exists.

    Raises:
        RuntimeError: The container cannot load it, or does not answer.
    """
    from composition_interfaces.srv import LoadNode

    request = LoadNode.Request(
        package_name=package_name,
        plugin_name=plugin_name,
        node_name=node_name or "",
        node_namespace=node_namespace or "",
        log_level=log_level or 0,
        remap_rules=list(remap_rules or ()),
        parameters=list(parameters or ()),
        extra_arguments=list(extra_arguments or ()),
    )
    direct = DirectNode.around(node)
    answer = ask(direct, remote_container_node_name, "load_node", LoadNode, request, timeout)
    if not answer.success:
        raise RuntimeError(f"Failed to load component: {answer.error_message}")
    return answer.unique_id, answer.full_node_name


def unload_component_from_container(
    *,
    node: Any,
    remote_container_node_name: str,
    component_uids: Sequence[int],
    timeout: float | None = None,
) -> Iterator[tuple[int, bool, str]]:
    """Unload nodes; yields the number, whether it failed, and why, after each of them.

    Args:
        node: The node that asks.
        remote_container_node_name: Full name of the container.
        component_uids: Numbers of the nodes.
        timeout: Seconds to wait for each answer; None waits while the container exists.

    Raises:
        RuntimeError: The container does not answer.
    """
    from composition_interfaces.srv import UnloadNode

    direct = DirectNode.around(node)
    for uid in component_uids:
        request = UnloadNode.Request(unique_id=uid)
        answer = ask(
            direct, remote_container_node_name, "unload_node", UnloadNode, request, timeout
        )
        yield uid, not answer.success, answer.error_message


def add_component_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments that describe a component."""
    from ros2cli.arguments import add_arguments

    add_arguments(parser, COMPONENT_ARGUMENTS)


def run_standalone_container(*, container_node_name: str) -> subprocess.Popen[bytes]:
    """Start a container in a separate process.

    Args:
        container_node_name: Its name.

    Returns:
        The process, which the caller ends.
    """
    import subprocess
    import sys

    words = [sys.executable, "-m", "rclpy_components.component_container"]
    remapping = ["--ros-args", "-r", f"__node:={container_node_name}"]
    return subprocess.Popen([*words, *remapping])  # noqa: S603


def container_node_name_completer(
    prefix: str, parsed_args: argparse.Namespace, **kwargs: Any
) -> list[str]:
    """Return the full names of the containers there are now."""
    with DirectNode(parsed_args) as node:
        return container_names(DirectNode.around(node).graph)


def package_with_components_name_completer(
    prefix: str, parsed_args: argparse.Namespace, **kwargs: Any
) -> list[str]:
    """Return the names of the packages that register components."""
    return get_package_names_with_component_types()


class ComponentTypeNameCompleter:
    """Offers the components of the package on the command line to the shell.

    Args:
        package_name_key: Attribute of the command line that is the package.
    """

    def __init__(self, *, package_name_key: str | None = None) -> None:
        self.package_name_key = package_name_key

    def __call__(self, prefix: str, parsed_args: argparse.Namespace, **kwargs: Any) -> list[str]:
        """Return the names of the components."""
        package = getattr(parsed_args, self.package_name_key or "", None) or ""
        return get_package_component_types(package_name=package)
