#include "origins.hpp"

#include <algorithm>

namespace turtlewire::zenoh {
namespace {

// Offsets; the length of the gid stands in one byte before it.
struct Layout {
  std::size_t size, number, sent, gid;
};
// The second one wrote the name of each value in front of it (rmw_zenoh_cpp 0.2.0 to 0.2.3).
constexpr Layout kLayouts[] = {{33, 0, 8, 17}, {77, 16, 41, 61}};

std::int64_t little_endian(const unsigned char* bytes) {
  std::uint64_t value = 0;
  for (int i = 7; i >= 0; --i) value = value << 8 | bytes[i];
  return static_cast<std::int64_t>(value);
}

std::uint64_t first_half(const char* gid) {
  return static_cast<std::uint64_t>(little_endian(reinterpret_cast<const unsigned char*>(gid)));
}

}  // namespace

std::optional<Attachment> Attachment::read(std::span<const unsigned char> bytes) {
  for (const Layout& layout : kLayouts) {
    Attachment read{};
    if (bytes.size() != layout.size || bytes[layout.gid - 1] != read.gid.size()) continue;
    read.number = little_endian(&bytes[layout.number]);
    read.sent = little_endian(&bytes[layout.sent]);
    std::copy_n(&bytes[layout.gid], read.gid.size(), read.gid.begin());
    return read;
  }
  return std::nullopt;
}

std::uint64_t Origins::publisher_of(const Attachment& attachment) {
  return static_cast<std::uint64_t>(little_endian(attachment.gid.data()));
}

std::uint64_t Origins::count_missing(const Attachment& attachment) {
  const std::scoped_lock lock(mutex_);
  const std::uint64_t number = publisher_of(attachment);
  if (publishers_.size() >= kMostPublishers && !publishers_.contains(number)) publishers_.clear();
  Publisher& publisher = publishers_[number];
  publisher.gid.assign(attachment.gid.begin(), attachment.gid.end());
  const std::optional<std::int64_t> last = publisher.last_number;
  publisher.last_number = attachment.number;
  if (!last || attachment.number <= *last) return 0;
  // Unsigned, because numbers from the network may be as far apart as they like.
  return static_cast<std::uint64_t>(attachment.number) - static_cast<std::uint64_t>(*last) - 1;
}

void Origins::forget(std::string_view gid) {
  const std::scoped_lock lock(mutex_);
  if (gid.size() != sizeof(Attachment::gid)) return;
  const auto known = publishers_.find(first_half(gid.data()));
  if (known != publishers_.end()) known->second.last_number.reset();
}

std::string Origins::gid_of(std::uint64_t publisher) {
  const std::scoped_lock lock(mutex_);
  const auto known = publishers_.find(publisher);
  return known == publishers_.end() ? std::string() : known->second.gid;
}

}  // namespace turtlewire::zenoh
