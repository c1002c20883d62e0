"""The commands of the page, see :mod:`turtlewire.web.commands`."""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

from turtlewire.web.commands import Between, CommandReader

__all__ = [
    "READER",
    "AddDisplay",
    "ChangeDisplay",
    "ChangePace",
    "ChooseFixedFrame",
    "ChooseRelation",
    "GiveFeedback",
    "LoadView",
    "MoveJoints",
    "PauseTime",
    "PlayTime",
    "PublishWithTool",
    "RemoveDisplay",
    "SaveView",
    "SeekTime",
    "SetBudget",
]


class ChooseFixedFrame(NamedTuple):
    """The frame that everything is drawn in; empty takes the root of the largest tree."""

    frame: str


class ChooseRelation(NamedTuple):
    """Send the transform between two frames, or none."""

    target: str | None
    source: str = ""


class AddDisplay(NamedTuple):
    """Show a topic; ``id`` is the page's name of the display."""

    id: str
    kind: str
    topic: str
    options: dict[str, Any]


class RemoveDisplay(NamedTuple):
    """Show a topic no longer."""

    id: str


class ChangeDisplay(NamedTuple):
    """Show a topic with other options."""

    id: str
    options: dict[str, Any]


class SetBudget(NamedTuple):
    """The number of points that the page can draw."""

    points: Annotated[float, Between(1, 1e12)]


class PauseTime(NamedTuple):
    """Stop the time."""


class PlayTime(NamedTuple):
    """Let the time run; live data is shown as it comes."""


class SeekTime(NamedTuple):
    """Show another time [s]."""

    stamp: Annotated[float, Between(0, 1e12)]


class ChangePace(NamedTuple):
    """Seconds of a bag in a second."""

    factor: Annotated[float, Between(1e-9, 1e12)]


class PublishWithTool(NamedTuple):
    """Publish with a tool.

    Attributes:
        tool: See :mod:`turtlewire_view.page_requests`.
        position: Three numbers in the page's coordinates: the fixed frame's less the origin.
        yaw: Direction about z [rad].
        topic: Empty for RViz's topic of the tool.
    """

    tool: str
    position: list[Any]
    yaw: float = 0.0
    topic: str = ""


class GiveFeedback(NamedTuple):
    """Tell the server of an interactive marker what the user does with it.

    Attributes:
        id: The display.
        marker: Name of the marker.
        control: Name of the control.
        event: An ``event_type`` of InteractiveMarkerFeedback.
        pose: The marker's pose in its frame: x, y, z, qx, qy, qz, qw.
        menu_entry: Which entry of the menu was selected.
        mouse_point: What the pointer is on, in the marker's frame, or None.
    """

    id: str
    marker: str
    control: str
    event: float
    pose: list[Any]
    menu_entry: float = 0
    mouse_point: list[Any] | None = None


class SaveView(NamedTuple):
    """Write a ``.rviz`` file; all but ``document`` is as in the ``view`` packet.

    Attributes:
        document: The token of the file that was loaded before.
    """

    fixed: str
    displays: list[Any]
    show: dict[str, Any]
    camera: dict[str, Any] | None = None
    document: str | None = None


class MoveJoints(NamedTuple):
    """Put joints of the robot to positions [rad or m], by name."""

    positions: dict[str, Any]


class LoadView(NamedTuple):
    """Show what a ``.rviz`` file holds."""

    text: Annotated[str, Between(0, 65536)]


READER = CommandReader(
    {
        "fixed": ChooseFixedFrame,
        "relation": ChooseRelation,
        "add": AddDisplay,
        "remove": RemoveDisplay,
        "options": ChangeDisplay,
        "budget": SetBudget,
        "pause": PauseTime,
        "play": PlayTime,
        "seek": SeekTime,
        "speed": ChangePace,
        "publish": PublishWithTool,
        "feedback": GiveFeedback,
        "save": SaveView,
        "load": LoadView,
        "move": MoveJoints,
    }
)
