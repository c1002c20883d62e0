"""The node: publishes joint states as ``joint_state_publisher`` does, with values from a page."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

from joint_state_publisher.joint_state_publisher import JointStatePublisher, run
from joint_state_publisher_gui.page_commands import Center, Randomize
from joint_state_publisher_gui.screen import SliderScreen
from joint_state_publisher_gui.sliders import Sliders
from turtlewire.web.desktop import open_browser, wanted_lan, wanted_port
from turtlewire.web.lan import invite

if TYPE_CHECKING:
    import argparse

    from joint_state_publisher_gui.page_commands import Command


class JointStatePublisherGui(JointStatePublisher):
    """The node and its page.

    As in ROS 2, it is called ``joint_state_publisher``. States are published at ``rate``.

    Args:
        description_file: As for :class:`JointStatePublisher`.
        lan: Whether to serve the page to other devices of the network as well.
        **options: As for :class:`rclpy.node.Node`.

    Attributes:
        url: The page's address.
    """

    def __init__(
        self, description_file: str | None = None, *, lan: bool = False, **options: Any
    ) -> None:
        # Set first: with a file, the base's constructor calls `joints_changed`.
        self._screen: SliderScreen | None = None
        self._sliders: Sliders | None = None
        super().__init__(description_file, **options)
        self._sliders = Sliders(self.joints)
        self._screen = SliderScreen(
            self.get_fully_qualified_name(), self._sliders, self._obey, lan=lan
        )
        self.url = self._screen.url
        self.get_logger().info(f"The joints' sliders are at {self.url}")
        if lan:
            invite(self.url, self.get_logger().info)
        open_browser(self.url)

    def destroy_node(self) -> None:
        """Stop serving the page, then leave the graph."""
        if self._screen is not None:
            self._screen.close()
        super().destroy_node()

    def joints_changed(self) -> None:
        """Show the joints of a new description."""
        if self._sliders is not None:
            self._sliders.show(self.joints)
            self.values_changed()

    def values_changed(self) -> None:
        """Show the present values."""
        if self._screen is not None:
            self._screen.update()

    def advance(self) -> None:
        """Move the joints that play, and all by ``delta`` if that is set."""
        super().advance()
        if self._sliders is not None:
            self._sliders.advance(1.0 / self.rate)

    def _obey(self, command: Command) -> None:
        if isinstance(command, Randomize):
            self.get_logger().info("Randomizing")
        elif isinstance(command, Center):
            self.get_logger().info("Centering")
        if self._sliders is not None:
            self._sliders.obey(command)


def main(args: list[str] | None = None) -> int:
    """Publish joint states and serve the page until Ctrl-C."""
    try:
        # Only to report a wrong number in one line, before the node starts.
        wanted_port()
    except ValueError as error:
        print(error, file=sys.stderr)  # noqa: T201 - there is no node yet that could log it
        return 1
    return run(JointStatePublisherGui, args, add_options=_add_options)


def _add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--lan",
        action="store_true",
        default=wanted_lan(),
        help="also serve the page to other devices on the network that have its address",
    )
