"""The value of a Python expression."""

from __future__ import annotations

import importlib
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution, described
from launch.substitutions.text_substitution import TextSubstitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_substitution("eval")
class PythonExpression(Substitution):
    """The value of a Python expression, as text.

    The names in ``math`` can be used bare. A launch file runs code by its nature; this is no less
    trusted than it.

    Args:
        expression: The expression.
        python_modules: Names of modules that it may use.
    """

    def __init__(
        self,
        expression: SomeSubstitutionsType,
        python_modules: SomeSubstitutionsType = ["math"],  # noqa: B006  ROS 2's; never changed
    ) -> None:
        self._expression = normalize_to_list_of_substitutions(expression)
        modules: Any = (
            [python_modules] if isinstance(python_modules, (str, Substitution)) else python_modules
        )
        self._modules = [normalize_to_list_of_substitutions(module) for module in modules]

    @classmethod
    def parse(
        cls, data: Sequence[SomeSubstitutionsType]
    ) -> tuple[type[PythonExpression], dict[str, Any]]:
        """Read ``$(eval 'expression' ['module, ...'])``."""
        if not 1 <= len(data) <= 2:
            raise TypeError("eval substitution expects 1 or 2 arguments")
        kwargs: dict[str, Any] = {"expression": data[0]}
        if len(data) == 2:
            # Launch files name modules by plain text, which needs no context.
            text = "".join(part.text for part in normalize_to_list_of_substitutions(data[1])
                           if isinstance(part, TextSubstitution))  # fmt: skip
            kwargs["python_modules"] = [name.strip() for name in text.split(",") if name.strip()]
        return cls, kwargs

    @property
    def expression(self) -> list[Substitution]:
        """The expression."""
        return self._expression

    @property
    def python_modules(self) -> list[list[Substitution]]:
        """Names of modules that it may use."""
        return self._modules

    def describe(self) -> str:
        modules = ", ".join(map(described, self._modules))
        return f"PythonExpr({described(self._expression)}, [{modules}])"

    def perform(self, context: LaunchContext) -> str:
        """Return the value as text.

        Raises:
            Exception: What the expression raises, such as NameError; a ``hint`` names it.
        """
        expression = perform_substitutions(context, self._expression)
        names: dict[str, Any] = {}
        for part in self._modules:
            module_name = perform_substitutions(context, part)
            module = importlib.import_module(module_name)
            # As in an import statement, `os.path` defines the name `os`.
            names[module_name.partition(".")[0]] = importlib.import_module(
                module_name.partition(".")[0]
            )
            if module_name == "math":
                names.update(vars(module))
        try:
            return str(eval(expression, {}, names))  # noqa: S307
        except Exception as error:
            vars(error)["hint"] = f"It was raised by the Python expression '{expression}'."
            raise
