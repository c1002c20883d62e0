// A buffer for many threads: one lock, held for short and never while words are made or others are
// called.
#pragma once

#include <algorithm>
#include <mutex>
#include <span>
#include <string_view>
#include <thread>
#include <vector>

#include "buffer.hpp"
#include "fork.hpp"
#include "tf_message.hpp"

namespace turtlewire {

// A thread that sleeps until the data changes. `wake` must neither block nor throw.
class Waiter {
 public:
  virtual void wake() noexcept = 0;
  bool is_mine() const { return thread_ == std::this_thread::get_id(); }

 protected:
  ~Waiter() = default;

 private:
  const std::thread::id thread_ = std::this_thread::get_id();
};

// The questions of tf2, by name. A lookup "through" a fixed frame has two times.
struct Request {
  std::string_view target, source;
  Stamp t = 0;
};
struct FullRequest {
  std::string_view target;
  Stamp target_time = 0;
  std::string_view source;
  Stamp source_time = 0;
  std::string_view fixed;
};

struct Found {
  Stamp stamp = 0;
  Pose target_from_source;
};

struct Added {
  long accepted = 0;         // so many transforms
  bool listened_to = false;  // somebody is to be told of it
};

// Each method takes the lock for itself; those who do several things at once use `mutex` and
// `buffer` themselves.
class SharedBuffer final : public ForkAware {
 public:
  explicit SharedBuffer(Stamp keep) : buffer(keep) {}

  std::mutex mutex;  // guards the three below
  Buffer buffer;
  std::vector<Waiter*> waiters;
  std::size_t listeners = 0;  // how many want to be told of new data, by whoever adds it

  // Call with the lock held, after data came in.
  void wake_waiters() noexcept {
    for (Waiter* waiter : waiters) waiter->wake();
  }

  // Adds the transforms of one message and wakes who waits.
  Added add(std::span<const ReceivedTransform> transforms, std::string_view authority,
            bool is_static);

  Status lookup(const Request& request, Found& found, Failure& failure);
  Status lookup(const FullRequest& request, Found& found, Failure& failure);
  Status can_transform(const Request& request, Failure& failure);
  Status can_transform(const FullRequest& request, Failure& failure);
  Status latest_common_time(std::string_view target, std::string_view source, Stamp& t,
                            Failure& failure);

  // Whether more data can turn the failure into an answer: not for a bad name, nor for a time that
  // has left the cache.
  bool worth_waiting(const Failure& failure) const;

  void before_fork() override { mutex.lock(); }
  // The child has none of the other threads.
  void after_fork(bool is_child) noexcept override {
    if (is_child) std::erase_if(waiters, [](const Waiter* waiter) { return !waiter->is_mine(); });
    mutex.unlock();
  }

 private:
  Status resolve(std::string_view name, Argument argument, FrameId& id, Failure& failure) const;
  Status find(const Request& request, Found& found, Failure& failure);
  Status test(const Request& request, Failure& failure);

  const ForkRegistration registration_{*this, Order::inner};
};

// Makes a waiter known for as long as this lives.
class Waiting {
 public:
  Waiting(SharedBuffer& shared, Waiter& waiter) : shared_(shared), waiter_(&waiter) {
    const std::scoped_lock lock(shared_.mutex);
    shared_.waiters.push_back(waiter_);
  }
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;
  ~Waiting() {
    const std::scoped_lock lock(shared_.mutex);
    std::erase(shared_.waiters, waiter_);
  }

 private:
  SharedBuffer& shared_;
  Waiter* waiter_;
};

}  // namespace turtlewire
