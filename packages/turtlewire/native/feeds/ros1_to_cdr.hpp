// Converts the messages of one type from the bytes of ROS 1 to CDR.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace turtlewire {

// What is done with the next bytes of a message. The numbers are those of
// turtlewire/bag/ros1_steps.py.
struct ConversionStep {
  enum class Kind : std::uint32_t {
    kNumbers,    // `size` bytes are copied
    kBooleans,   // the same; they are 0 or 1
    kSkip,       // `size` bytes are left out
    kText,       // a string
    kFrame,      // a string, without the slashes that it begins with
    kSequence,   // numbers of `size` bytes after their count
    kLoop,       // a sequence whose elements the next `body` steps convert
    kRepeat,     // an array of `size` elements, as above
    kZeros,      // `size` bytes that ROS 1 does not have
    kEmptyText,  // a string that ROS 1 does not have
  };
  Kind kind;
  std::uint32_t size, align, body;
};

class Ros1ToCdr {
 public:
  explicit Ros1ToCdr(std::vector<ConversionStep> steps) : steps_(std::move(steps)) {}

  // Appends the CDR of a message to an empty vector. False for bytes that do not follow the steps
  // or hold text beyond ASCII: a slower decoder finds out what they are.
  bool convert(std::span<const unsigned char> message, std::vector<unsigned char>& cdr) const;

 private:
  std::vector<ConversionStep> steps_;
};

}  // namespace turtlewire
