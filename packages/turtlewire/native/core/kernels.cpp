// Compiled with contraction allowed: where the processor has fused multiply-add, it is used.
// Results differ by rounding.
#include "kernels.hpp"

#include "interpolate.hpp"

namespace turtlewire {
namespace {

// The bodies, written once. Each is inlined into one function for each kind of processor, whose
// instructions it then uses.

[[gnu::always_inline]] inline void interpolate_lanes(const Lanes& a, const Lanes& b,
                                                     const double* ratio, Lanes& result,
                                                     double* cosine) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double u = ratio[i], w = 1.0 - u;
    for (std::size_t k = 0; k < 3; ++k) result.v[k][i] = w * a.v[k][i] + u * b.v[k][i];
    const double c = a.v[3][i] * b.v[3][i] + a.v[4][i] * b.v[4][i] + a.v[5][i] * b.v[5][i] +
                     a.v[6][i] * b.v[6][i];
    const double x = std::fabs(c) - 1.0;
    cosine[i] = std::fabs(c);
    const double wa = detail::arc_weight<9>(w, x);
    const double wb = std::copysign(1.0, c) * detail::arc_weight<9>(u, x);
    for (std::size_t k = 3; k < 7; ++k) result.v[k][i] = wa * a.v[k][i] + wb * b.v[k][i];
  }
}

[[gnu::always_inline]] inline void compose_lanes(const Lanes& outer, Lanes& result) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    const Pose p = outer.pose(i) * result.pose(i);
    result.set(i, p);
  }
}

[[gnu::always_inline]] inline void between_lanes(const Lanes& base, Lanes& result) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    const Pose p = between(base.pose(i), result.pose(i));
    result.set(i, p);
  }
}

[[gnu::always_inline]] inline void canonicalize_lanes(Lanes& result) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double x = result.v[3][i], y = result.v[4][i], z = result.v[5][i], w = result.v[6][i];
    const double xx = x * x, yy = y * y, zz = z * z, ww = w * w;
    const double norm2 = xx + yy + zz + ww;
    const double larger = xx >= yy ? x : y;
    const double largest = larger * larger >= zz ? larger : z;
    const double leading = 4.0 * ww > norm2 ? w : largest;
    const double k = std::copysign(1.5 - 0.5 * norm2, leading);
    result.v[3][i] = k * x;
    result.v[4][i] = k * y;
    result.v[5][i] = k * z;
    result.v[6][i] = k * w;
  }
}

[[gnu::always_inline]] inline void apply_lanes(const Lanes& poses, double* points) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    const Pose p = poses.pose(i);
    const Vec3 moved =
        p.translation + rotate(p.rotation, {points[3 * i], points[3 * i + 1], points[3 * i + 2]});
    points[3 * i] = moved.x;
    points[3 * i + 1] = moved.y;
    points[3 * i + 2] = moved.z;
  }
}

namespace plain {
void interpolate(const Lanes& older, const Lanes& newer, const double* ratio, Lanes& result,
                 double* cosine) {
  interpolate_lanes(older, newer, ratio, result, cosine);
}
void compose(const Lanes& outer, Lanes& result) { compose_lanes(outer, result); }
void between(const Lanes& base, Lanes& result) { between_lanes(base, result); }
void canonicalize(Lanes& result) { canonicalize_lanes(result); }
void apply(const Lanes& poses, double* points) { apply_lanes(poses, points); }
constexpr Kernels all{"plain", interpolate, compose, between, canonicalize, apply};
}  // namespace plain

#if defined(__GNUC__) && defined(__x86_64__)
namespace avx2 {
[[gnu::target("avx2,fma")]] void interpolate(const Lanes& older, const Lanes& newer,
                                             const double* ratio, Lanes& result, double* cosine) {
  interpolate_lanes(older, newer, ratio, result, cosine);
}
[[gnu::target("avx2,fma")]] void compose(const Lanes& outer, Lanes& result) {
  compose_lanes(outer, result);
}
[[gnu::target("avx2,fma")]] void between(const Lanes& base, Lanes& result) {
  between_lanes(base, result);
}
[[gnu::target("avx2,fma")]] void canonicalize(Lanes& result) { canonicalize_lanes(result); }
[[gnu::target("avx2,fma")]] void apply(const Lanes& poses, double* points) {
  apply_lanes(poses, points);
}
constexpr Kernels all{"avx2", interpolate, compose, between, canonicalize, apply};
}  // namespace avx2

namespace avx512 {
[[gnu::target("avx512f,avx512dq,avx512vl,avx2,fma")]] void interpolate(
    const Lanes& older, const Lanes& newer, const double* ratio, Lanes& result, double* cosine) {
  interpolate_lanes(older, newer, ratio, result, cosine);
}
[[gnu::target("avx512f,avx512dq,avx512vl,avx2,fma")]] void compose(const Lanes& outer,
                                                                   Lanes& result) {
  compose_lanes(outer, result);
}
[[gnu::target("avx512f,avx512dq,avx512vl,avx2,fma")]] void between(const Lanes& base,
                                                                   Lanes& result) {
  between_lanes(base, result);
}
[[gnu::target("avx512f,avx512dq,avx512vl,avx2,fma")]] void canonicalize(Lanes& result) {
  canonicalize_lanes(result);
}
[[gnu::target("avx512f,avx512dq,avx512vl,avx2,fma")]] void apply(const Lanes& poses,
                                                                 double* points) {
  apply_lanes(poses, points);
}
constexpr Kernels all{"avx512", interpolate, compose, between, canonicalize, apply};
}  // namespace avx512

std::vector<const Kernels*> usable() {
  std::vector<const Kernels*> found{&plain::all};
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) found.push_back(&avx2::all);
  if (__builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
    found.push_back(&avx512::all);
  return found;
}
#else
std::vector<const Kernels*> usable() { return {&plain::all}; }
#endif

}  // namespace

const std::vector<const Kernels*>& all_kernels() {
  // Never destroyed: a daemon thread of Python may compute until the process has ended.
  static const std::vector<const Kernels*>& found = *new std::vector(usable());
  return found;
}

const Kernels& kernels() { return *all_kernels().back(); }

}  // namespace turtlewire
