"""The type of arguments that are remapping rules."""

from collections.abc import Iterable, Sequence

from launch.some_substitutions_type import SomeSubstitutionsType
from launch.substitution import Substitution

#: From and to, each performed by joining.
RemapRule = tuple[Sequence[Substitution], Sequence[Substitution]]
#: From and to.
SomeRemapRule = tuple[SomeSubstitutionsType, SomeSubstitutionsType]
#: Several rules.
SomeRemapRules = Iterable[SomeRemapRule | RemapRule]
