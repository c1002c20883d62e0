"""Writes views as ``.rviz`` files; settings that the page does not support stay unchanged."""

from __future__ import annotations

from collections.abc import Mapping
from copy import deepcopy
from typing import TYPE_CHECKING, Any

from turtlewire_view.rviz_file import (
    SWITCHES,
    SavedDisplay,
    SavedView,
    camera_properties,
    numbered_displays,
    short_class,
)
from turtlewire_view.rviz_options import CLASSES, class_for, to_rviz

if TYPE_CHECKING:
    from turtlewire_view.rviz_file import Camera

__all__ = ["write_rviz"]

_PREFIX = "rviz_default_plugins/"
_TOOLS = ("MoveCamera", "Measure", "SetInitialPose", "SetGoal", "PublishPoint")


def write_rviz(view: SavedView, types: Mapping[str, str], former: SavedView | None = None) -> str:
    """Return the text of a ``.rviz`` file.

    Args:
        view: What to save.
        types: Message types by topic: they decide which of RViz's displays shows the topic.
        former: The view that was read before. Its displays that the page does not have, its panels,
            its camera if the view says none, the QoS of its topics and further properties stay.
    """
    import yaml

    content = _new_file() if former is None else deepcopy(former.document)
    manager: dict[str, Any] = content["Visualization Manager"]
    options = manager.get("Global Options")
    manager["Global Options"] = options = options if isinstance(options, dict) else {}
    options["Fixed Frame"] = view.fixed or options.get("Fixed Frame") or "map"
    if view.camera is not None and (former is None or view.camera != former.camera):
        manager["Views"] = _looked_at(manager.get("Views"), view.camera)
    at_place = {each.place: each for each in view.displays if each.place is not None}
    seen, gone = set(), list[int]()
    for place, properties in numbered_displays(manager):
        name = short_class(properties)
        if name in {"TF", "Grid"}:
            seen.add(name)
            _switch(properties, name, view.show)
        elif name in CLASSES:
            shown = at_place.pop(place, None)
            if shown is None or CLASSES[name][0] != shown.kind:
                gone.append(id(properties))
            else:
                _update(properties, name, shown)
    manager["Displays"] = _without(manager.get("Displays"), gone)
    manager["Displays"] += _frames_and_grid(view.show, {"TF", "Grid"} - seen)
    new = [each for each in view.displays if each.place is None or each.place in at_place]
    manager["Displays"] += [entry for each in new if (entry := _entry(each, types)) is not None]
    return str(yaml.safe_dump(content, sort_keys=False, allow_unicode=True))


def _new_file() -> dict[str, Any]:
    manager = {
        "Class": "",
        "Displays": [],
        "Enabled": True,
        "Global Options": {"Background Color": "48; 48; 48", "Fixed Frame": "", "Frame Rate": 30},
        "Name": "root",
        "Tools": [{"Class": _PREFIX + tool} for tool in _TOOLS],
        "Value": True,
        "Views": {"Current": {"Class": _PREFIX + "Orbit", "Name": "Current View"}, "Saved": None},
    }
    panels = [{"Class": "rviz_common/Displays", "Name": "Displays"}]
    return {"Panels": panels, "Visualization Manager": manager}


def _looked_at(views: object, camera: Camera) -> dict[str, Any]:
    """The value of ``Views`` with this camera; a former one of its kind keeps other properties."""
    kept = views if isinstance(views, dict) else {"Saved": None}
    former, ours = kept.get("Current"), camera_properties(camera)
    if isinstance(former, dict) and former.get("Class") == ours["Class"]:
        ours = former | ours
    return kept | {"Current": ours}


def _entry(display: SavedDisplay, types: Mapping[str, str]) -> dict[str, Any] | None:
    """Return a display that no file had before; None if RViz has none for it."""
    name = class_for(display.kind, types.get(display.topic, ""))
    if name is None:
        return None
    head = {"Class": _PREFIX + name, "Enabled": display.visible, "Name": name}
    return head | to_rviz(name, display.topic, display.options) | {"Value": display.visible}


def _update(properties: dict[str, Any], name: str, display: SavedDisplay) -> None:
    """Change what the user may have changed; all else stays, with the QoS of the topic."""
    properties["Enabled"] = properties["Value"] = display.visible
    _merge(properties, to_rviz(name, display.topic, display.options))


def _merge(kept: dict[str, Any], ours: Mapping[str, Any]) -> None:
    for name, value in ours.items():
        there = kept.get(name)
        if isinstance(there, dict) and isinstance(value, dict):
            is_topic = name.endswith("Topic")
            _merge(there, {"Value": value["Value"]} if is_topic else value)
        else:
            kept[name] = value


def _without(displays: object, gone: list[int]) -> list[Any]:
    """Return a list of displays and groups of them, without those whose identities are given."""
    left = []
    for each in displays if isinstance(displays, list) else []:
        if id(each) in gone:
            continue
        if isinstance(each, dict) and short_class(each) == "Group" and "Displays" in each:
            each["Displays"] = _without(each["Displays"], gone)
        left.append(each)
    return left


def _frames_and_grid(show: Mapping[str, bool], wanted: set[str]) -> list[dict[str, Any]]:
    grid = {
        "Class": _PREFIX + "Grid",
        "Cell Size": 1,
        "Name": "Grid",
        "Plane Cell Count": 10,
        "Reference Frame": "<Fixed Frame>",
    }
    frames = {"Class": _PREFIX + "TF", "Enabled": True, "Frame Timeout": 15, "Name": "TF"}
    made = {"Grid": grid, "TF": {**frames, "Value": True}}
    for name, properties in made.items():
        _switch(properties, name, show)
    return [properties for name, properties in made.items() if name in wanted]


def _switch(properties: dict[str, Any], name: str, show: Mapping[str, bool]) -> None:
    """The page's switches of what is drawn."""
    if name == "Grid":
        properties["Enabled"] = properties["Value"] = show.get("grid", True)
    elif properties.get("Enabled") is not False or any(show.get(ours) for ours in SWITCHES):
        properties["Enabled"] = properties["Value"] = True
        properties |= {theirs: show.get(ours, True) for ours, theirs in SWITCHES.items()}
