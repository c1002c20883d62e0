import subprocess
import sys
import textwrap

import pytest
from tests.needs import needs_cyclone_dds

from rclpy import qos
from rclpy.duration import Duration, Infinite
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    InvalidQoSProfileException,
    LivelinessPolicy,
    QoSCompatibility,
    QoSPolicyKind,
    QoSPresetProfiles,
    QoSProfile,
    ReliabilityPolicy,
    qos_check_compatible,
    qos_policy_name_from_kind,
    qos_profile_best_available,
    qos_profile_system_default,
)
from turtlewire.wire import qos as wire_qos

S, R, B = (
    ReliabilityPolicy.SYSTEM_DEFAULT,
    ReliabilityPolicy.RELIABLE,
    ReliabilityPolicy.BEST_EFFORT,
)


def profile(**changes):
    return QoSProfile(**{"depth": 10, "liveliness": LivelinessPolicy.AUTOMATIC, **changes})


@pytest.mark.parametrize(
    ("preset", "history", "depth", "reliability", "durability"),
    [
        ("default", "KEEP_LAST", 10, "RELIABLE", "VOLATILE"),
        ("sensor_data", "KEEP_LAST", 5, "BEST_EFFORT", "VOLATILE"),
        ("services_default", "KEEP_LAST", 10, "RELIABLE", "VOLATILE"),
        ("parameters", "KEEP_LAST", 1000, "RELIABLE", "VOLATILE"),
        ("parameter_events", "KEEP_LAST", 1000, "RELIABLE", "VOLATILE"),
        ("system_default", "SYSTEM_DEFAULT", 0, "SYSTEM_DEFAULT", "SYSTEM_DEFAULT"),
        ("best_available", "KEEP_LAST", 10, "BEST_AVAILABLE", "BEST_AVAILABLE"),
        ("action_status_default", "KEEP_LAST", 1, "RELIABLE", "TRANSIENT_LOCAL"),
        ("unknown", "UNKNOWN", 0, "UNKNOWN", "UNKNOWN"),
    ],
)
def test_presets(preset, history, depth, reliability, durability):
    made = QoSPresetProfiles.get_from_short_key(preset)
    assert (made.history.name, made.depth, made.reliability.name, made.durability.name) == (
        history,
        depth,
        reliability,
        durability,
    )
    assert preset in QoSPresetProfiles.short_keys()
    assert made == QoSPresetProfiles[preset.upper()].value == getattr(qos, f"qos_profile_{preset}")
    assert QoSProfile.from_wire(made.to_wire()) == made


def test_short_keys():
    assert HistoryPolicy.short_keys() == ["system_default", "keep_last", "keep_all", "unknown"]
    assert ReliabilityPolicy.get_from_short_key("best_effort") == ReliabilityPolicy.BEST_EFFORT
    assert DurabilityPolicy.TRANSIENT_LOCAL.short_key == "transient_local"
    assert LivelinessPolicy.MANUAL_BY_TOPIC == 3
    assert (
        qos_policy_name_from_kind(QoSPolicyKind.RELIABILITY)
        == qos_policy_name_from_kind(16)
        == "RELIABILITY"
    )


def test_the_best_available_durations():
    best = qos_profile_best_available
    assert best.deadline == qos.DeadlineBestAvailable
    assert best.liveliness_lease_duration == qos.LivelinessLeaseDurationeBestAvailable


def test_durations_and_numbers_reach_the_wire():
    assert QoSProfile(depth=10).to_wire() == wire_qos.QoS()
    made = profile(
        deadline=Duration(seconds=1),
        lifespan=Duration(seconds=2),
        liveliness_lease_duration=Infinite,
        avoid_ros_namespace_conventions=True,
    )
    wire = made.to_wire()
    assert (wire.deadline_ns, wire.lifespan_ns, wire.liveliness_lease_ns) == (
        10**9,
        2 * 10**9,
        wire_qos.INFINITE_NS,
    )
    assert wire.avoid_ros_namespace_conventions
    assert qos_profile_best_available.to_wire().reliability is wire_qos.Reliability.BEST_AVAILABLE
    assert qos_profile_best_available.deadline.nanoseconds == 2**63 - 2, "rmw's mark"


