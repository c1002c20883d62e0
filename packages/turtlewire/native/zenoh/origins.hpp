// Who sent a message through Zenoh: what stands in the attachment beside it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>

namespace turtlewire::zenoh {

// As turtlewire/wire/zenoh/protocol.py, which says what the members mean.
struct Attachment {
  std::int64_t number;
  std::int64_t sent;
  std::array<unsigned char, 16> gid;

  // Of either layout; nothing if the bytes match neither.
  static std::optional<Attachment> read(std::span<const unsigned char> bytes);
};

// The publishers of a subscription, by the first half of their gids, which is as good as random.
// Thread-safe.
class Origins {
 public:
  static std::uint64_t publisher_of(const Attachment& attachment);

  // How many messages of this publisher are missing before this one.
  std::uint64_t count_missing(const Attachment& attachment);
  // The publisher has gone: if it comes again, nothing is missing.
  void forget(std::string_view gid);
  // Empty if no message of the publisher came.
  std::string gid_of(std::uint64_t publisher);

 private:
  // Publishers come and go: beyond this many, all are forgotten.
  static constexpr std::size_t kMostPublishers = 1000;
  struct Publisher {
    std::string gid;
    std::optional<std::int64_t> last_number;
  };

  std::mutex mutex_;
  std::unordered_map<std::uint64_t, Publisher> publishers_;
};

}  // namespace turtlewire::zenoh
