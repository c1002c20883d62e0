#include "record_walk.hpp"

#include <algorithm>

namespace turtlewire {
namespace {

constexpr std::size_t kMessagesPerLock = 512;
// Stamps that fall back by more are a jump of time, not messages out of order.
constexpr Stamp kJump = 1'000'000'000;

}  // namespace

std::size_t RecordWalk::walk(SharedBuffer& buffer, std::span<const unsigned char> records,
                             std::span<const TfChannel> channels) {
  std::vector<SourceId> senders(channels.size());
  std::size_t at = 0;
  while (at < records.size()) {
    const SharedBuffer::Access access(buffer);
    for (std::size_t i = 0; i < channels.size(); ++i)
      senders[i] = access->sender(channels[i].authority);
    BagRecord record;
    for (std::size_t n = 0; n < kMessagesPerLock && at < records.size(); ++n, at = record.end) {
      if (!read_mcap_record(record, records, at)) {
        access.wake_waiters();
        return at;
      }
      if (!record.is_message || record.log_time < first_ || record.log_time > last_) continue;
      const auto channel = std::ranges::find(channels, record.channel, &TfChannel::id);
      if (channel == channels.end()) continue;
      take(*access, record, *channel,
           senders[static_cast<std::size_t>(channel - channels.begin())]);
    }
    access.wake_waiters();
  }
  return kNoDamage;
}

void RecordWalk::take(Tree& tree, const BagRecord& record, const TfChannel& channel,
                      SourceId sender) {
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
