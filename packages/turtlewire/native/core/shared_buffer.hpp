// A buffer for many threads: one lock, held briefly, and never while a message is formatted or a
// callback runs. Lookups along a path that is known share it where they run at the same time.
#pragma once

#include <algorithm>
#include <mutex>
#include <shared_mutex>
#include <span>
#include <string_view>
#include <thread>
#include <vector>

#include "fork.hpp"
#include "shared_lock.hpp"
#include "tree.hpp"

namespace turtlewire {

// A serialized transform, in the bytes of a message.
struct ReceivedTransform {
  Stamp stamp;
  std::string_view parent, child;
  const unsigned char* numbers;  // the seven of its pose, as doubles
  bool swapped;                  // the numbers have the other byte order

  Pose pose() const;
};

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
  Stamp t = kLatest;
  Stamp beyond = 0;  // how far motion is extrapolated outside of a link's data; never in tf2
};
struct FullRequest {
  std::string_view target;
  Stamp target_time = kLatest;
  std::string_view source;
  Stamp source_time = kLatest;
  std::string_view fixed;
  Stamp beyond = 0;
};

struct Found {
  Stamp stamp = kLatest;
  Pose target_from_source;
};

struct Added {
  long accepted = 0;         // transforms that were stored
  bool listened_to = false;  // a listener must be called
  bool lacks_room = false;   // a frame was refused because of max_frames
  bool new_refusal = false;  // a frame was refused for another reason, for the first time
};

// Each method takes the lock for itself; Access and View are for several steps at once.
class SharedBuffer final : public ForkAware {
 public:
  explicit SharedBuffer(Stamp keep, std::size_t max_frames = 0) : tree_(keep, max_frames) {}

  // The tree, locked for as long as this lives.
  class Access {
   public:
    explicit Access(SharedBuffer& shared) : shared_(shared), lock_(shared.mutex_) {}

    Tree* operator->() const { return &shared_.tree_; }
    Tree& operator*() const { return shared_.tree_; }

    // To be called after data came in.
    void wake_waiters() const noexcept { shared_.wake_waiters(); }
    // The number of listeners that the adding thread must call.
    void set_listeners(std::size_t count) const { shared_.listeners_ = count; }

   private:
    SharedBuffer& shared_;
    const std::scoped_lock<SharedLock> lock_;
  };

  // The tree for as long as this lives, while other threads may read it as well.
  class View {
   public:
    explicit View(SharedBuffer& shared) : tree_(shared.tree_), lock_(shared.mutex_) {}

    const Tree* operator->() const { return &tree_; }
    const Tree& operator*() const { return tree_; }

   private:
    const Tree& tree_;
    const std::shared_lock<SharedLock> lock_;
  };

  Stamp keep() const { return tree_.keep(); }

  // Adds the transforms of one message and wakes the waiting threads.
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

  void before_fork() override { mutex_.lock(); }
  // The child has none of the other threads.
  void after_fork(bool is_child) noexcept override {
    if (is_child) std::erase_if(waiters_, [](const Waiter* waiter) { return !waiter->is_mine(); });
    mutex_.unlock();
  }

 private:
  friend class Waiting;

  void wake_waiters() noexcept {
    for (Waiter* waiter : waiters_) waiter->wake();
  }
  Status resolve(std::string_view name, Argument argument, FrameId& id, Failure& failure) const;
  bool find_known(const Request& request, Found& found);
  Status find(const Request& request, Found& found, Failure& failure);
  Status find(FrameId target, FrameId source, Stamp beyond, Found& found, Failure& failure);
  Status test(const Request& request, Failure& failure);

  SharedLock mutex_;  // guards the three below
  Tree tree_;
  std::vector<Waiter*> waiters_;
  std::size_t listeners_ = 0;
  const ForkRegistration registration_{*this, Order::inner};
};

// Registers a waiter for the lifetime of this object.
class Waiting {
 public:
  Waiting(SharedBuffer& shared, Waiter& waiter) : shared_(shared), waiter_(&waiter) {
    const std::scoped_lock lock(shared_.mutex_);
    shared_.waiters_.push_back(waiter_);
  }
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;
  ~Waiting() {
    const std::scoped_lock lock(shared_.mutex_);
    std::erase(shared_.waiters_, waiter_);
  }

 private:
  SharedBuffer& shared_;
  Waiter* waiter_;
};

}  // namespace turtlewire
