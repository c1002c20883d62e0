"""What versions 1.1 and 1.2 of URDF add, which only Lyrical reads."""

import math

import pytest

from turtlewire.errors import UrdfError
from turtlewire.urdf import JointLimits
from turtlewire.urdf.joint_model import joint_constants
from turtlewire.urdf.model import Box, Capsule
from turtlewire.urdf.parser import parse_urdf

HALF = math.sqrt(0.5)


def urdf(
    version,
    origin="",
    geometry='<box size="1 1 1"/>',
    limit='effort="1" velocity="1"',
    kind="continuous",
):
    return f"""<robot name="r" version="{version}">
      <link name="a"><visual><geometry>{geometry}</geometry></visual></link><link name="b"/>
      <joint name="j" type="{kind}"><parent link="a"/><child link="b"/>
        <origin {origin}/><axis xyz="0 0 1"/><limit {limit}/></joint></robot>"""


def refusal(text):
    with pytest.raises(UrdfError) as caught:
        parse_urdf(text)
    return str(caught.value)


def shape_of(text):
    return parse_urdf(text).links["a"].visuals[0].geometry


def limits_of(version, limit, kind="continuous"):
    return parse_urdf(urdf(version, limit=limit, kind=kind)).joints["j"].limits


def warnings_of(text):
    return [warning.text for warning in parse_urdf(text).warnings]


@pytest.fixture
def lyrical(monkeypatch):
    monkeypatch.setenv("ROS_DISTRO", "lyrical")


@pytest.mark.parametrize("version", ["1.0", "1.1", "1.2"])
def test_versions_that_lyrical_reads(lyrical, version):
    assert parse_urdf(urdf(version)).root == "a"


@pytest.mark.parametrize("version", ["1.3", "2.0", "0.9", "1.99999999999999999999"])
def test_versions_that_are_refused(monkeypatch, version):
    for distro, known in {
        "lyrical": "versions from 1.0 upto 1.2 are",
        "kilted": "only version 1.0 is",
    }.items():
        monkeypatch.setenv("ROS_DISTRO", distro)
        told = refusal(urdf(version))
        assert told == f"Invalid 'version' specified; {known} currently supported"
    assert refusal(urdf("1.x")) == "The version attribute should be in the form 'x.y'"


def test_up_to_kilted_there_is_only_version_1_0(monkeypatch):
    monkeypatch.setenv("ROS_DISTRO", "jazzy")
    text = "Invalid 'version' specified; only version 1.0 is currently supported"
    assert refusal(urdf("1.1")) == text
    capsule = urdf("1.0", geometry='<capsule radius="1" length="2"/>')
    warning = parse_urdf(capsule).warnings[0]
    assert warning.text == "Unknown geometry type 'capsule'"
    joint = parse_urdf(urdf("1.0", origin='quat_xyzw="1 0 0 0"')).joints["j"]
    assert joint.origin.quaternion == (0, 0, 0, 1)


def test_an_origin_with_a_quaternion(lyrical):
    turned = urdf("1.1", origin='xyz="1 2 3" quat_xyzw="0 0 2 2"')
    origin = parse_urdf(turned).joints["j"].origin
    assert origin.quaternion == pytest.approx((0, 0, HALF, HALF))
    assert origin.rpy == pytest.approx((0, 0, math.pi / 2))
    constants = joint_constants(parse_urdf(turned).joints["j"])
    assert constants[:3] == (1, 2, 3)
    assert constants[6:10] == pytest.approx((0, 0, HALF, HALF))
    both = urdf("1.1", origin='rpy="0 0 1" quat_xyzw="0 0 0 1"')
    text = "Both rpy and quat_xyzw orientations are defined. Use either one or the other."
    assert refusal(both) == text
    assert "no direction" in refusal(urdf("1.1", origin='quat_xyzw="0 0 0 0"'))
    assert "3 elements but 4 expected" in refusal(urdf("1.1", origin='quat_xyzw="0 0 1"'))
    assert warnings_of(urdf("1.0", origin='quat_xyzw="0 0 1 1"')) == [
        "Ignoring quat_xyzw attribute requiring URDF version 1.1 since specified version is 1.0."
    ]


