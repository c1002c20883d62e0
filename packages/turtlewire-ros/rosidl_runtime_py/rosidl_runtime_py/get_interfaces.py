"""Lists the installed interfaces and their files."""

from __future__ import annotations

import os
from collections.abc import Collection

from turtlewire import msg
from turtlewire.msg.registry import interface_path

_KINDS = ("msg", "srv", "action")


def get_interfaces(package_names: Collection[str] = []) -> dict[str, list[str]]:
    """Return the interfaces by package.

    Args:
        package_names: The packages; none means all.

    Returns:
        ``{"turtlesim": ["msg/Color", "srv/Spawn", ...]}``.

    Raises:
        LookupError: A package is unknown.
    """
    return _interfaces(package_names, _KINDS)


def get_message_interfaces(package_names: Collection[str] = []) -> dict[str, list[str]]:
    """Return the messages by package; as `get_interfaces`."""
    return _interfaces(package_names, ("msg",))


def get_service_interfaces(package_names: Collection[str] = []) -> dict[str, list[str]]:
    """Return the services by package; as `get_interfaces`."""
    return _interfaces(package_names, ("srv",))


def get_action_interfaces(package_names: Collection[str] = []) -> dict[str, list[str]]:
    """Return the actions by package; as `get_interfaces`."""
    return _interfaces(package_names, ("action",))


def get_interface_packages() -> list[str]:
    """Return the names of all packages with interfaces."""
    return list(msg.interfaces())


def get_interface_path(interface_name: str) -> str:
    """Return the path of the file that defines an interface.

    Args:
        interface_name: ``geometry_msgs/msg/Twist``, with or without the ending of the file, such
            as ``.msg`` or ``.idl``.

    Returns:
        The path below the package's share folder. Packages that were generated without one, and
        this distribution's when it was not installed, have their definitions elsewhere.

    Raises:
        ValueError: ``interface_name`` is not the name of an interface.
        LookupError: The package, the interface or the file does not exist.
    """
    parts = interface_name.split("/")
    if len(parts) < 2:
        raise ValueError(
            f"Invalid name '{interface_name}'. Expected at least two parts separated by '/'"
        )
    if not all(parts):
        raise ValueError(f"Invalid name '{interface_name}'. Must not contain empty parts")
    # The name becomes a path below.
    if ".." in parts:
        raise ValueError(f"Invalid name '{interface_name}'. Must not contain '..'")
    if parts[0] not in msg.interfaces():
        raise LookupError(f"Unknown package '{parts[0]}'")
    stem, dot, ending = interface_name.partition(".")
    path = _in_share(interface_path(stem), stem)
    asked = f"{os.path.splitext(path)[0]}.{ending}" if dot else path
    if asked != path and (ending != "idl" or not os.path.isfile(asked)):
        raise LookupError(f"Could not find the interface '{asked}'")
    return asked


def _in_share(path: str, full_name: str) -> str:
    """Return the file of a package's share folder for a definition, or the definition itself."""
    from turtlewire_ros.prefix import share_directory

    package, kind, name = full_name.split("/")
    share = share_directory(package)
    if share is None:
        return path
    installed = os.path.join(share, kind, f"{name}.{kind}")
    return installed if os.path.isfile(installed) else path


def _interfaces(package_names: Collection[str], kinds: tuple[str, ...]) -> dict[str, list[str]]:
    packages = msg.interfaces()
    found: dict[str, list[str]] = {}
    for package in package_names or packages:
        if package not in packages:
            raise LookupError(f"Unknown package '{package}'")
        names = [f"{kind}/{name}" for kind in kinds for name in packages[package][kind]]
        # A package that was asked for is listed even if it has none; among all, it is left out.
        if names or package_names:
            found[package] = names
    return found