def test_incomplete_profiles():
    with pytest.raises(InvalidQoSProfileException) as caught:
        QoSProfile(reliability=R)
    assert caught.value.args == (
        "Invalid QoSProfile",
        "History and/or depth settings are required.",
    )
    with pytest.raises(InvalidQoSProfileException) as caught:
        QoSProfile(history=HistoryPolicy.KEEP_LAST)
    assert caught.value.args == (
        "Invalid QoSProfile",
        "History set to KEEP_LAST without a depth setting.",
    )
    assert QoSProfile(history=HistoryPolicy.KEEP_ALL).depth == 10


def test_wrong_values():
    with pytest.raises(ValueError, match=r"^history depth must be greater than or equal to zero$"):
        QoSProfile(depth=-1)
    with pytest.raises(AssertionError):
        QoSProfile(depth="10")
    with pytest.raises(AssertionError):
        QoSProfile(depth=1, relibility=R)
    with pytest.raises(ValueError):
        QoSProfile(depth=1, reliability=99)
    with pytest.warns(
        UserWarning, match="A zero depth with KEEP_LAST doesn't make sense; no data could be stored"
    ):
        QoSProfile(depth=0)


def test_text():
    text = (
        "lifespan=0 nanoseconds, deadline=0 nanoseconds, liveliness=0, "
        "liveliness_lease_duration=0 nanoseconds"
    )
    assert str(QoSProfile(depth=10)) == (
        f"QoSProfile(history=1, depth=10, reliability=1, durability=2, {text}, "
        "avoid_ros_namespace_conventions=False)"
    )


@pytest.mark.parametrize(
    ("publisher", "subscription", "level", "reason"),
    [
        ({}, {}, "OK", ""),
        ({}, {"reliability": B}, "OK", ""),
        ({"durability": DurabilityPolicy.TRANSIENT_LOCAL}, {}, "OK", ""),
        ({"deadline": Duration(seconds=1)}, {"deadline": Duration(seconds=2)}, "OK", ""),
        (
            {"reliability": B},
            {},
            "ERROR",
            "ERROR: Best effort publisher and reliable subscription;",
        ),
        (
            {},
            {"durability": DurabilityPolicy.TRANSIENT_LOCAL},
            "ERROR",
            "ERROR: Volatile publisher and transient local subscription;",
        ),
        (
            {},
            {"deadline": Duration(seconds=1)},
            "ERROR",
            "ERROR: Subscription has a deadline, but publisher does not;",
        ),
        ({"deadline": Infinite}, {"deadline": Infinite}, "OK", ""),
        (
            {"deadline": Duration(seconds=2)},
            {"deadline": Duration(seconds=1)},
            "ERROR",
            "ERROR: Subscription deadline is less than publisher deadline;",
        ),
        (
            {"liveliness": LivelinessPolicy.AUTOMATIC},
            {"liveliness": LivelinessPolicy.MANUAL_BY_TOPIC},
            "ERROR",
            "ERROR: Publisher's liveliness is automatic and subscription's is manual by topic;",
        ),
        (
            {},
            {"liveliness_lease_duration": Duration(seconds=1)},
            "ERROR",
            "ERROR: Subscription has a liveliness lease duration, but publisher does not;",
        ),
        (
            {"reliability": B},
            {"durability": DurabilityPolicy.TRANSIENT_LOCAL},
            "ERROR",
            (
                "ERROR: Best effort publisher and reliable subscription;ERROR: Volatile publisher "
                "and transient local subscription;"
            ),
        ),
        (
            {"reliability": S},
            {},
            "WARNING",
            "WARNING: Reliable subscription, but publisher is system_default;",
        ),
        (
            {"reliability": B},
            {"reliability": S},
            "WARNING",
            "WARNING: Best effort publisher, but subscription is system_default;",
        ),
        ({"reliability": S}, {"reliability": B}, "OK", ""),
        # The answers of Jazzy's and of Kilted's own function.
        (
            {},
            {"deadline": Infinite},
            "ERROR",
            "ERROR: Subscription has a deadline, but publisher does not;",
        ),
        (
            {"liveliness_lease_duration": Infinite},
            {"liveliness_lease_duration": Duration(nanoseconds=1)},
            "ERROR",
            "ERROR: Subscription liveliness lease duration is less than publisher;",
        ),
        (
            {"durability": DurabilityPolicy.UNKNOWN},
            {"durability": DurabilityPolicy.TRANSIENT_LOCAL},
            "WARNING",
            "WARNING: Transient local subscription, but publisher is unknown;",
        ),
        (
            {},
            {"durability": DurabilityPolicy.SYSTEM_DEFAULT},
            "WARNING",
            "WARNING: Volatile publisher, but subscription is system_default;",
        ),
        (
            {"liveliness": LivelinessPolicy.SYSTEM_DEFAULT},
            {"liveliness": LivelinessPolicy.MANUAL_BY_TOPIC},
            "WARNING",
            (
                "WARNING: Subscription's liveliness is manual by topic, but publisher's is "
                "system_default;"
            ),
        ),
        (
            {},
            {"liveliness": LivelinessPolicy.UNKNOWN},
            "WARNING",
            "WARNING: Publisher's liveliness is automatic, but subscription's is unknown;",
        ),
    ],
)
@needs_cyclone_dds
def test_compatibility(publisher, subscription, level, reason, monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "rmw_cyclonedds_cpp")
    alive = {"liveliness": LivelinessPolicy.AUTOMATIC}
    answer = qos_check_compatible(profile(**alive | publisher), profile(**alive | subscription))
    assert answer == (QoSCompatibility[level], reason)
    assert answer.compatibility is QoSCompatibility[level]


