#include "pose.hpp"

namespace turtlewire {

Quat through_matrix(const Quat& q) {
  const double s = 2.0 / dot(q, q);
  const double xs = q.x * s, ys = q.y * s, zs = q.z * s;
  const double wx = q.w * xs, wy = q.w * ys, wz = q.w * zs;
  const double xx = q.x * xs, xy = q.x * ys, xz = q.x * zs;
  const double yy = q.y * ys, yz = q.y * zs, zz = q.z * zs;
  const double m00 = 1.0 - (yy + zz), m11 = 1.0 - (xx + zz), m22 = 1.0 - (xx + yy);
  const double trace = m00 + m11 + m22;
  if (trace > 0.0) {
    const double root = std::sqrt(trace + 1.0);
    const double f = 0.5 / root;
    return {((yz + wx) - (yz - wx)) * f, ((xz + wy) - (xz - wy)) * f, ((xy + wz) - (xy - wz)) * f,
            root * 0.5};
  }
  if (m00 >= m11 && m00 >= m22) {
    const double root = std::sqrt(m00 - m11 - m22 + 1.0);
    const double f = 0.5 / root;
    return {root * 0.5, ((xy + wz) + (xy - wz)) * f, ((xz - wy) + (xz + wy)) * f,
            ((yz + wx) - (yz - wx)) * f};
  }
  if (m11 >= m22) {
    const double root = std::sqrt(m11 - m22 - m00 + 1.0);
    const double f = 0.5 / root;
    return {((xy - wz) + (xy + wz)) * f, root * 0.5, ((yz + wx) + (yz - wx)) * f,
            ((xz + wy) - (xz - wy)) * f};
  }
  const double root = std::sqrt(m22 - m00 - m11 + 1.0);
  const double f = 0.5 / root;
  return {((xz + wy) + (xz - wy)) * f, ((yz - wx) + (yz + wx)) * f, root * 0.5,
          ((xy + wz) - (xy - wz)) * f};
}

Quat canonical_of_any_length(Quat q) {
  const double norm2 = dot(q, q);
  const bool is_far_from_unit = !(norm2 > 0.5 && norm2 < 2.0);  // else no power of 2 helps
  if (is_far_from_unit && std::isnormal(norm2)) {
    const double k = std::ldexp(
        1.0, -static_cast<int>(std::lround(0.5 * std::log2(norm2))));  // exact, as all powers of 2
    const Quat scaled{k * q.x, k * q.y, k * q.z, k * q.w};
    if (std::fabs(dot(scaled, scaled) - 1.0) < 1e-8) return canonical(scaled);
  }
  return through_matrix(q);
}

}  // namespace turtlewire
