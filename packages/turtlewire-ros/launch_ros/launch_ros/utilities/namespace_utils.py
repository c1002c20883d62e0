"""Joining namespaces."""

from __future__ import annotations


def is_root_namespace(ns: str) -> bool:
    """Return True if it is ``/``."""
    return ns == "/"


def is_namespace_absolute(ns: str) -> bool:
    """Return True if it begins with a slash."""
    return ns.startswith("/")


def make_namespace_absolute(ns: str) -> str:
    """Return the namespace with a leading slash; an empty one is the root."""
    return ns if is_namespace_absolute(ns) else f"/{ns}"


def prefix_namespace(base_ns: str | None, ns: str | None) -> str | None:
    """``ns`` within ``base_ns``; an absolute ``ns`` stays as it is."""
    if ns is None or (ns == "" and base_ns is not None):
        return base_ns
    if base_ns is None or base_ns == "" or is_namespace_absolute(ns):
        return ns if is_root_namespace(ns) else ns.rstrip("/")
    return f"{base_ns.rstrip('/')}/{ns.rstrip('/')}"
