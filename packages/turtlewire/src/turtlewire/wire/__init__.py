"""The middleware layer: moves bytes and handles QoS, names and the graph, but not messages.

:func:`open_context` joins a domain. :mod:`turtlewire.wire.base` defines the contract of a context.

================  ================================================================
module            contents
================  ================================================================
`base`            the contract that every middleware fulfils
`records`         records of names, stamps and counts
`qos`             `QoS`, with the numbers of ROS 2's rmw
`names`           rules and expansion of ROS names, and their spelling on the wire
`environment`     the environment variables of discovery and SROS 2; whether the shutdown waits
`libddsc`         finds the library of Cyclone DDS, and its binary interface
`loopback`        binds sockets to the loopback interface
`graph`           the common part of all graphs; ``ros_discovery_info``
`conflicts`       why endpoints are not connected; two types on one topic, two nodes of one name
`encapsulation`   the four bytes in front of every serialized message
`events`          counters of endpoints' events
`checked_node`    what the nodes of all middlewares refuse
`services`        services over two topics
`report`          warnings on stderr, each printed once
`reader_thread`   the thread that calls callbacks
`queue_wait_set`  wait sets over queues of Python
`wheels`          the platforms for which PyPI has wheels of the libraries
`cyclone`         Cyclone DDS
`zenoh`           Zenoh, as rmw_zenoh_cpp speaks it
`local`           the in-process middleware
================  ================================================================
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from turtlewire.errors import WireError

from . import environment
from .environment import check_security

if TYPE_CHECKING:
    from .base import Context

__all__ = ["open_context"]


def open_context(
    domain_id: int | None = None, *, middleware: str | None = None, enclave: str = "/"
) -> Context:
    """Join a domain.

    Args:
        domain_id: None uses ``ROS_DOMAIN_ID``, or 0.
        middleware: ``rmw_cyclonedds_cpp`` (Cyclone DDS), ``rmw_zenoh_cpp`` (Zenoh) or ``local``
            (inside this process); None uses :func:`.environment.middleware_name`.
        enclave: The enclave of its nodes.

    Raises:
        WireError: No such middleware, it is not available on this platform, the domain cannot be
            joined, or the environment demands SROS 2.
    """
    if domain_id is None:
        domain_id = environment.domain_id()
    if not 0 <= domain_id <= environment.MAX_DOMAIN_ID:
        raise WireError(
            f"domain {domain_id} does not exist: "
            f"domains have numbers from 0 to {environment.MAX_DOMAIN_ID}"
        )
    name = middleware or environment.middleware_name()
    if name == "local":
        from .local.context import LocalContext

        return LocalContext(domain_id, enclave)
    check_security()
    if name == "rmw_cyclonedds_cpp":
        from .cyclone.context import CycloneContext

        return CycloneContext(domain_id, enclave)
    if name == "rmw_zenoh_cpp":
        from .zenoh.library import require_zenoh

        require_zenoh()
        from .zenoh.context import ZenohContext

        return ZenohContext(domain_id, enclave)
    error = WireError(f"middleware {name!r} is not available")
    raise error.with_hint(f"Choose from {', '.join(environment.MIDDLEWARES)}.")
