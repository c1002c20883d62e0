// Reads tf2_msgs/msg/TFMessage from its CDR bytes. Never reads past them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pose.hpp"
#include "samples.hpp"

namespace turtlewire {

// One transform of a message, still in the bytes.
struct ReceivedTransform {
  Stamp stamp;
  std::string_view parent, child;
  const unsigned char* numbers;
  bool swapped;  // the numbers have the other byte order

  Pose pose() const;
};

// A TFMessage taken apart; its transforms point into the bytes given. Reusing one saves memory
// allocations.
class TfMessage {
 public:
  // Returns what is wrong with the bytes; empty if nothing is.
  std::string decode(const unsigned char* bytes, std::size_t size);
  std::span<const ReceivedTransform> transforms() const { return {places_.data(), count_}; }

 private:
  std::vector<ReceivedTransform> places_;  // never shrinks
  std::size_t count_ = 0;
};

}  // namespace turtlewire
