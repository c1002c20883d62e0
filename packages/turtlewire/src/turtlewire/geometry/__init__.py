"""Rotations and poses as numbers: one at a time on plain floats, or many at once in arrays.

Quaternions are ``x, y, z, w`` and, unless a function says otherwise, of unit length. Poses are
``x, y, z, qx, qy, qz, qw`` and named ``parent_from_child``. Matrices act on column vectors from the
left.

=============  ====================================================
module         what it holds
=============  ====================================================
`quaternions`  one rotation, as plain tuples; no NumPy
`poses`        one pose, as plain tuples; tf2's arithmetic, no NumPy
`arrays`       rotations as NumPy arrays
=============  ====================================================
"""
