// Fills buffers with messages on any receiving thread, and keeps back those that need more
// than that.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "../core/shared_buffer.hpp"
#include "backlog.hpp"
#include "tf_message.hpp"

namespace turtlewire {

// Ends a wait of a program's own thread, by triggering a guard condition of the middleware.
struct Waker {
  std::int32_t (*trigger)(std::int32_t guard, bool triggered);
  std::int32_t guard;

  void wake() const { trigger(guard, true); }
};

// A reader thread handles what needs Python: messages of publishers without a name, and malformed
// ones. The order of all messages is kept: until the reader thread has found nothing left to take,
// further messages are kept back as well.
class Intake final : public ForkAware {
 public:
  // At most `most_kept` messages are kept back, the newest ones; 0: any number.
  Intake(bool is_static, std::size_t most_kept) : is_static_(is_static), backlog_(most_kept) {}

  // Stores a message, or keeps it back. True if the reader thread is to be woken, which was not
  // told to come before.
  bool receive(std::uint64_t publisher, Stamp sent, std::span<const unsigned char> bytes);

  // Which buffers to fill from now on, when this returns no other ones; without any, everything is
  // kept back.
  void feed(std::vector<SharedBuffer*> buffers);
  // Whether a message of this publisher waits for its introduction.
  bool needs_name(std::uint64_t publisher);
  // Which publisher the middleware means by a number, and what it is called. A name that name() has
  // told meanwhile is newer, and counts.
  void introduce(std::uint64_t publisher, std::string_view gid, std::string_view name);
  void name(std::string_view gid, std::string_view name);

  // For the reader thread, which repeats it until there is nothing: the next messages kept back
  // that need Python. Those before them that do not need it any more are stored. `former` is what
  // the last call returned, if an introduction may have changed the need.
  std::deque<WaitingMessage> take(std::deque<WaitingMessage> former = {});
  // Whether a buffer with change listeners has received data since the last time.
  bool take_news();

  void before_fork() override { mutex_.lock(); }
  void after_fork(bool) noexcept override { mutex_.unlock(); }

  // How many messages were stored so far.
  std::uint64_t stored();
  // The next message that is stored wakes the reader thread.
  void expect();
  // The next message that is stored wakes another thread, once, and not the reader thread. Returns
  // how many were stored so far.
  std::uint64_t expect(Waker waker);
  // Whether an expected message came since the last time, or one of which a buffer refused a frame:
  // each frame is told of once for each reason, and a lack of room once in kRoomPeriod.
  bool take_expected();

 private:
  static constexpr std::chrono::seconds kRoomPeriod{1};
  static constexpr std::size_t kMostPublishers =
      1000;  // they come and go; beyond it, all are introduced again
  struct Publisher {
    std::string gid, name;
  };

  const std::string* name_of(std::uint64_t publisher) const;
  bool store(std::uint64_t publisher, std::span<const unsigned char> bytes);
  std::vector<Waker> take_wakers(std::uint64_t stored_before);
  bool may_tell_of_room();

  const bool is_static_;
  std::mutex mutex_;  // guards all that follows
  std::vector<SharedBuffer*> buffers_;
  std::unordered_map<std::uint64_t, Publisher> publishers_;
  std::unordered_map<std::string, std::string> early_names_;  // by gid, of publishers to come
  TfMessage message_;
  Backlog backlog_;
  bool news_ = false;
  std::uint64_t stored_ = 0;  // messages, without those that were kept back permanently
  bool expecting_ = false;    // the next message is expected
  bool expected_came_ = false;
  std::vector<Waker> wakers_;  // of threads that expect the next message
  std::chrono::steady_clock::time_point next_told_of_room_{};
  const ForkRegistration registration_{*this, Order::outer};
};

}  // namespace turtlewire
