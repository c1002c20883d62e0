#include "joint_frames.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace turtlewire {
namespace {

static_assert(std::endian::native == std::endian::little, "CDR is copied as it is");

constexpr std::size_t kStampSize = 8, kPose = 7;

void write_pose(const std::array<double, 15>& c, double position, unsigned char* out) {
  const double half = 0.5 * position * c[14];
  const double cosine = std::cos(half), sine = std::sin(half);
  double pose[kPose];
  for (std::size_t i = 0; i < 3; ++i) pose[i] = c[i] + position * c[3 + i];
  for (std::size_t i = 0; i < 4; ++i) pose[3 + i] = cosine * c[6 + i] + sine * c[10 + i];
  std::memcpy(out, pose, sizeof pose);
}

}  // namespace

JointFrames::JointFrames(std::vector<unsigned char> message, std::vector<JointFrame> joints)
    : message_(std::move(message)), joints_(std::move(joints)) {
  const auto within = [this](std::size_t at, std::size_t size) {
    return size <= message_.size() && at <= message_.size() - size;
  };
  for (const JointFrame& joint : joints_) {
    if (!within(joint.stamp_at, kStampSize) || !within(joint.pose_at, kPose * sizeof(double)))
      throw std::invalid_argument("a stamp or a pose lies outside of the message");
    sources_ = std::max(sources_, joint.source + 1);
  }
}

bool JointFrames::write(std::span<const unsigned char> joint_state, std::size_t positions,
                        unsigned char* out) const {
  const std::size_t size = joint_state.size();
  if (size < kStampAt + kStampSize || positions > size ||
      (size - positions) / sizeof(double) < sources_)
    return false;
  std::memcpy(out, message_.data(), message_.size());
  for (const JointFrame& joint : joints_) {
    double given;
    std::memcpy(&given, joint_state.data() + positions + joint.source * sizeof given, sizeof given);
    std::memcpy(out + joint.stamp_at, joint_state.data() + kStampAt, kStampSize);
    write_pose(joint.constants, joint.factor * given + joint.offset, out + joint.pose_at);
  }
  return true;
}

}  // namespace turtlewire
