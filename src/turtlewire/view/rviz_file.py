"""Views as RViz saves them, ``.rviz`` files: read for what the page has, and written for RViz.

A view is what the page keeps: the fixed frame, what of the frames is drawn, and displays with
kind, topic and options. Which option of RViz is which of the page's stands in
:mod:`turtlewire.view.rviz_options`.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from turtlewire.view.rviz_options import CLASSES, class_for, from_rviz, to_rviz

if TYPE_CHECKING:
    import os
    from collections.abc import Iterator, Mapping

__all__ = ["RvizFileError", "SavedDisplay", "SavedView", "load_rviz", "read_rviz", "write_rviz"]

_MOST_DISPLAYS = 100
_DEEPEST_GROUP = 8
_LONGEST_FILE = 2**20
_PREFIX = "rviz_default_plugins/"
#: Options of RViz's TF and Grid displays that are the page's switches.
_SWITCHES = {"names": "Show Names", "axes": "Show Axes", "arrows": "Show Arrows"}
_TOOLS = ("MoveCamera", "Measure", "SetInitialPose", "SetGoal", "PublishPoint")


class RvizFileError(ValueError):
    """A text that is no view of RViz."""


@dataclass(frozen=True, slots=True)
class SavedDisplay:
    """A display of a view.

    Attributes:
        kind: Which display of the page.
        topic: What it shows.
        options: The page's options that the file gives; colours as ``#rrggbb``.
        visible: Whether it is switched on.
    """

    kind: str
    topic: str
    options: dict[str, object] = field(default_factory=dict)
    visible: bool = True


@dataclass(frozen=True, slots=True)
class SavedView:
    """A view.

    Attributes:
        fixed: The fixed frame; empty for the page's own choice.
        displays: Its displays.
        show: Which of ``names``, ``axes``, ``arrows`` and ``grid`` are drawn, where that is said.
        unread: One line of what the page has not, or the empty text.
    """

    fixed: str
    displays: tuple[SavedDisplay, ...]
    show: dict[str, bool] = field(default_factory=dict)
    unread: str = ""

    def header(self) -> dict[str, Any]:
        """The packet that tells the page."""
        displays = [
            {
                "kind": each.kind,
                "topic": each.topic,
                "options": each.options,
                "visible": each.visible,
            }
            for each in self.displays
        ]
        return {
            "type": "view",
            "fixed": self.fixed,
            "displays": displays,
            "show": self.show,
            "text": self.unread,
        }


def load_rviz(path: str | os.PathLike[str]) -> SavedView:
    """The view in a ``.rviz`` file.

    Raises:
        RvizFileError: It cannot be read, or is no such file; the text names it.
    """
    try:
        with open(path, encoding="utf-8", errors="replace") as file:
            text = file.read(_LONGEST_FILE + 1)
    except OSError as error:
        raise RvizFileError(f"{path} cannot be read: {error.strerror or error}") from error
    try:
        return read_rviz(text)
    except RvizFileError as error:
        raise RvizFileError(f"{path} is no view of RViz: {error}") from error


def read_rviz(text: str) -> SavedView:
    """The view in the text of a ``.rviz`` file, of ROS 2 or ROS 1.

    Raises:
        RvizFileError: The text is no such file.
    """
    manager = _mapping(_parsed(text).get("Visualization Manager"))
    if not manager:
        raise RvizFileError("the file has no 'Visualization Manager', as RViz's files have")
    fixed = _mapping(manager.get("Global Options")).get("Fixed Frame")
    displays: list[SavedDisplay] = []
    others: list[str] = []
    show: dict[str, bool] = {}
    for properties in _displays(manager):
        name = _short_class(properties)
        if name == "TF":
            show |= _switches(properties)
        elif name in {"Grid", "Axes"}:
            show[name.lower() if name == "Grid" else "axes"] = _is_on(properties)
        elif name in CLASSES:
            kind, _ = CLASSES[name]
            topic, options = from_rviz(name, properties)
            displays.append(SavedDisplay(kind, topic, options, _is_on(properties)))
        else:
            others.append(name or "a display without a class")
    # RViz's "<Fixed Frame>" stands in options of frames; as the fixed frame it says nothing.
    own = isinstance(fixed, str) and not fixed.startswith("<")
    return SavedView(str(fixed) if own else "", tuple(displays), show, _unread(others))


def write_rviz(view: SavedView, types: Mapping[str, str]) -> str:
    """The text of a ``.rviz`` file.

    Args:
        view: What to save.
        types: Message types by topic: they decide which of RViz's displays shows the topic.
    """
    import yaml

    shown = [_grid(view.show.get("grid", True)), _tf(view.show)]
    for display in view.displays:
        name = class_for(display.kind, types.get(display.topic, ""))
        if name is not None:
            properties = to_rviz(name, display.topic, display.options)
            shown.append({"Class": _PREFIX + name, "Enabled": display.visible, "Name": name}
                         | properties | {"Value": display.visible})  # fmt: skip
    manager = {
        "Class": "",
        "Displays": shown,
        "Enabled": True,
        "Global Options": {
            "Background Color": "48; 48; 48",
            "Fixed Frame": view.fixed or "map",
            "Frame Rate": 30,
        },
        "Name": "root",
        "Tools": [{"Class": _PREFIX + tool} for tool in _TOOLS],
        "Value": True,
        "Views": {"Current": {"Class": _PREFIX + "Orbit", "Name": "Current View"}, "Saved": None},
    }
    panels = [{"Class": "rviz_common/Displays", "Name": "Displays"}]
    content = {"Panels": panels, "Visualization Manager": manager}
    return str(yaml.safe_dump(content, sort_keys=False, allow_unicode=True))


def _parsed(text: str) -> dict[str, Any]:
    import yaml

    if len(text) > _LONGEST_FILE:
        raise RvizFileError(f"{len(text)} characters are too many for a .rviz file")
    try:
        content = yaml.safe_load(text)
    except (yaml.YAMLError, RecursionError, ValueError) as error:
        line = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise RvizFileError(f"the file is no YAML: {line}") from None
    if not isinstance(content, dict):
        raise RvizFileError("the file holds no properties, as RViz's files do")
    return content


def _displays(manager: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """All displays, those in groups that are switched on included."""
    left = [(each, 0) for each in reversed(_list(manager.get("Displays")))]
    count = 0
    while left and count < _MOST_DISPLAYS:
        properties, depth = left.pop()
        if not isinstance(properties, dict):
            continue
        count += 1
        if _short_class(properties) == "Group":
            if depth < _DEEPEST_GROUP and _is_on(properties):
                inner = reversed(_list(properties.get("Displays")))
                left += [(each, depth + 1) for each in inner][-_MOST_DISPLAYS:]
        else:
            yield properties


def _short_class(properties: dict[str, Any]) -> str:
    """``LaserScan`` of ``rviz_default_plugins/LaserScan``, or of ROS 1's ``rviz/LaserScan``."""
    return str(properties.get("Class") or "").rpartition("/")[2]


