#include "intake.hpp"

#include <utility>

namespace turtlewire {

bool Intake::receive(std::uint64_t publisher, Stamp sent, std::span<const unsigned char> bytes) {
  const std::scoped_lock lock(mutex_);
  if (!store(publisher, bytes)) {
    if (most_kept_ != 0 && kept_.size() == most_kept_) kept_.pop_front();
    kept_.push_back({publisher, sent, {bytes.begin(), bytes.end()}});
  }
  return (news_ || !kept_.empty()) && !std::exchange(called_, true);
}

// Call with the lock held. False if the message is none for the short way.
bool Intake::store(std::uint64_t publisher, std::span<const unsigned char> bytes) {
  if (taken_care_of_ || !kept_.empty() || buffers_.empty()) return false;
  const auto known = publishers_.find(publisher);
  if (known == publishers_.end() || known->second.name.empty()) return false;
  if (bytes.size() < 2 || bytes[1] != 1 || !message_.decode(bytes.data(), bytes.size()).empty()) return false;
  for (SharedBuffer* buffer : buffers_) {
    const Added added = buffer->add(message_.transforms(), known->second.name, is_static_);
    news_ = news_ || (added.accepted > 0 && added.listened_to);
  }
  return true;
}

void Intake::feed(std::vector<SharedBuffer*> buffers) {
  const std::scoped_lock lock(mutex_);
  buffers_.swap(buffers);
}

void Intake::introduce(std::uint64_t publisher, std::string_view gid) {
  const std::scoped_lock lock(mutex_);
  if (publishers_.size() >= kMostPublishers) publishers_.clear();
  publishers_.try_emplace(publisher, Publisher{std::string(gid), {}});
}

void Intake::name(std::string_view gid, std::string_view name) {
  const std::scoped_lock lock(mutex_);
  for (auto& [number, publisher] : publishers_) {
    if (publisher.gid == gid) publisher.name = name;
  }
}

std::deque<Intake::Kept> Intake::take() {
  const std::scoped_lock lock(mutex_);
  called_ = false;
  taken_care_of_ = !kept_.empty();
  return std::exchange(kept_, {});
}

bool Intake::take_news() {
  const std::scoped_lock lock(mutex_);
  called_ = false;
  return std::exchange(news_, false);
}

}  // namespace turtlewire
