"""Reads ``.rviz`` files, the views that RViz saves, as far as the page supports them.

A view consists of the fixed frame, the visible parts of frames, and displays with kind, topic and
options. :mod:`turtlewire_view.rviz_writing` writes views, and :mod:`turtlewire_view.rviz_options`
maps RViz's options to the page's.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cache
from typing import TYPE_CHECKING, Any, TypedDict

from turtlewire.terminal.printable import printable
from turtlewire.web.commands import is_finite_number
from turtlewire_view.rviz_options import CLASSES, from_rviz

if TYPE_CHECKING:
    import os

__all__ = [
    "SWITCHES",
    "Camera",
    "RvizFileError",
    "SavedDisplay",
    "SavedView",
    "camera_from",
    "camera_properties",
    "is_camera",
    "load_rviz",
    "numbered_displays",
    "read_rviz",
    "short_class",
]

_FIXED_FRAME = "<Fixed Frame>"
#: Kinds of RViz that look at a point; the others are at a position and look around.
_ORBITS = ("Orbit", "XYOrbit", "ThirdPersonFollower")
_TOP = "TopDownOrtho"
_DISTANCE, _ANGLE, _SCALE = 10.0, math.pi / 4, 10.0  # RViz's own defaults
_NEAREST_M, _FARTHEST_M = 1e-3, 1e7


class Camera(TypedDict):
    """The camera of a view.

    Attributes:
        kind: ``orbit``, or ``top`` for a picture from above.
        frame: The frame that the camera moves with; empty for the fixed frame.
        focus: What is in the middle: x, y, z in that frame [m].
        distance: From there to the eye [m].
        yaw: Direction from there to the eye about z [rad].
        pitch: How high the eye is above there [rad].
        scale: Pixels of a metre, from above; None where the file says none.
    """

    kind: str
    frame: str
    focus: list[float]
    distance: float
    yaw: float
    pitch: float
    scale: float | None


def camera_from(views: object) -> Camera | None:
    """Return the camera of the value of ``Views``; None if it has none that the page has, too."""
    current = _mapping(_mapping(views).get("Current"))
    kind = str(current.get("Class") or "").rpartition("/")[2]
    frame = str(current.get("Target Frame") or _FIXED_FRAME)
    camera = Camera(
        kind="orbit",
        frame="" if frame.startswith("<") else frame,
        focus=[0.0, 0.0, 0.0],
        distance=_DISTANCE,
        yaw=_ANGLE,
        pitch=_ANGLE,
        scale=None,
    )
    if kind == _TOP and "Scale" in current:
        x, y, scale = (_number(current, word, 0.0) for word in ("X", "Y", "Scale"))
        camera["kind"], camera["focus"], camera["scale"] = "top", [x, y, 0.0], abs(scale) or _SCALE
        return camera
    if kind not in _ORBITS or "Distance" not in current:
        return None
    point = _mapping(current.get("Focal Point"))
    camera["focus"] = [_number(point, axis, 0.0) for axis in "XYZ"]
    distance = _number(current, "Distance", _DISTANCE)
    camera["distance"] = min(max(distance, _NEAREST_M), _FARTHEST_M)
    camera["yaw"] = _number(current, "Yaw", _ANGLE)
    camera["pitch"] = _number(current, "Pitch", _ANGLE)
    return camera


def camera_properties(camera: Camera) -> dict[str, Any]:
    """Return the value of ``Current`` in ``Views``."""
    frame = camera["frame"] or _FIXED_FRAME
    properties: dict[str, Any] = {"Name": "Current View", "Target Frame": frame}
    x, y, z = camera["focus"]
    if camera["kind"] == "top":
        top = {"Class": f"rviz_default_plugins/{_TOP}", "Value": f"{_TOP} (rviz_default_plugins)"}
        return properties | top | {"Angle": 0, "Scale": camera["scale"] or _SCALE, "X": x, "Y": y}
    return properties | {
        "Class": "rviz_default_plugins/Orbit",
        "Distance": camera["distance"],
        "Focal Point": {"X": x, "Y": y, "Z": z},
        "Pitch": camera["pitch"],
        "Value": "Orbit (rviz_default_plugins)",
        "Yaw": camera["yaw"],
    }


def is_camera(value: object) -> bool:
    """Return True if a page's answer describes a camera."""
    if not isinstance(value, Mapping) or value.get("kind") not in ("orbit", "top"):
        return False
    focus, scale = value.get("focus"), value.get("scale")
    return (
        isinstance(value.get("frame"), str)
        and isinstance(focus, list)
        and len(focus) == 3
        and all(map(is_finite_number, focus))
        and all(is_finite_number(value.get(word)) for word in ("distance", "yaw", "pitch"))
        and (scale is None or is_finite_number(scale))
    )


