#include "tf_message.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace turtlewire {
namespace {

constexpr std::size_t kHeaderSize = 4;          // encapsulation: representation, options
constexpr std::size_t kSmallestTransform = 72;  // stamp, two empty strings, seven doubles
constexpr std::size_t kNumbersSize = 7 * sizeof(double);

// A cursor over the body. A read that does not fit leaves `fits` false and the cursor at the end.
class Reader {
 public:
  Reader(const unsigned char* body, std::size_t size, bool swap) : body_(body), size_(size), swap_(swap) {}

  bool fits = true;
  std::size_t position() const { return at_; }
  std::size_t remaining() const { return size_ - at_; }

  std::uint32_t u32() {
    const unsigned char* p = take(4, 4);
    return p == nullptr ? 0 : load<std::uint32_t>(p);
  }

  // A string's length counts its NUL; a length of 0 is sent by some for an empty string.
  std::string_view text() {
    const std::uint32_t length = u32();
    if (length == 0) return {};
    const unsigned char* p = take(1, length);
    if (p == nullptr) return {};
    if (p[length - 1] != 0) fits = false;
    return {reinterpret_cast<const char*>(p), length - 1};
  }

  void pose(Pose& pose) {
    const unsigned char* p = take(8, kNumbersSize);
    if (p == nullptr) return;
    double v[7];
    for (int i = 0; i < 7; ++i) v[i] = std::bit_cast<double>(load<std::uint64_t>(p + 8 * i));
    pose = {{v[0], v[1], v[2]}, {v[3], v[4], v[5], v[6]}};
  }

 private:
  const unsigned char* take(std::size_t alignment, std::size_t count) {
    const std::size_t start = (at_ + alignment - 1) & ~(alignment - 1);
    if (!fits || start > size_ || size_ - start < count) {
      fits = false;
      at_ = size_;
      return nullptr;
    }
    at_ = start + count;
    return body_ + start;
  }

  template <typename T>
  T load(const unsigned char* p) const {
    T value;
    if (swap_) {
      unsigned char reversed[sizeof(T)];
      std::reverse_copy(p, p + sizeof(T), reversed);
      std::memcpy(&value, reversed, sizeof(T));
    } else {
      std::memcpy(&value, p, sizeof(T));
    }
    return value;
  }

  const unsigned char* body_;
  std::size_t size_;
  std::size_t at_ = 0;
  bool swap_;
};

}  // namespace

std::string decode_tf_message(const unsigned char* bytes, std::size_t size,
                              std::vector<ReceivedTransform>& transforms) {
  transforms.clear();
  if (size < kHeaderSize + 4) return "a TFMessage has at least 8 bytes, these are " + std::to_string(size);
  if (bytes[0] != 0 || bytes[1] > 1) {
    return "the first two bytes, " + std::to_string(bytes[0]) + " " + std::to_string(bytes[1]) +
           ", are not those of plain CDR (0 0 or 0 1)";
  }
  const bool little = bytes[1] == 1;
  Reader reader(bytes + kHeaderSize, size - kHeaderSize, little != (std::endian::native == std::endian::little));
  const std::uint32_t count = reader.u32();
  if (count > (reader.remaining() + 8) / kSmallestTransform) {
    return std::to_string(count) + " transforms are announced, which do not fit into " + std::to_string(size) +
           " bytes";
  }
  transforms.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    ReceivedTransform& transform = transforms[i];
    const auto seconds = static_cast<std::int32_t>(reader.u32());
    transform.stamp = Stamp{seconds} * 1'000'000'000 + reader.u32();
    transform.parent = reader.text();
    transform.child = reader.text();
    reader.pose(transform.pose);
    if (!reader.fits) {
      transforms.clear();
      return "transform " + std::to_string(i) + " of " + std::to_string(count) + " ends beyond the " +
             std::to_string(size) + " bytes, or has a string without its final NUL";
    }
  }
  return "";
}

}  // namespace turtlewire
