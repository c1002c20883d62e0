"""Quaternions, Euler angles and 4x4 matrices.

The functions of ROS 2's ``tf_transformations`` 1.1.1.

Quaternions are ``(x, y, z, w)``, angles radians, matrices ``(4, 4)`` arrays that act on column
vectors from the left. Euler angles name their axes: ``"sxyz"`` is roll, pitch, yaw about the static
x, y and z axes; ``"rzyx"`` is yaw, pitch, roll about axes that turn along.

Functions of one quaternion work on plain floats, so that a node that only needs
:func:`quaternion_from_euler` starts without NumPy; everything else loads it at its first use.

==============  =============================================
module          contents
==============  =============================================
`_quaternions`  one quaternion at a time, on plain floats
`_matrices`     4x4 matrices of single operations, and back
`_composition`  of angles, quaternions and all parts together
`_arrays`       vectors, interpolation, random rotations
`_arcball`      rotations with the mouse
==============  =============================================
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ._quaternions import (
    euler_from_quaternion,
    quaternion_about_axis,
    quaternion_conjugate,
    quaternion_from_euler,
    quaternion_inverse,
    quaternion_multiply,
)

if TYPE_CHECKING:
    from ._arcball import (
        Arcball,
        arcball_constrain_to_axis,
        arcball_map_to_sphere,
        arcball_nearest_axis,
    )
    from ._arrays import (
        quaternion_slerp,
        random_quaternion,
        random_rotation_matrix,
        random_vector,
        superimposition_matrix,
        unit_vector,
        vector_norm,
    )
    from ._composition import (
        compose_matrix,
        decompose_matrix,
        euler_from_matrix,
        euler_matrix,
        orthogonalization_matrix,
        quaternion_from_matrix,
        quaternion_matrix,
    )
    from ._matrices import (
        ROTATION_IDENTITY,
        SHEAR_IDENTITY,
        TRANSLATION_IDENTITY,
        ZOOM_IDENTITY,
        clip_matrix,
        concatenate_matrices,
        identity_matrix,
        inverse_matrix,
        is_same_transform,
        projection_from_matrix,
        projection_matrix,
        reflection_from_matrix,
        reflection_matrix,
        rotation_from_matrix,
        rotation_matrix,
        scale_from_matrix,
        scale_matrix,
        shear_from_matrix,
        shear_matrix,
        translation_from_matrix,
        translation_matrix,
    )

__all__ = [
    "ROTATION_IDENTITY",
    "SHEAR_IDENTITY",
    "TRANSLATION_IDENTITY",
    "ZOOM_IDENTITY",
    "Arcball",
    "arcball_constrain_to_axis",
    "arcball_map_to_sphere",
    "arcball_nearest_axis",
    "clip_matrix",
    "compose_matrix",
    "concatenate_matrices",
    "decompose_matrix",
    "euler_from_matrix",
    "euler_from_quaternion",
    "euler_matrix",
    "identity_matrix",
    "inverse_matrix",
    "is_same_transform",
    "orthogonalization_matrix",
    "projection_from_matrix",
    "projection_matrix",
    "quaternion_about_axis",
    "quaternion_conjugate",
    "quaternion_from_euler",
    "quaternion_from_matrix",
    "quaternion_inverse",
    "quaternion_matrix",
    "quaternion_multiply",
    "quaternion_slerp",
    "random_quaternion",
    "random_rotation_matrix",
    "random_vector",
    "reflection_from_matrix",
    "reflection_matrix",
    "rotation_from_matrix",
    "rotation_matrix",
    "scale_from_matrix",
    "scale_matrix",
    "shear_from_matrix",
    "shear_matrix",
    "superimposition_matrix",
    "translation_from_matrix",
    "translation_matrix",
    "unit_vector",
    "vector_norm",
]


def _named_here(value: Any) -> Any:
    """Return the same, but its help and repr name this package, as in ROS 2, not a part of it."""
    if hasattr(value, "__module__"):
        value.__module__ = __name__
    return value


for _function in (
    euler_from_quaternion,
    quaternion_about_axis,
    quaternion_conjugate,
    quaternion_from_euler,
    quaternion_inverse,
    quaternion_multiply,
):
    _named_here(_function)


def __getattr__(name: str) -> Any:
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from . import _arcball, _arrays, _composition, _matrices

    for module in (_matrices, _composition, _arrays, _arcball):
        if hasattr(module, name):
            # Kept in the module, so that this function is called once per name.
            value = globals()[name] = _named_here(getattr(module, name))
            return value
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
