// A serialized transform.
#pragma once

#include <string_view>

#include "pose.hpp"
#include "samples.hpp"

namespace turtlewire {

// Points into the bytes of a message.
struct ReceivedTransform {
  Stamp stamp;
  std::string_view parent, child;
  const unsigned char* numbers;  // the seven of its pose, as doubles
  bool swapped;                  // the numbers have the other byte order

  Pose pose() const;
};

}  // namespace turtlewire
