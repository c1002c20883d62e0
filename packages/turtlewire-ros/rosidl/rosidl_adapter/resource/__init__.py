"""Templates of EmPy: the text of IDL files, and functions that fill templates in.

The templates of this folder, ``msg.idl.em``, ``srv.idl.em`` and ``action.idl.em``, call
`rosidl_adapter.idl`, which converts files without templates.
"""

from __future__ import annotations

import functools
import importlib.util
import io
import pathlib
from collections.abc import Mapping
from typing import Any

from rosidl_adapter.parser import ActionSpecification, MessageSpecification, ServiceSpecification

__all__ = [
    "ActionSpecification",
    "MessageSpecification",
    "ServiceSpecification",
    "em_has_configuration",
    "evaluate_template",
    "expand_template",
]

#: Whether EmPy 4, whose interpreters take a configuration, is installed.
em_has_configuration = importlib.util.find_spec("emlib") is not None


def expand_template(
    template_name: str,
    data: Mapping[str, Any],
    output_file: pathlib.Path,
    encoding: str = "utf-8",
) -> None:
    """Write what a template becomes; a file that has this content already stays as it is.

    Args:
        template_name: Name of a template of this folder, or the path of another one.
        data: The variables of the template.
        output_file: The file to write; missing folders are made.
        encoding: The encoding of the file.

    Raises:
        ImportError: EmPy 4 is missing.
        OSError: The template cannot be read, or the file cannot be written.
    """
    content = evaluate_template(template_name, data).encode(encoding)
    output_file = pathlib.Path(output_file)
    if output_file.exists() and output_file.read_bytes() == content:
        return
    output_file.parent.mkdir(parents=True, exist_ok=True)
    output_file.write_bytes(content)


def evaluate_template(template_name: str, data: Mapping[str, Any]) -> str:
    """Return what a template becomes.

    A template includes another one by ``@(TEMPLATE('other.em', name=value))``.

    Args:
        template_name: Name of a template of this folder, or the path of another one.
        data: The variables of the template.

    Raises:
        ImportError: EmPy 4 is missing.
        OSError: The template cannot be read.
    """
    if not em_has_configuration:
        raise ImportError(
            "Templates need EmPy 4: pip install 'turtlewire-ros[grammars]'", name="em"
        )
    import em

    path = pathlib.Path(__file__).parent / template_name
    output = io.StringIO()
    # Without the proxy and the dispatcher, EmPy leaves stdout alone and raises the errors.
    configuration = em.Configuration(defaultRoot=str(path), useProxy=False)
    interpreter = em.Interpreter(config=configuration, output=output, dispatcher=False)
    variables = {"TEMPLATE": functools.partial(_included, path.parent), **data}
    try:
        interpreter.string(path.read_text(encoding="utf-8"), locals=variables)
    finally:
        interpreter.shutdown()
    return output.getvalue()


def _included(folder: pathlib.Path, template_name: str, **data: Any) -> str:
    return evaluate_template(str(folder / template_name), data)
