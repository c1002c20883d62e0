#include "tf_message.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace turtlewire {
namespace {

constexpr std::size_t kHeaderSize = 4;          // encapsulation: representation, options
constexpr std::size_t kSmallestTransform = 72;  // stamp, two empty strings, seven doubles
constexpr std::size_t kNumbersSize = 7 * sizeof(double);

template <typename T>
T load(const unsigned char* p, bool swapped) {
  T value;
  if (swapped) {
    unsigned char reversed[sizeof(T)];
    std::reverse_copy(p, p + sizeof(T), reversed);
    std::memcpy(&value, reversed, sizeof(T));
  } else {
    std::memcpy(&value, p, sizeof(T));
  }
  return value;
}

// A cursor over the body, of which each step either fits or leaves everything alone and says no.
class Reader {
 public:
  Reader(const unsigned char* body, std::size_t size, bool swapped)
      : body_(body), size_(size), swapped_(swapped) {}

  std::size_t remaining() const { return size_ - at_; }

  bool u32(std::uint32_t& value) {
    const unsigned char* p = nullptr;
    if (!take(4, 4, p)) return false;
    value = load<std::uint32_t>(p, swapped_);
    return true;
  }

  // A string's length counts its NUL; a length of 0 is sent by some for an empty string.
  bool text(std::string_view& value) {
    std::uint32_t length = 0;
    const unsigned char* p = nullptr;
    value = {};
    if (!u32(length)) return false;
    if (length == 0) return true;
    if (!take(1, length, p) || p[length - 1] != 0) return false;
    value = {reinterpret_cast<const char*>(p), length - 1};
    return true;
  }

  bool transform(ReceivedTransform& result) {
    std::uint32_t sec = 0, nanosec = 0;
    if (!u32(sec) || !u32(nanosec)) return false;
    result.stamp = Stamp{static_cast<std::int32_t>(sec)} * 1'000'000'000 + nanosec;
    result.swapped = swapped_;
    return text(result.parent) && text(result.child) && take(8, kNumbersSize, result.numbers);
  }

 private:
  bool take(std::size_t alignment, std::size_t count, const unsigned char*& start) {
    const std::size_t at = (at_ + alignment - 1) & ~(alignment - 1);
    if (at > size_ || size_ - at < count) return false;
    at_ = at + count;
    start = body_ + at;
    return true;
  }

  const unsigned char* body_;
  std::size_t size_;
  std::size_t at_ = 0;
  bool swapped_;
};

}  // namespace

std::string TfMessage::decode(const unsigned char* bytes, std::size_t size) {
  count_ = 0;
  if (size < kHeaderSize + 4)
    return "a TFMessage has at least 8 bytes, these are " + std::to_string(size);
  if (bytes[0] != 0 || bytes[1] > 1) {
    return "the first two bytes, " + std::to_string(bytes[0]) + " " + std::to_string(bytes[1]) +
           ", are not those of plain CDR (0 0 or 0 1)";
  }
  const bool little = bytes[1] == 1;
  Reader reader(bytes + kHeaderSize, size - kHeaderSize,
                little != (std::endian::native == std::endian::little));
  std::uint32_t count = 0;
  reader.u32(count);
  if (count > (reader.remaining() + 8) / kSmallestTransform) {
    return std::to_string(count) + " transforms are announced, which do not fit into " +
           std::to_string(size) + " bytes";
  }
  if (places_.size() < count) places_.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!reader.transform(places_[i])) {
      return "transform " + std::to_string(i) + " of " + std::to_string(count) +
             " ends beyond the " + std::to_string(size) +
             " bytes, or has a string without its final NUL";
    }
  }
  count_ = count;
  return "";
}

}  // namespace turtlewire
