"""The environment variables that ROS 2 and its middlewares read."""

from __future__ import annotations

import os
from collections.abc import Iterable

from ros2doctor.api.reporting import DoctorReport, Report

ROS_ENVIRONMENT_VARIABLES = [
    "RCL_LOGGING_SPDLOG_EXPERIMENTAL_OLD_FLUSHING_BEHAVIOR",
    "ROS_AUTOMATIC_DISCOVERY_RANGE",
    "ROS_DISABLE_LOANED_MESSAGES",
    "ROS_DISTRO",
    "ROS_DOMAIN_ID",
    "ROS_HOME",
    "ROS_LOG_DIR",
    "ROS_SECURITY_ENABLE",
    "ROS_SECURITY_ENCLAVE_OVERRIDE",
    "ROS_SECURITY_KEYSTORE",
    "ROS_SECURITY_STRATEGY",
    "ROS_STATIC_PEERS",
]
RCUTILS_ENVIRONMENT_VARIABLES = [
    "RCUTILS_COLORIZED_OUTPUT",
    "RCUTILS_CONSOLE_OUTPUT_FORMAT",
    "RCUTILS_CONSOLE_STDOUT_LINE_BUFFERED",
    "RCUTILS_LOGGING_BUFFERED_STREAM",
    "RCUTILS_LOGGING_USE_STDOUT",
]
RMW_CONNEXTDDS_ENVIRONMENT_VARIABLES = ["NDDSHOME", "NDDS_QOS_PROFILES", "RTI_LICENSE_FILE"]
RMW_CYCLONEDDS_ENVIRONMENT_VARIABLES = ["CYCLONEDDS_HOME", "CYCLONEDDS_URI"]
RMW_FASTRTPS_ENVIRONMENT_VARIABLES = [
    "FASTDDS_DEFAULT_PROFILES_FILE",
    "FASTRTPS_DEFAULT_PROFILES_FILE",
    "RMW_FASTRTPS_PUBLICATION_MODE",
    "RMW_FASTRTPS_USE_QOS_FROM_XML",
    "ROS_DISCOVERY_SERVER",
    "ROS_SUPER_CLIENT",
]
RMW_ZENOH_CPP_ENVIRONMENT_VARIABLES = [
    "ZENOH_CONFIG_OVERRIDE",
    "ZENOH_ROUTER_CHECK_ATTEMPTS",
    "ZENOH_ROUTER_CONFIG_URI",
    "ZENOH_SESSION_CONFIG_URI",
]
#: By the name of the middleware.
RMW_ENVIRONMENT_VARIABLES = {
    "rmw_connextdds": RMW_CONNEXTDDS_ENVIRONMENT_VARIABLES,
    "rmw_cyclonedds_cpp": RMW_CYCLONEDDS_ENVIRONMENT_VARIABLES,
    "rmw_fastrtps_cpp": RMW_FASTRTPS_ENVIRONMENT_VARIABLES,
    "rmw_zenoh_cpp": RMW_ZENOH_CPP_ENVIRONMENT_VARIABLES,
}
ALL_ENVIRONMENT_VARIABLES = [
    *ROS_ENVIRONMENT_VARIABLES,
    *RCUTILS_ENVIRONMENT_VARIABLES,
    "RMW_IMPLEMENTATION",
    *(name for names in RMW_ENVIRONMENT_VARIABLES.values() for name in names),
]


class EnvironmentReport(DoctorReport):
    """Reports the variables that are set: all of the lists, and others with their prefixes."""

    def category(self) -> str:
        return "environment"

    def report(self) -> Report:
        report = Report("ROS ENVIRONMENT")
        rest = set(ALL_ENVIRONMENT_VARIABLES)
        for part, prefix, names in (
            ("ROS", "ROS_", ROS_ENVIRONMENT_VARIABLES),
            ("rcutils", "RCUTILS_", RCUTILS_ENVIRONMENT_VARIABLES),
        ):
            rest -= set(names)
            report.add_to_report(f"{part} environment variables", _set(prefix, names))
        report.add_to_report("rmw environment variables", _set("RMW_", rest))
        return report


def _set(prefix: str, names: Iterable[str]) -> str:
    others = {name for name in os.environ if name.startswith(prefix)} - set(
        ALL_ENVIRONMENT_VARIABLES
    )
    found = sorted(name for name in {*names, *others} if name in os.environ)
    return ", ".join(f"{name}={os.environ[name]}" for name in found)