def test_with_zenoh_everything_matches(monkeypatch):
    pytest.importorskip("zenoh")
    monkeypatch.setenv("RMW_IMPLEMENTATION", "rmw_zenoh_cpp")
    weak, strong = profile(reliability=B), profile(reliability=R)
    latched, system = (
        profile(durability=DurabilityPolicy.TRANSIENT_LOCAL),
        qos_profile_system_default,
    )
    for publisher, subscription in ((weak, strong), (strong, latched), (system, system)):
        assert qos_check_compatible(publisher, subscription) == (QoSCompatibility.OK, "")
    level, reason = qos_check_compatible(latched, strong)
    assert level is QoSCompatibility.WARNING
    assert "transient local" in reason


@needs_cyclone_dds
def test_two_system_defaults_are_left_open(monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "rmw_cyclonedds_cpp")
    level, reason = qos_check_compatible(qos_profile_system_default, qos_profile_system_default)
    assert level is QoSCompatibility.WARNING
    assert reason == (
        "WARNING: Publisher reliability is system_default and subscription reliability is "
        "system_default;WARNING: Publisher durabilty is system_default and subscription durability "
        "is system_default;WARNING: Publisher liveliness is system_default and subscription "
        "liveliness is system_default;"
    )


def test_mistyped_arguments_raise_under_python_o_too():
    source = """
        from rclpy.qos import QoSProfile
        for arguments in ({"reliabilty": 2}, {"lifespan": 3}, {"reliability": "best"}):
            try:
                QoSProfile(depth=1, **arguments)
            except AssertionError as error:
                print(error)
    """
    done = subprocess.run(
        [sys.executable, "-O", "-c", textwrap.dedent(source)],
        capture_output=True,
        text=True,
        check=True,
        timeout=300,
    )
    assert done.stdout.splitlines() == [
        "Invalid arguments passed to constructor: dict_keys(['depth', 'reliabilty'])",
        "expected an object of type Duration, got an object of type int",
        "expected an object of type int, got an object of type str",
    ]
