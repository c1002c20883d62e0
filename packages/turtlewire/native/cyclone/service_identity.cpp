#include "service_identity.hpp"

#include <algorithm>
#include <cstring>

namespace turtlewire::cyclone {
namespace {

using Bytes = std::span<const unsigned char>;

// Fast DDS from 2.13 on reads the first and ignores the second of other vendors; 2.6 (Humble) knows
// only the second.
constexpr std::uint16_t kRelatedIdentity = 0x0083, kFormerRelatedIdentity = 0x800f, kSentinel = 1;
constexpr std::size_t kIdentitySize = 24;

constexpr unsigned char kDataMessage = 0x15, kDataFrag = 0x16;
constexpr unsigned char kLittleEndian = 1, kHasInlineQos = 2;
constexpr std::size_t kPacketHeader = 20, kDataHeader = 24, kGuidPrefix = 12;

// Numbers of a submessage, which says in which order their bytes are. The caller keeps to its size.
class Reader {
 public:
  Reader(Bytes bytes, bool little) : bytes_(bytes), little_(little) {}

  std::uint32_t number(std::size_t at, std::size_t size) const {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < size; ++i)
      value |= std::uint32_t{bytes_[at + i]} << 8 * (little_ ? i : size - 1 - i);
    return value;
  }
  std::uint16_t u16(std::size_t at) const { return static_cast<std::uint16_t>(number(at, 2)); }
  // A sequence number: its high half comes first in both orders.
  std::int64_t sequence(std::size_t at) const {
    return static_cast<std::int64_t>(std::uint64_t{number(at, 4)} << 32 | number(at + 4, 4));
  }

 private:
  Bytes bytes_;
  bool little_;
};

bool is_guid(const std::array<unsigned char, 16>& guid) {
  return guid.back() != 0 &&
         std::any_of(guid.begin(), guid.begin() + kGuidPrefix, [](auto byte) { return byte != 0; });
}

// The last identity among the parameters of `head` from `at` on.
std::optional<Identity> find_parameter(Bytes head, const Reader& reader, std::size_t at) {
  std::optional<Identity> found;
  while (at + 4 <= head.size()) {
    const std::uint16_t name = reader.u16(at);
    const std::size_t size = reader.u16(at + 2);
    at += 4;
    if (name == kSentinel || size > head.size() - at) break;
    if ((name == kRelatedIdentity || name == kFormerRelatedIdentity) && size >= kIdentitySize) {
      Identity identity;
      std::copy_n(head.data() + at, identity.guid.size(), identity.guid.begin());
      identity.number = reader.sequence(at + identity.guid.size());
      if (is_guid(identity.guid)) found = identity;
    }
    at += size;
  }
  return found;
}

}  // namespace

std::optional<Identity> received_identity(Bytes head, std::size_t submessage) {
  if (submessage < kPacketHeader || head.size() < kDataHeader ||
      submessage > head.size() - kDataHeader || std::memcmp(head.data(), "RTPS", 4) != 0)
    return std::nullopt;
  const unsigned char kind = head[submessage], flags = head[submessage + 1];
  if (kind != kDataMessage && kind != kDataFrag) return std::nullopt;
  const Reader reader(head, (flags & kLittleEndian) != 0);
  std::optional<Identity> identity;
  if ((flags & kHasInlineQos) != 0)
    identity = find_parameter(head, reader, submessage + 8 + reader.u16(submessage + 6));
  if (identity && identity->number > 0) return identity;
  const bool from_fast_dds = head[6] == 0x01 && head[7] == 0x0f;
  if (!identity) {
    if (!from_fast_dds) return std::nullopt;
    identity.emplace();
    const auto rest = std::copy_n(head.begin() + 8, kGuidPrefix, identity->guid.begin());
    std::copy_n(head.begin() + static_cast<std::ptrdiff_t>(submessage) + 12, 4, rest);
  }
  identity->number = reader.sequence(submessage + 16);
  return identity;
}

std::array<unsigned char, kMarkedHeader> marked_header(const Identity& identity) {
  std::array<unsigned char, kMarkedHeader> header{0xfa, 'F', 'a', 's', 't', 'D', 'D', 'S'};
  const auto end = std::copy(identity.guid.begin(), identity.guid.end(), header.begin() + 8);
  for (int i = 0; i < 8; ++i)
    end[i] = static_cast<unsigned char>(static_cast<std::uint64_t>(identity.number) >> 8 * i);
  return header;
}

std::array<unsigned char, kInlineQos> inline_qos(const Identity& identity) {
  std::array<unsigned char, kInlineQos> made{};
  unsigned char* to = made.data();
  const auto put = [&to](const auto& value) {
    std::memcpy(to, &value, sizeof value);
    to += sizeof value;
  };
  const auto number = static_cast<std::uint64_t>(identity.number);
  for (const std::uint16_t name : {kRelatedIdentity, kFormerRelatedIdentity}) {
    put(name);
    put(static_cast<std::uint16_t>(kIdentitySize));
    put(identity.guid);
    put(static_cast<std::uint32_t>(number >> 32));
    put(static_cast<std::uint32_t>(number));
  }
  put(kSentinel);
  put(std::uint16_t{0});
  return made;
}

}  // namespace turtlewire::cyclone
