// Interpolation between two samples: a straight line for the translation, the shortest great arc
// for the rotation.
#pragma once

#include <algorithm>
#include <cmath>

#include "pose.hpp"

namespace turtlewire {

struct Weights {
  double older, newer;
};

namespace detail {

// sin(k·θ)/sin(θ) as a series in (cos θ - 1), truncated after `Terms` terms; no trigonometric
// function, no division. D. Eberly, "A Fast and Accurate Algorithm for Computing SLERP", 2011.
template <int Terms>
inline double arc_weight(double k, double cos_minus_one) {
  const double k2 = k * k;
  double sum = 1.0;
  for (int i = Terms; i > 0; --i) {
    const double a = 1.0 / (i * (2.0 * i + 1.0)), b = i / (2.0 * i + 1.0);
    sum = 1.0 + (a * k2 - b) * cos_minus_one * sum;
  }
  return k * sum;
}

}  // namespace detail

// Below these cosines the series of 4 and of 9 terms no longer reaches 1e-15 (native/tests measures
// it).
inline constexpr double kFourTermsCosine = 0.9997;
inline constexpr double kNineTermsCosine = 0.98;

// The weights of SLERP for an angle of at most a quarter turn (cosine >= 0; q and -q are one
// rotation), with any ratio.
inline Weights exact_weights(double cosine, double ratio) {
  const double angle = std::acos(std::min(cosine, 1.0));
  // The arc of a small angle is a straight line to the last bit.
  if (angle < 1e-8) return {1.0 - ratio, ratio};
  const double scale = 1.0 / std::sin(angle);
  return {std::sin((1.0 - ratio) * angle) * scale, std::sin(ratio * angle) * scale};
}

// The same for a ratio from 0 to 1: the truncated series fail far outside of it.
inline Weights arc_weights(double cosine, double ratio) {
  if (cosine > kFourTermsCosine) [[likely]] {
    return {detail::arc_weight<4>(1.0 - ratio, cosine - 1.0),
            detail::arc_weight<4>(ratio, cosine - 1.0)};
  }
  if (cosine > kNineTermsCosine) {
    return {detail::arc_weight<9>(1.0 - ratio, cosine - 1.0),
            detail::arc_weight<9>(ratio, cosine - 1.0)};
  }
  return exact_weights(cosine, ratio);
}

// The sum of both, by the shorter way: q and -q are one rotation.
inline Quat weigh(const Quat& older, const Quat& newer, Weights weights, double cosine) {
  const double wo = weights.older, wn = cosine < 0.0 ? -weights.newer : weights.newer;
  return {wo * older.x + wn * newer.x, wo * older.y + wn * newer.y, wo * older.z + wn * newer.z,
          wo * older.w + wn * newer.w};
}

template <auto Arc = arc_weights>
Quat slerp(const Quat& older, const Quat& newer, double ratio) {
  const double cosine = dot(older, newer);
  return weigh(older, newer, Arc(std::fabs(cosine), ratio), cosine);
}

// Of quaternions of any length: by the angle between them; of one direction, it is the older.
template <auto Arc = arc_weights>
Quat slerp_scaling(const Quat& older, const Quat& newer, double ratio) {
  const double cosine = dot(older, newer) / std::sqrt(dot(older, older) * dot(newer, newer));
  if (std::fabs(cosine) >= 1.0) return older;
  return weigh(older, newer, Arc(std::fabs(cosine), ratio), cosine);
}

template <auto Arc = arc_weights>
Pose interpolate(const Pose& older, const Pose& newer, double ratio) {
  return {(1.0 - ratio) * older.translation + ratio * newer.translation,
          slerp<Arc>(older.rotation, newer.rotation, ratio)};
}
template <auto Arc = arc_weights>
Pose interpolate_scaling(const Pose& older, const Pose& newer, double ratio) {
  return {(1.0 - ratio) * older.translation + ratio * newer.translation,
          slerp_scaling<Arc>(older.rotation, newer.rotation, ratio)};
}

}  // namespace turtlewire
