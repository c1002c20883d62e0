"""Settings of a process that may depend on the launch: timeouts, terminal, respawn."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.conditions import evaluate_condition_expression
from launch.substitutions import LaunchConfiguration
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from logging import Logger

    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution


class ProcessSettings:
    """Performs the substitutions of the settings of a process.

    Args:
        sigterm_timeout: Seconds between SIGINT and SIGTERM.
        sigkill_timeout: Seconds between SIGTERM and SIGKILL.
        emulate_tty: Whether the process finds a terminal, without a launch configuration of this
            name.
        respawn: Whether it is started again after its end.
    """

    def __init__(
        self,
        *,
        sigterm_timeout: SomeSubstitutionsType | float | None,
        sigkill_timeout: SomeSubstitutionsType | float | None,
        emulate_tty: bool,
        respawn: bool | SomeSubstitutionsType,
    ) -> None:
        self.sigterm_timeout = _seconds(sigterm_timeout, "sigterm_timeout")
        self.sigkill_timeout = _seconds(sigkill_timeout, "sigkill_timeout")
        self.emulate_tty = emulate_tty
        self._respawn = respawn

    def perform(self, context: LaunchContext, name: str) -> None:
        """Perform the substitutions in the scope of the visit.

        Args:
            context: The context of the visit.
            name: The name of the process in errors.

        Raises:
            SubstitutionFailure: A substitution has no value.
            ValueError: A timeout is not a number.
        """
        self._name = name
        self._configurations = dict(context.launch_configurations)
        self._timeouts = self._perform_timeouts(context)
        #: True if the process finds a terminal at its output.
        self.emulates_tty = evaluate_condition_expression(
            context, [LaunchConfiguration("emulate_tty", default=str(self.emulate_tty))]
        )
        #: True if the process is started again after its end.
        self.respawns = (
            self._respawn
            if isinstance(self._respawn, bool)
            else evaluate_condition_expression(
                context, normalize_to_list_of_substitutions(self._respawn)
            )
        )

    def timeouts(self, context: LaunchContext, logger: Logger) -> list[str]:
        """Return both timeouts, which a launch file may have set after the start of the process.

        Configurations of a group that has ended have the values of the visit.
        """
        scopes = context.configuration_scopes
        scopes.push()
        scopes.replace({**self._configurations, **context.launch_configurations})
        try:
            return self._perform_timeouts(context)
        except Exception as error:  # noqa: BLE001  substitutions may raise anything
            # Without timeouts, a process that ignores SIGINT would never end.
            logger.error("%s; using %s", error, self._timeouts)  # noqa: TRY400
            return self._timeouts
        finally:
            scopes.pop()

    def _perform_timeouts(self, context: LaunchContext) -> list[str]:
        return [
            self._perform_timeout(context, "sigterm_timeout", self.sigterm_timeout),
            self._perform_timeout(context, "sigkill_timeout", self.sigkill_timeout),
        ]

    def _perform_timeout(
        self, context: LaunchContext, option: str, timeout: list[Substitution]
    ) -> str:
        text = perform_substitutions(context, timeout)
        try:
            float(text)
        except ValueError:
            raise ValueError(
                f"process[{self._name}]: expected a number of seconds as {option}, got '{text}'"
            ) from None
        return text


def _seconds(value: SomeSubstitutionsType | float | None, configuration: str) -> list[Substitution]:
    if value is None:
        # ROS 2's default in seconds.
        return normalize_to_list_of_substitutions(LaunchConfiguration(configuration, default=5))
    return normalize_to_list_of_substitutions(
        str(value) if isinstance(value, (int, float)) else value
    )