def _number(properties: Mapping[str, Any], word: str, default: float) -> float:
    value = properties.get(word, default)
    return float(value) if is_finite_number(value) and abs(value) < _FARTHEST_M else default


def _mapping(value: object) -> dict[str, Any]:
    return value if isinstance(value, dict) else {}


_MOST_DISPLAYS = 100
_DEEPEST_GROUP = 8
_LONGEST_FILE = 2**20
#: Options of RViz's TF and Grid displays that are the page's switches.
SWITCHES = {"names": "Show Names", "axes": "Show Axes", "arrows": "Show Arrows"}


class RvizFileError(ValueError):
    """The text is not an RViz view."""


@dataclass(frozen=True, slots=True)
class SavedDisplay:
    """A display of a view.

    Attributes:
        kind: Which display of the page.
        topic: What it shows.
        options: The page's options that the file gives; colours as ``#rrggbb``.
        visible: Whether it is switched on.
        place: Its number in the file that it was read from, or None.
    """

    kind: str
    topic: str
    options: dict[str, object] = field(default_factory=dict)
    visible: bool = True
    place: int | None = None


@dataclass(frozen=True, slots=True)
class SavedView:
    """A view.

    Attributes:
        fixed: The fixed frame; empty for the page's own choice.
        displays: Its displays.
        show: Which of ``names``, ``axes``, ``arrows`` and ``grid`` are drawn, where that is said.
        unread: One line with unsupported displays and invalid values, or an empty string.
        document: The whole content of the file.
        token: Names the file when it is written again.
        camera: How it is looked at; None for the page's own choice.
    """

    fixed: str
    displays: tuple[SavedDisplay, ...]
    show: dict[str, bool] = field(default_factory=dict)
    unread: str = ""
    document: dict[str, Any] = field(default_factory=dict, compare=False)
    token: str = ""
    camera: Camera | None = None

    def header(self) -> dict[str, Any]:
        """Return the packet for the page."""
        displays = [
            {
                "kind": each.kind,
                "topic": each.topic,
                "options": each.options,
                "visible": each.visible,
                "place": each.place,
            }
            for each in self.displays
        ]
        return {
            "type": "view",
            "fixed": self.fixed,
            "displays": displays,
            "show": self.show,
            "text": self.unread,
            "document": self.token,
            "camera": self.camera,
        }


def load_rviz(path: str | os.PathLike[str]) -> SavedView:
    """Return the view in a ``.rviz`` file.

    Raises:
        RvizFileError: The file cannot be read, or is not an RViz file; the message names it.
    """
    try:
        with open(path, encoding="utf-8", errors="replace") as file:
            text = file.read(_LONGEST_FILE + 1)
    except OSError as error:
        raise RvizFileError(f"{path} cannot be read: {error.strerror or error}") from None
    try:
        return read_rviz(text)
    except RvizFileError as error:
        raise RvizFileError(f"{path} is not an RViz view: {error}") from None


