// From a JointState's bytes to a TFMessage's bytes, for joints that were worked out before.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace turtlewire {

// One joint: its transform is made of its position, which is factor * positions[source] + offset.
struct JointFrame {
  // Translation at 0 (3), its change by the position (3), the quaternion that cos(position / 2)
  // multiplies (4), the one that sin(position / 2) multiplies (4), 1 if the joint turns, else 0.
  std::array<double, 15> constants;
  std::size_t source;
  double factor, offset;
  std::size_t stamp_at, pose_at;  // where its stamp and its seven numbers are in the message
};

class JointFrames {
 public:
  static constexpr std::size_t kStampAt = 4;  // in a JointState

  // `message` is a TFMessage whose stamps and poses are rewritten each time. Throws
  // std::invalid_argument if they do not lie within it.
  JointFrames(std::vector<unsigned char> message, std::vector<JointFrame> joints);

  std::size_t size() const { return message_.size(); }
  // Writes size() bytes. `positions` is where the first position is in the JointState. False if the
  // JointState ends before the last position.
  bool write(std::span<const unsigned char> joint_state, std::size_t positions,
             unsigned char* out) const;

 private:
  std::vector<unsigned char> message_;
  std::vector<JointFrame> joints_;
  std::size_t sources_ = 0;  // how many positions a JointState must have
};

}  // namespace turtlewire
