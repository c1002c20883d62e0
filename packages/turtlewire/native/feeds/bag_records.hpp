// The records of bags: those of MCAP chunks, and those of the chunks of ROS 1's bags.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace turtlewire {

// A number of little endian bytes.
template <typename T>
T little(const unsigned char* p) {
  T value = 0;
  if constexpr (std::endian::native == std::endian::little) {
    std::memcpy(&value, p, sizeof(T));
  } else {
    for (std::size_t i = sizeof(T); i-- > 0;) value = static_cast<T>(value << 8 | p[i]);
  }
  return value;
}

struct BagRecord {
  bool is_message = false;
  std::uint32_t channel = 0;  // in ROS 1 the connection; this and the next three: of a message
  std::uint64_t log_time = 0, publish_time = 0;  // the same in ROS 1
  std::span<const unsigned char> data;
  std::size_t end = 0;  // where the next record begins
};

// False if the record at `at` does not fit into the bytes, or is a message without its fields.
bool read_mcap_record(BagRecord& record, std::span<const unsigned char> records, std::size_t at);
bool read_ros1_record(BagRecord& record, std::span<const unsigned char> records, std::size_t at);

}  // namespace turtlewire
