// Rigid-body poses: a translation and a unit quaternion (x, y, z, w), and the arithmetic that tf2
// does with them.
#pragma once

#include <algorithm>
#include <cmath>

namespace turtlewire {

struct Vec3 {
  double x = 0.0, y = 0.0, z = 0.0;
  bool operator==(const Vec3&) const = default;
};

struct Quat {
  double x = 0.0, y = 0.0, z = 0.0, w = 1.0;
  bool operator==(const Quat&) const = default;
};

// The pose of one frame in another: `parent_from_child`.
struct Pose {
  Vec3 translation;
  Quat rotation;
  bool operator==(const Pose&) const = default;
};

inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(double k, const Vec3& v) { return {k * v.x, k * v.y, k * v.z}; }

inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline double dot(const Quat& a, const Quat& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}

inline Quat conjugate(const Quat& q) { return {-q.x, -q.y, -q.z, q.w}; }

inline Quat operator*(const Quat& a, const Quat& b) {
  return {
      a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y + a.y * b.w + a.z * b.x - a.x * b.z,
      a.w * b.z + a.z * b.w + a.x * b.y - a.y * b.x, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

// The vector turned by the unit quaternion: v + 2w(u×v) + 2u×(u×v), with u the vector part. The
// factor 2, which is exact, is applied to u: a chain of products waits for what comes after `v`.
inline Vec3 rotate(const Quat& q, const Vec3& v) {
  const Vec3 axis{q.x, q.y, q.z};
  const Vec3 twice = cross(2.0 * axis, v);
  return v + q.w * twice + cross(axis, twice);
}

// a_from_c = a_from_b * b_from_c
inline Pose operator*(const Pose& a, const Pose& b) {
  return {a.translation + rotate(a.rotation, b.translation), a.rotation * b.rotation};
}

// The same for quaternions of any length, which scale what they turn by its square.
inline Vec3 rotate_scaling(const Quat& q, const Vec3& v) {
  const Vec3 axis{q.x, q.y, q.z};
  const Vec3 twice = 2.0 * cross(axis, v);
  return dot(q, q) * v + q.w * twice + cross(axis, twice);
}
inline Pose compose_scaling(const Pose& a, const Pose& b) {
  return {a.translation + rotate_scaling(a.rotation, b.translation), a.rotation * b.rotation};
}
inline Pose between_scaling(const Pose& a, const Pose& b) {
  const Quat back = conjugate(a.rotation);
  return {rotate_scaling(back, b.translation - a.translation), back * b.rotation};
}

inline Pose inverse(const Pose& p) {
  const Quat back = conjugate(p.rotation);
  return {-1.0 * rotate(back, p.translation), back};
}

// inverse(a) * b, with the subtraction before the rotation: exact where both are far from the
// origin.
inline Pose between(const Pose& a, const Pose& b) {
  const Quat back = conjugate(a.rotation);
  return {rotate(back, b.translation - a.translation), back * b.rotation};
}

inline bool has_nan(const Vec3& v) { return std::isnan(v.x) || std::isnan(v.y) || std::isnan(v.z); }
inline bool has_nan(const Quat& q) {
  return std::isnan(q.x) || std::isnan(q.y) || std::isnan(q.z) || std::isnan(q.w);
}
// Whether a quaternion turns without scaling, to the precision of the arithmetic.
inline bool is_unit(const Quat& q) { return std::fabs(dot(q, q) - 1.0) < 1e-12; }
inline bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// tf2 stores a rotation by way of its 3x3 matrix. That normalises any length and picks one of q and
// -q: the sign that makes w positive if the trace is, else the sign that makes the largest of x, y,
// z positive. Duplicates are compared after it and a half turn interpolates by its sign, so the
// steps and their order are tf2's.
Quat through_matrix(const Quat& q);

// Whether one Newton step makes a quaternion of this squared length unit; false for NaN.
inline bool is_nearly_unit(double norm2) { return std::fabs(norm2 - 1.0) < 1e-8; }

// What through_matrix gives, but for rounding, at a fraction of the cost for a quaternion that is
// nearly unit: one Newton step, and the same choice of sign. As with tf2, q, -q and 2q give the
// same to the last bit.
Quat canonical_of_any_length(Quat q);
inline Quat canonical(const Quat& q) {
  const double norm2 = dot(q, q);
  if (!is_nearly_unit(norm2)) return canonical_of_any_length(q);
  const double xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z;
  const double larger = xx >= yy ? q.x : q.y;
  const double largest = std::max(xx, yy) >= zz ? larger : q.z;
  const double leading = 4.0 * q.w * q.w > norm2 ? q.w : largest;
  const double k = std::copysign(1.5 - 0.5 * norm2, leading);
  return {k * q.x, k * q.y, k * q.z, k * q.w};
}

}  // namespace turtlewire
