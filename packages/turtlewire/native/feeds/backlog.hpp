// Messages that wait for Python, in the order in which they came.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <utility>
#include <vector>

namespace turtlewire {

struct WaitingMessage {
  std::uint64_t publisher;
  std::int64_t sent;  // nanoseconds
  std::vector<unsigned char> bytes;
};

// Its owner holds a lock. While messages wait, or Python handles what it took, further ones must
// wait as well: that keeps the order of all.
class Backlog {
 public:
  // At most `most` messages wait, the newest ones; 0: any number.
  explicit Backlog(std::size_t most) : most_(most) {}

  bool empty() const { return messages_.empty(); }
  bool must_wait() const { return python_is_busy_ || !messages_.empty(); }

  void add(std::uint64_t publisher, std::int64_t sent, std::span<const unsigned char> bytes) {
    if (most_ != 0 && messages_.size() >= most_) messages_.pop_front();
    messages_.push_back({publisher, sent, {bytes.begin(), bytes.end()}});
  }
  const WaitingMessage& front() const { return messages_.front(); }
  WaitingMessage take_front() {
    WaitingMessage message = std::move(messages_.front());
    messages_.pop_front();
    return message;
  }
  // Puts messages that were taken back to where they were.
  void put_back(std::deque<WaitingMessage> taken) {
    for (; !taken.empty(); taken.pop_back()) messages_.push_front(std::move(taken.back()));
  }

  void python_is_busy(bool busy) { python_is_busy_ = busy; }
  // Whether Python is to be woken: it was not told to come before.
  bool call_python() { return !std::exchange(called_, true); }
  void python_came() { called_ = false; }

 private:
  const std::size_t most_;
  std::deque<WaitingMessage> messages_;
  bool python_is_busy_ = false;
  bool called_ = false;
};

}  // namespace turtlewire