def read_rviz(text: str) -> SavedView:
    """Return the view in the text of a ``.rviz`` file, of ROS 2 or ROS 1.

    Raises:
        RvizFileError: The text is no such file.
    """
    content = _parsed(text)
    manager = _mapping(content.get("Visualization Manager"))
    if not manager:
        raise RvizFileError("the file has no 'Visualization Manager', as RViz's files have")
    fixed = _mapping(manager.get("Global Options")).get("Fixed Frame")
    displays: list[SavedDisplay] = []
    others: list[str] = []
    refused: list[str] = []
    show: dict[str, bool] = {}
    for place, properties in numbered_displays(manager):
        name = short_class(properties)
        if name == "TF":
            show |= _switches(properties)
        elif name in {"Grid", "Axes"}:
            show[name.lower() if name == "Grid" else "axes"] = _is_on(properties)
        elif name in CLASSES:
            kind, _ = CLASSES[name]
            topic, options, problems = from_rviz(name, properties)
            displays.append(SavedDisplay(kind, topic, options, _is_on(properties), place))
            refused += [f"{name}: {problem}" for problem in problems]
        else:
            others.append(name or "a display without a class")
    # "<Fixed Frame>" is a value of RViz's frame options; as the fixed frame it has no meaning.
    own = isinstance(fixed, str) and not fixed.startswith("<")
    token = hashlib.sha256(text.encode(errors="replace")).hexdigest()[:16]
    unread = _unread(others, refused)
    fixed_frame = str(fixed) if own else ""
    camera = camera_from(manager.get("Views"))
    return SavedView(fixed_frame, tuple(displays), show, unread, content, token, camera)


def _parsed(text: str) -> dict[str, Any]:
    import yaml

    if len(text) > _LONGEST_FILE:
        raise RvizFileError(f"{len(text)} characters are too many for a .rviz file")
    try:
        content = yaml.load(text, _loader())  # noqa: S506 - it derives from the safe one
    except RvizFileError:
        raise
    except RecursionError:
        raise RvizFileError("the file is not YAML: nested too deeply") from None
    except (yaml.YAMLError, ValueError) as error:
        line = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise RvizFileError(f"the file is not YAML: {line}") from None
    if not isinstance(content, dict):
        raise RvizFileError("the file holds no properties, as RViz's files do")
    return content


@cache
def _loader() -> type[Any]:
    """Return PyYAML's safe loader, without the values that a short text makes too large."""
    import yaml

    class Loader(yaml.SafeLoader):
        def compose_node(self, parent: Any, index: Any) -> Any:
            # A few lines of aliases can stand for a billion values.
            if self.check_event(yaml.AliasEvent):
                raise RvizFileError("it has YAML aliases, such as *name, which RViz does not write")
            return super().compose_node(parent, index)

        def construct_yaml_int(self, node: Any) -> float:  # type: ignore[override]
            number: int = super().construct_yaml_int(node)
            try:
                float(number)
            except OverflowError:  # as YAML reads 1e999
                return math.inf if number > 0 else -math.inf
            return number

    Loader.add_constructor("tag:yaml.org,2002:int", Loader.construct_yaml_int)
    return Loader


def numbered_displays(manager: dict[str, Any]) -> Iterator[tuple[int, dict[str, Any]]]:
    """Yield all displays with their numbers, those in groups that are switched on included."""
    left = [(each, 0) for each in reversed(_list(manager.get("Displays")))]
    count = 0
    while left and count < _MOST_DISPLAYS:
        properties, depth = left.pop()
        if not isinstance(properties, dict):
            continue
        count += 1
        if short_class(properties) == "Group":
            if depth < _DEEPEST_GROUP and _is_on(properties):
                inner = reversed(_list(properties.get("Displays")))
                left += [(each, depth + 1) for each in inner][-_MOST_DISPLAYS:]
        else:
            yield count, properties


def short_class(properties: dict[str, Any]) -> str:
    """``LaserScan`` of ``rviz_default_plugins/LaserScan``, or of ROS 1's ``rviz/LaserScan``."""
    return str(properties.get("Class") or "").rpartition("/")[2]


def _switches(properties: dict[str, Any]) -> dict[str, bool]:
    on = _is_on(properties)
    return {
        ours: on and bool(properties.get(theirs, ours != "names"))
        for ours, theirs in SWITCHES.items()
    }


def _unread(others: list[str], refused: list[str]) -> str:
    parts = []
    if others:
        names = ", ".join(dict.fromkeys(others))
        parts.append(f"Unsupported displays: {names}")
    if refused:
        more = f" (and {len(refused) - 3} more)" if len(refused) > 3 else ""
        parts.append(f"Invalid values, defaults used: {'; '.join(refused[:3])}{more}")
    return printable(". ".join(parts))


def _is_on(properties: dict[str, Any]) -> bool:
    return properties.get("Enabled") is not False


def _list(value: object) -> list[Any]:
    return value if isinstance(value, list) else []
