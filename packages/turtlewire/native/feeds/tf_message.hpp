// Reads tf2_msgs/msg/TFMessage from its CDR bytes. Never reads past them.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "../core/shared_buffer.hpp"

namespace turtlewire {

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
