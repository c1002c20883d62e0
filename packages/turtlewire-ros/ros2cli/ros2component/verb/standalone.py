"""``ros2 component standalone``."""

from __future__ import annotations

import argparse

from ros2cli.arguments import argument
from ros2component.containers import COMPONENT_ARGUMENTS, load_request
from ros2component.verb import VerbExtension

ARGUMENTS = (
    argument(
        "-c", "--container-node-name", default="standalone_container", help="Name of the container"
    ),
    *COMPONENT_ARGUMENTS,
)


def main(args: argparse.Namespace) -> str | None:
    """Run the node until Ctrl-C."""
    import rclpy
    from composition_interfaces.srv import LoadNode
    from rclpy.executors import ExternalShutdownException
    from rclpy_components import ComponentManager

    rclpy.init(args=[])
    container = ComponentManager(args.container_node_name)
    try:
        answer = container.load(load_request(args), LoadNode.Response())
        if not answer.success:
            return f"Failed to load component: {answer.error_message}"
        print(f"Loaded component {answer.unique_id} as '{answer.full_node_name}'")
        rclpy.spin(container)
    except ExternalShutdownException as error:
        raise KeyboardInterrupt from error
    finally:
        container.destroy_node()
        rclpy.try_shutdown()
    return None


class StandaloneVerb(VerbExtension, module=__name__):
    """Run a node in its own container."""