def _switches(properties: dict[str, Any]) -> dict[str, bool]:
    on = _is_on(properties)
    return {
        ours: on and bool(properties.get(theirs, ours != "names"))
        for ours, theirs in _SWITCHES.items()
    }


def _unread(others: list[str]) -> str:
    if not others:
        return ""
    return f"Not shown here, for the page has no such display: {', '.join(dict.fromkeys(others))}"


def _grid(visible: bool) -> dict[str, Any]:
    return {
        "Class": _PREFIX + "Grid",
        "Cell Size": 1,
        "Enabled": visible,
        "Name": "Grid",
        "Plane Cell Count": 10,
        "Reference Frame": "<Fixed Frame>",
        "Value": visible,
    }


def _tf(show: dict[str, bool]) -> dict[str, Any]:
    switches = {theirs: show.get(ours, True) for ours, theirs in _SWITCHES.items()}
    return {
        "Class": _PREFIX + "TF",
        "Enabled": True,
        "Frame Timeout": 15,
        "Name": "TF",
        **switches,
        "Value": True,
    }


def _is_on(properties: dict[str, Any]) -> bool:
    return properties.get("Enabled") is not False


def _mapping(value: object) -> dict[str, Any]:
    return value if isinstance(value, dict) else {}


def _list(value: object) -> list[Any]:
    return value if isinstance(value, list) else []
