"""Services of the graph and their classes, completions."""

from __future__ import annotations

import argparse
from typing import Any

from ros2cli import completion
from ros2cli.completion import interface_names
from ros2cli.node.direct import DirectNode


def get_service_names_and_types(
    *, node: Any, include_hidden_services: bool = False
) -> list[tuple[str, list[str]]]:
    """Return the names and types of the services that a node sees, sorted by name."""
    from turtlewire.wire.names import is_hidden

    found: list[tuple[str, list[str]]] = node.get_service_names_and_types()
    return [each for each in found if include_hidden_services or not is_hidden(each[0])]


def get_service_names(*, node: Any, include_hidden_services: bool = False) -> list[str]:
    """Return the names of the services that a node sees, sorted."""
    found = get_service_names_and_types(node=node, include_hidden_services=include_hidden_services)
    return [name for name, _ in found]


def get_service_class(node: Any, service_name: str, include_hidden_services: bool) -> Any:
    """Return the class of a service; None if there is no such service.

    Raises:
        RuntimeError: The service has several types, or one that is not installed.
    """
    from rosidl_runtime_py.utilities import get_service

    found = get_service_names_and_types(node=node, include_hidden_services=include_hidden_services)
    types = dict(found).get(node.resolve_service_name(service_name))
    if not types:
        return None
    if len(types) > 1:
        raise RuntimeError(
            f"Cannot echo service '{service_name}', as it contains more than one type:"
            f" [{', '.join(types)}]"
        )
    try:
        return get_service(types[0])
    except (AttributeError, ModuleNotFoundError, ValueError):
        from ros2cli.suggestion import source_meant

        raise RuntimeError(
            f"The service type '{types[0]}' is invalid{source_meant(types[0])}"
        ) from None


class ServiceNameCompleter:
    """Offers names of services to the shell.

    Args:
        include_hidden_services_key: Attribute of the command line that asks for hidden services.
    """

    def __init__(self, *, include_hidden_services_key: str | None = None) -> None:
        self.include_hidden_services_key = include_hidden_services_key

    def __call__(self, prefix: str, parsed_args: argparse.Namespace, **kwargs: Any) -> list[str]:
        """Return the names of the services there are now."""
        hidden = getattr(parsed_args, self.include_hidden_services_key or "", False)
        with DirectNode(parsed_args) as node:
            return get_service_names(node=node, include_hidden_services=hidden)


class ServiceTypeCompleter:
    """Offers the type of the service on the command line to the shell.

    Args:
        service_name_key: Attribute of the command line that is the service.
    """

    def __init__(self, *, service_name_key: str | None = None) -> None:
        self.service_name_key = service_name_key

    def __call__(self, prefix: str, parsed_args: argparse.Namespace, **kwargs: Any) -> list[str]:
        """Return the type of the service, or all services."""
        service = getattr(parsed_args, self.service_name_key or "", None)
        with DirectNode(parsed_args) as node:
            found = get_service_names_and_types(node=node, include_hidden_services=True)
        return dict(found).get(service or "") or service_type_completer()


class ServicePrototypeCompleter:
    """Offers the default values of a request of the type on the command line to the shell.

    Args:
        service_type_key: Attribute of the command line that is the type.
    """

    def __init__(self, *, service_type_key: str | None = None) -> None:
        self.service_type_key = service_type_key

    def __call__(self, prefix: str, parsed_args: argparse.Namespace, **kwargs: Any) -> list[str]:
        """Return the default values, as YAML."""
        return completion.prototype("srv", getattr(parsed_args, self.service_type_key or ""))


def service_type_completer(**kwargs: Any) -> list[str]:
    """Return the full names of all services."""
    return interface_names("srv")
