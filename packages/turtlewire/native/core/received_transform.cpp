#include "received_transform.hpp"

#include <algorithm>
#include <cstring>

namespace turtlewire {

Pose ReceivedTransform::pose() const {
  unsigned char bytes[7 * sizeof(double)];
  std::memcpy(bytes, numbers, sizeof bytes);
  if (swapped) {
    for (unsigned char* number = bytes; number != bytes + sizeof bytes; number += sizeof(double))
      std::reverse(number, number + sizeof(double));
  }
  double v[7];
  std::memcpy(v, bytes, sizeof v);
  return {{v[0], v[1], v[2]}, {v[3], v[4], v[5], v[6]}};
}

}  // namespace turtlewire
