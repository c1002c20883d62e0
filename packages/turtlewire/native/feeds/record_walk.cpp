#include "record_walk.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace turtlewire {
namespace {

constexpr unsigned char kMessageOpcode = 5;
constexpr std::size_t kPrefix = 1 + 8;              // opcode, length
constexpr std::size_t kMessageFields = 2 + 4 + 16;  // channel, sequence, log and publish time
constexpr std::size_t kMessagesPerLock = 512;
// Stamps that fall back by more are a jump of time, not messages out of order.
constexpr Stamp kJump = 1'000'000'000;

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

}  // namespace

struct RecordWalk::Record {
  unsigned char opcode = 0;
  std::uint16_t channel = 0;
  std::uint64_t log_time = 0;
  std::span<const unsigned char> data;  // of a message
  std::size_t end = 0;
};

// False if the record at `at` does not fit into the bytes.
bool RecordWalk::read(Record& record, std::span<const unsigned char> records,
                      std::size_t at) const {
  const std::size_t rest = records.size() - at;
  if (rest < kPrefix) return false;
  const unsigned char* p = records.data() + at;
  const auto length = little<std::uint64_t>(p + 1);
  if (length > rest - kPrefix) return false;
  record.opcode = *p;
  record.end = at + kPrefix + static_cast<std::size_t>(length);
  if (record.opcode != kMessageOpcode) return true;
  if (length < kMessageFields) return false;
  record.channel = little<std::uint16_t>(p + kPrefix);
  record.log_time = little<std::uint64_t>(p + kPrefix + 6);
  record.data = {p + kPrefix + kMessageFields, static_cast<std::size_t>(length) - kMessageFields};
  return true;
}

std::size_t RecordWalk::walk(SharedBuffer& buffer, std::span<const unsigned char> records,
                             std::span<const TfChannel> channels) {
  std::vector<SourceId> senders(channels.size());
  std::size_t at = 0;
  while (at < records.size()) {
    const SharedBuffer::Access access(buffer);
    for (std::size_t i = 0; i < channels.size(); ++i)
      senders[i] = access->sender(channels[i].authority);
    Record record;
    for (std::size_t n = 0; n < kMessagesPerLock && at < records.size(); ++n, at = record.end) {
      if (!read(record, records, at)) {
        access.wake_waiters();
        return at;
      }
      if (record.opcode != kMessageOpcode || record.log_time < first_ || record.log_time > last_)
        continue;
      const auto channel = std::ranges::find(channels, record.channel, &TfChannel::id);
      if (channel == channels.end()) continue;
      take(*access, record, *channel,
           senders[static_cast<std::size_t>(channel - channels.begin())]);
    }
    access.wake_waiters();
  }
  return kNoDamage;
}

void RecordWalk::take(Tree& tree, const Record& record, const TfChannel& channel, SourceId sender) {
  ++messages_;
  const std::string fault = message_.decode(record.data.data(), record.data.size());
  if (!fault.empty()) {
    tree.refuse_message(fault, sender);
    return;
  }
  for (const ReceivedTransform& r : message_.transforms())
    tree.set(r.parent, r.child, r.stamp, r.pose(), sender, channel.is_static);
  if (!channel.is_static && !message_.transforms().empty())
    note_stamp(record.log_time, message_.transforms().front());
}

void RecordWalk::note_stamp(std::uint64_t log_time, const ReceivedTransform& first) {
  auto known = clocks_.find(first.child);
  if (known == clocks_.end()) {
    clocks_.emplace(first.child, Clock{first.stamp, 0, 0});
    return;
  }
  Clock& clock = known->second;
  const Stamp back = clock.newest - first.stamp;
  if (back > 0) ++clock.steps_back;
  clock.back = std::max(clock.back, back);
  if (back > kJump) {
    jumps_.push_back({log_time, std::string(first.child), back});
    clock.newest = first.stamp;
  } else {
    clock.newest = std::max(clock.newest, first.stamp);
  }
}

}  // namespace turtlewire
