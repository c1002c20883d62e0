"""Runs the tests of a module once for each set of arguments."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterable, Iterator
from typing import Any


def parametrize(
    argnames: str | Iterable[str], argvalues: Iterable[Any]
) -> Callable[[Callable[..., Any]], Callable[[], Iterator[tuple[Any, dict[str, Any]]]]]:
    """Decorate a ``generate_test_description`` that takes arguments.

    Args:
        argnames: The names: a list, or a text with commas.
        argvalues: For each run its value, or the tuple of its values.
    """
    names = argnames.split(",") if isinstance(argnames, str) else list(argnames)
    names = [name.strip() for name in names if name.strip()]

    def decorate(
        function: Callable[..., Any],
    ) -> Callable[[], Iterator[tuple[Any, dict[str, Any]]]]:
        @functools.wraps(function)
        def descriptions() -> Iterator[tuple[Any, dict[str, Any]]]:
            for values in argvalues:
                row = values if isinstance(values, (tuple, list)) else (values,)
                if len(row) != len(names):
                    raise ValueError(
                        f"parametrize: {len(row)} values {tuple(row)} for the arguments {names}"
                    )
                arguments = dict(zip(names, row, strict=True))
                bound = functools.partial(function, **arguments)
                functools.update_wrapper(bound, function)
                del bound.__wrapped__  # type: ignore[attr-defined]  # its parameters have values
                # Decorators above this one have marked `descriptions`.
                marks = getattr(function, "__markers__", {})
                bound.__markers__ = {  # type: ignore[attr-defined]
                    **marks,
                    **getattr(descriptions, "__markers__", {}),
                }
                yield bound, arguments

        descriptions.__parametrized__ = True  # type: ignore[attr-defined]
        return descriptions

    return decorate