@pytest.mark.parametrize("angles", [(0.1, -0.2, 3.0), (0, 1.5, 0), (3, 0, -3), (0, math.pi / 2, 0)])
def test_angles_and_quaternion_of_an_origin_are_the_same_rotation(lyrical, angles):
    by_angles = parse_urdf(urdf("1.1", origin=f'rpy="{" ".join(map(str, angles))}"'))
    wanted = by_angles.joints["j"].origin.quaternion
    text = urdf("1.1", origin=f'quat_xyzw="{" ".join(map(repr, wanted))}"')
    found = parse_urdf(text).joints["j"].origin
    assert found.quaternion == pytest.approx(wanted)
    again = parse_urdf(urdf("1.1", origin=f'rpy="{" ".join(map(repr, found.rpy))}"'))
    dot = sum(a * b for a, b in zip(again.joints["j"].origin.quaternion, wanted, strict=True))
    assert abs(dot) == pytest.approx(1)


def test_capsules(lyrical):
    capsule = '<capsule radius="1" length="2"/>'
    assert shape_of(urdf("1.1", geometry=capsule)) == Capsule(1, 2)
    old = urdf("1.0", geometry=capsule)
    assert shape_of(old) is None
    assert warnings_of(old) == [
        (
            "Ignoring capsule attribute minimum required version URDF version 1.1 since specified"
            " version is 1.0."
        )
    ]
    warning = parse_urdf(urdf("1.1", geometry='<capsule radius="1"/>')).warnings[0]
    assert warning.text == "Capsule shape must have both length and radius attributes"


@pytest.mark.parametrize(
    ("shape", "told"),
    [
        ('sphere radius="{}"', "Sphere radius must be a positive finite value"),
        ('box size="1 {} 1"', "Box size must be positive finite values"),
        (
            'cylinder radius="{}" length="1"',
            "Cylinder length and radius must be positive finite values",
        ),
        (
            'capsule radius="1" length="{}"',
            "Capsule length and radius must be positive finite values",
        ),
    ],
)
def test_sizes_are_positive_from_version_1_2_on(lyrical, shape, told):
    for size in ("0", "-1"):
        geometry = f"<{shape.format(size)}/>"
        assert told in [w.text for w in parse_urdf(urdf("1.2", geometry=geometry)).warnings]
        assert not parse_urdf(urdf("1.1", geometry=geometry)).warnings
    assert shape_of(urdf("1.2", geometry='<box size="1 2 3"/>')) == Box((1, 2, 3))


def test_limits_of_version_1_2(lyrical):
    inf = math.inf
    assert limits_of("1.2", "") == JointLimits(-inf, inf, inf, inf)
    rates = 'effort="1" velocity="2" acceleration="3" jerk="4"'
    assert limits_of("1.2", rates) == JointLimits(-inf, inf, 1, 2, 3, 3, 4)
    both = 'lower="0" upper="0" acceleration="3" deceleration="0"'
    assert limits_of("1.2", both, "revolute") == JointLimits(0, 0, inf, inf, 3, 0, inf)
    for limit, told in {
        'upper="1"': "no lower",
        'lower="1"': "no upper",
        'lower="1" upper="0.5"': "upper (0.5) is less than lower (1)",
        'lower="0" upper="1" velocity="-1"': "velocity (-1) is negative",
        'lower="0" upper="1" jerk="-0.1"': "jerk (-0.1) is negative",
    }.items():
        assert refusal(urdf("1.2", limit=limit, kind="prismatic")) == f"joint limit: {told}"


def test_limits_before_version_1_2(lyrical):
    limit = 'effort="1" velocity="2" acceleration="3"'
    assert limits_of("1.1", limit) == JointLimits(0, 0, 1, 2)
    assert warnings_of(urdf("1.1", limit=limit)) == [
        "Ignoring acceleration attribute requiring URDF version 1.2 since specified version is 1.1."
    ]
    assert refusal(urdf("1.1", limit="")) == "joint limit: no effort"
