#include "bag_records.hpp"

#include <algorithm>
#include <string_view>

namespace turtlewire {
namespace {

constexpr unsigned char kMcapMessage = 5;
constexpr std::size_t kPrefix = 1 + 8;              // opcode, length
constexpr std::size_t kMessageFields = 2 + 4 + 16;  // channel, sequence, log and publish time

constexpr unsigned char kRos1Message = 2;
constexpr std::uint64_t kSecond = 1'000'000'000;

// A part whose length stands before it; false if it does not fit.
bool take_part(std::span<const unsigned char>& bytes, std::span<const unsigned char>& part) {
  if (bytes.size() < 4) return false;
  const std::size_t size = little<std::uint32_t>(bytes.data());
  if (size > bytes.size() - 4) return false;
  part = bytes.subspan(4, size);
  bytes = bytes.subspan(4 + size);
  return true;
}

// The fields that a message needs, of the header `name=value`, `name=value` …
struct Ros1Header {
  int opcode = -1;
  const unsigned char *connection = nullptr, *time = nullptr;

  bool read(std::span<const unsigned char> header) {
    std::span<const unsigned char> field;
    while (!header.empty()) {
      if (!take_part(header, field)) return false;
      const auto equals = std::ranges::find(field, '=');
      if (equals == field.end()) return false;
      const auto size = static_cast<std::size_t>(equals - field.begin());
      const std::string_view name(reinterpret_cast<const char*>(field.data()), size);
      const auto value = field.subspan(size + 1);
      if (name == "op" && value.size() == 1) opcode = value[0];
      if (name == "conn" && value.size() == 4) connection = value.data();
      if (name == "time" && value.size() == 8) time = value.data();
    }
    return true;
  }
};

}  // namespace

bool read_mcap_record(BagRecord& record, std::span<const unsigned char> records, std::size_t at) {
  const std::size_t rest = records.size() - at;
  if (rest < kPrefix) return false;
  const unsigned char* p = records.data() + at;
  const auto length = little<std::uint64_t>(p + 1);
  if (length > rest - kPrefix) return false;
  record.is_message = *p == kMcapMessage;
  record.end = at + kPrefix + static_cast<std::size_t>(length);
  if (!record.is_message) return true;
  if (length < kMessageFields) return false;
  record.channel = little<std::uint16_t>(p + kPrefix);
  record.log_time = little<std::uint64_t>(p + kPrefix + 6);
  record.publish_time = little<std::uint64_t>(p + kPrefix + 14);
  record.data = {p + kPrefix + kMessageFields, static_cast<std::size_t>(length) - kMessageFields};
  return true;
}

bool read_ros1_record(BagRecord& record, std::span<const unsigned char> records, std::size_t at) {
  std::span<const unsigned char> rest = records.subspan(at), head;
  Ros1Header header;
  if (!take_part(rest, head) || !take_part(rest, record.data) || !header.read(head)) return false;
  record.end = records.size() - rest.size();
  record.is_message = header.opcode == kRos1Message;
  if (!record.is_message) return true;
  if (header.connection == nullptr || header.time == nullptr) return false;
  record.channel = little<std::uint32_t>(header.connection);
  record.log_time =
      little<std::uint32_t>(header.time) * kSecond + little<std::uint32_t>(header.time + 4);
  record.publish_time = record.log_time;
  return true;
}

}  // namespace turtlewire
