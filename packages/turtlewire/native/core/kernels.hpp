// The arithmetic of a batch: the same few steps on many poses at once, chosen at run time for the
// processor.
#pragma once

#include <cstddef>
#include <vector>

#include "pose.hpp"

namespace turtlewire {

inline constexpr std::size_t kLanes = 64;

// So many poses side by side: x, y, z, qx, qy, qz, qw.
struct Lanes {
  alignas(64) double v[7][kLanes];

  Pose pose(std::size_t i) const {
    return {{v[0][i], v[1][i], v[2][i]}, {v[3][i], v[4][i], v[5][i], v[6][i]}};
  }
  void set(std::size_t i, const Pose& p) {
    const double values[7] = {p.translation.x, p.translation.y, p.translation.z, p.rotation.x,
                              p.rotation.y,    p.rotation.z,    p.rotation.w};
    for (std::size_t k = 0; k < 7; ++k) v[k][i] = values[k];
  }
  void fill(const Pose& p) {
    for (std::size_t i = 0; i < kLanes; ++i) set(i, p);
  }
};

struct Kernels {
  const char* name;
  // Each lane a part `ratio` of the way from older to newer. Where |cosine| is below
  // kNineTermsCosine the rotation is not exact, and the caller does it again.
  void (*interpolate)(const Lanes& older, const Lanes& newer, const double* ratio, Lanes& result,
                      double* cosine);
  // result = outer * result
  void (*compose)(const Lanes& outer, Lanes& result);
  // result = inverse(base) * result
  void (*between)(const Lanes& base, Lanes& result);
  // Rotations normalised and signed as tf2's results are; they are unit but for rounding.
  void (*canonicalize)(Lanes& result);
  // points[3i..] = pose i * points[3i..]
  void (*apply)(const Lanes& poses, double* points);
};

// The kernels that this processor supports, the simplest first.
const std::vector<const Kernels*>& all_kernels();
// The last of them.
const Kernels& kernels();

}  // namespace turtlewire
