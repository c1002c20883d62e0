#include "intake.hpp"

#include <algorithm>
#include <utility>

namespace turtlewire {

bool Intake::receive(std::uint64_t publisher, Stamp sent, std::span<const unsigned char> bytes) {
  bool needs_python = false;
  std::vector<Waker> wakers;
  {
    const std::scoped_lock lock(mutex_);
    const std::uint64_t before = stored_;
    if (backlog_.must_wait() || !store(publisher, bytes)) backlog_.add(publisher, sent, bytes);
    needs_python = (news_ || expected_came_ || !backlog_.empty()) && backlog_.call_python();
    wakers = take_wakers(before);
  }
  for (const Waker& waker : wakers) waker.wake();
  return needs_python;
}

// Call with the lock held, and wake them without it. None if no message was stored since.
std::vector<Waker> Intake::take_wakers(std::uint64_t stored_before) {
  return stored_ == stored_before ? std::vector<Waker>{} : std::exchange(wakers_, {});
}

// Call with the lock held. Null if the publisher was not introduced, or has no name.
const std::string* Intake::name_of(std::uint64_t publisher) const {
  const auto known = publishers_.find(publisher);
  return known == publishers_.end() || known->second.name.empty() ? nullptr : &known->second.name;
}

// Call with the lock held. False if the message is none for the short way.
bool Intake::store(std::uint64_t publisher, std::span<const unsigned char> bytes) {
  const std::string* name = name_of(publisher);
  if (buffers_.empty() || name == nullptr) return false;
  if (bytes.size() < 2 || bytes[1] != 1 || !message_.decode(bytes.data(), bytes.size()).empty())
    return false;
  for (SharedBuffer* buffer : buffers_) {
    const Added added = buffer->add(message_.transforms(), *name, is_static_);
    news_ = news_ || (added.accepted > 0 && added.listened_to);
    if (added.lacks_room) expected_came_ = may_tell_of_room() || expected_came_;
    expected_came_ = added.new_refusal || expected_came_;
  }
  ++stored_;
  expected_came_ = std::exchange(expecting_, false) || expected_came_;
  return true;
}

// Call with the lock held. Whether to tell that a frame was refused: a flood of them must not keep
// the reader thread busy.
bool Intake::may_tell_of_room() {
  const auto now = std::chrono::steady_clock::now();
  if (now < next_told_of_room_) return false;
  next_told_of_room_ = now + kRoomPeriod;
  return true;
}

void Intake::feed(std::vector<SharedBuffer*> buffers) {
  const std::scoped_lock lock(mutex_);
  buffers_.swap(buffers);
}

bool Intake::needs_name(std::uint64_t publisher) {
  const std::scoped_lock lock(mutex_);
  return !buffers_.empty() && name_of(publisher) == nullptr;
}

void Intake::introduce(std::uint64_t publisher, std::string_view gid, std::string_view name) {
  const std::scoped_lock lock(mutex_);
  if (publishers_.size() >= kMostPublishers) publishers_.clear();
  Publisher& known = publishers_[publisher];
  known = {std::string(gid), std::string(name)};
  if (auto early = early_names_.extract(known.gid)) known.name = std::move(early.mapped());
}

void Intake::name(std::string_view gid, std::string_view name) {
  const std::scoped_lock lock(mutex_);
  bool found = false;
  for (auto& [number, publisher] : publishers_) {
    if (publisher.gid != gid) continue;
    publisher.name = name;
    found = true;
  }
  if (found) return;
  if (early_names_.size() >= kMostPublishers) early_names_.clear();
  early_names_.insert_or_assign(std::string(gid), std::string(name));
}

std::deque<WaitingMessage> Intake::take(std::deque<WaitingMessage> former) {
  std::deque<WaitingMessage> taken;
  std::vector<Waker> wakers;
  {
    const std::scoped_lock lock(mutex_);
    const std::uint64_t before = stored_;
    backlog_.python_came();
    backlog_.put_back(std::move(former));
    while (!backlog_.empty() && store(backlog_.front().publisher, backlog_.front().bytes))
      backlog_.take_front();
    while (!backlog_.empty() &&
           (taken.empty() || buffers_.empty() || name_of(backlog_.front().publisher) == nullptr)) {
      taken.push_back(backlog_.take_front());
    }
    backlog_.python_is_busy(!taken.empty());
    wakers = take_wakers(before);
  }
  for (const Waker& waker : wakers) waker.wake();
  return taken;
}

bool Intake::take_news() {
  const std::scoped_lock lock(mutex_);
  backlog_.python_came();
  return std::exchange(news_, false);
}

std::uint64_t Intake::stored() {
  const std::scoped_lock lock(mutex_);
  return stored_;
}

void Intake::expect() {
  const std::scoped_lock lock(mutex_);
  expecting_ = true;
}

std::uint64_t Intake::expect(Waker waker) {
  const std::scoped_lock lock(mutex_);
  const auto is_known = [&](const Waker& known) { return known.guard == waker.guard; };
  if (std::ranges::none_of(wakers_, is_known)) wakers_.push_back(waker);
  return stored_;
}

bool Intake::take_expected() {
  const std::scoped_lock lock(mutex_);
  backlog_.python_came();
  return std::exchange(expected_came_, false);
}

}  // namespace turtlewire
