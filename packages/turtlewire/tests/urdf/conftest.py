"""Our own robots as URDF: shapes of real robots, with numbers that expose errors.

Origins and axes are drawn from a seeded generator where a real robot would have round numbers: a
wrong sign or order of rotations must not cancel out.
"""

import random

import pytest

LIMIT = '<limit lower="-2" upper="1.5" effort="10" velocity="3"/>'


class Builder:
    """Collects the elements of a URDF."""

    def __init__(self, name):
        self._random = random.Random(name)
        self._name = name
        self._elements = ['<link name="base"/>']

    def numbers(self, count, spread):
        return " ".join(f"{self._random.uniform(-spread, spread):.6f}" for _ in range(count))

    def joint(self, kind, parent, child, *, axis=None, mimic="", name=None):
        """A link and the joint above it."""
        limit = LIMIT if kind in ("revolute", "prismatic") else ""
        axis = axis or self.numbers(3, 2.0)
        self._elements.append(
            f'<link name="{child}"/>'
            f'<joint name="{name or child + "_joint"}" type="{kind}">'
            f'<parent link="{parent}"/><child link="{child}"/>'
            f'<origin xyz="{self.numbers(3, 0.5)}" rpy="{self.numbers(3, 3.1)}"/>'
            f'<axis xyz="{axis}"/>{limit}{mimic}</joint>'
        )
        return child

    def text(self):
        return "\n".join([f'<robot name="{self._name}">', *self._elements, "</robot>"])


def arm():
    """Six revolute joints in a row, a tool that is fixed."""
    builder = Builder("arm")
    link = "base"
    for number in range(6):
        axis = ("0 0 1", "0 1 0", "0 -1 0", "1 0 0", None, "0 0 -3")[number]
        link = builder.joint("revolute", link, f"arm_{number}", axis=axis)
    builder.joint("fixed", link, "tool")
    return builder.text()


def walker(name, legs):
    """A body with legs of three joints and a fixed foot."""
    builder = Builder(name)
    for leg in range(legs):
        link = builder.joint("fixed", "base", f"hip_{leg}")
        for part in ("coxa", "femur", "tibia"):
            link = builder.joint("revolute", link, f"{part}_{leg}")
        builder.joint("fixed", link, f"foot_{leg}")
    return builder.text()


def differential_drive():
    """Two endless wheels, a caster with two joints, a lidar that turns, a mast that slides."""
    builder = Builder("differential_drive")
    for side in ("left", "right"):
        builder.joint("continuous", "base", f"{side}_wheel", axis="0 1 0")
    builder.joint("continuous", builder.joint("continuous", "base", "caster"), "caster_wheel")
    mast = builder.joint("prismatic", "base", "mast", axis="0 0 4")
    builder.joint("continuous", mast, "lidar")
    builder.joint("fixed", "lidar", "lidar_optical")
    return builder.text()


def gripper():
    """Fingers that mimic a slide, and finger tips that mimic the fingers, in both orders."""
    builder = Builder("gripper")

    def follow(joint, multiplier, offset):
        return f'<mimic joint="{joint}" multiplier="{multiplier}" offset="{offset}"/>'

    builder.joint("prismatic", "base", "slide", axis="1 2 -2")
    chain = follow("finger_b_joint", -2.0, 0.125)  # follows what follows, and comes before it
    builder.joint("revolute", "slide", "finger_a", mimic=chain)
    builder.joint("revolute", "slide", "finger_b", mimic=follow("slide_joint", 1.5, -0.25))
    builder.joint("prismatic", "finger_a", "tip_a", mimic=follow("finger_a_joint", 0.5, 0.0))
    builder.joint("continuous", "finger_b", "tip_b", mimic='<mimic joint="finger_b_joint"/>')
    builder.joint("revolute", "tip_b", "nail")
    return builder.text()


def tree(name="tree", links=60):
    """Joints of all kinds that move, on a tree that is drawn."""
    builder = Builder(name)
    chance = random.Random(7)
    names = ["base"]
    for number in range(1, links):
        kind = chance.choice(("revolute", "continuous", "prismatic", "fixed"))
        names.append(builder.joint(kind, chance.choice(names), f"link_{number}"))
    return builder.text()


@pytest.fixture(scope="session")
def robots():
    """Texts by name."""
    return {
        "arm": arm(),
        "quadruped": walker("quadruped", 4),
        "hexapod": walker("hexapod", 6),
        "differential_drive": differential_drive(),
        "gripper": gripper(),
        "tree": tree(),
    }
