// Reads tf2_msgs/msg/TFMessage from its CDR bytes. Never reads past them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "pose.hpp"
#include "samples.hpp"

namespace turtlewire {

struct ReceivedTransform {
  Stamp stamp;
  std::string_view parent, child;  // into the bytes
  Pose pose;
};

// Replaces `transforms` by those of the message. Returns what is wrong with the bytes; empty if nothing is.
std::string decode_tf_message(const unsigned char* bytes, std::size_t size, std::vector<ReceivedTransform>& transforms);

}  // namespace turtlewire
