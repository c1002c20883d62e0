// Walks the records of an MCAP chunk and adds the TFMessages among them to a buffer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "../core/shared_buffer.hpp"
#include "bag_records.hpp"
#include "tf_message.hpp"

namespace turtlewire {

// A channel of the file whose messages are TFMessages.
struct TfChannel {
  std::uint16_t id;
  std::string authority;
  bool is_static;
};

// Stamps of a frame that fall back, in the order of the file.
struct JumpBack {
  std::uint64_t log_time;
  std::string child;
  Stamp by;
};

// What was found so far; one walk serves all chunks of a bag.
class RecordWalk {
 public:
  RecordWalk(std::uint64_t first_log_time, std::uint64_t last_log_time)
      : first_(first_log_time), last_(last_log_time) {}

  static constexpr std::size_t kNoDamage = SIZE_MAX;

  // Adds the messages of the channels whose log time lies in the window. Returns where the first
  // record begins that does not fit into the bytes; what lies before it was added. Never reads past
  // the bytes. Takes the buffer's lock for some hundred messages at a time.
  std::size_t walk(SharedBuffer& buffer, std::span<const unsigned char> records,
                   std::span<const TfChannel> channels);

  std::uint64_t messages() const { return messages_; }
  const std::vector<JumpBack>& jumps() const { return jumps_; }

  // The newest stamp of a frame since its last jump, how many stamps lie before it, and how far the
  // largest step back goes.
  struct Clock {
    Stamp newest, back;
    std::uint64_t steps_back;
  };
  // Of each frame that was the first of a message.
  const auto& clocks() const { return clocks_; }

 private:
  struct Hash : std::hash<std::string_view> {
    using is_transparent = void;
  };

  void take(Tree& tree, const BagRecord& record, const TfChannel& channel, SourceId sender);
  void note_stamp(std::uint64_t log_time, const ReceivedTransform& first);

  std::uint64_t first_, last_;
  std::uint64_t messages_ = 0;
  std::vector<JumpBack> jumps_;
  std::unordered_map<std::string, Clock, Hash, std::equal_to<>> clocks_;
  TfMessage message_;
};

}  // namespace turtlewire
