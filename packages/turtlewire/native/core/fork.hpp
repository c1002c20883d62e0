// Handles locks when a program calls fork().
#pragma once

namespace turtlewire {

// An object with a lock. fork() copies only the thread that calls it: a lock that another thread
// holds at that moment would stay locked in the child forever, and what it guards half changed. So
// fork() waits for all these locks first.
class ForkAware {
 public:
  // The order in which a thread acquires several locks.
  enum class Order { outer, inner };

  virtual void before_fork() = 0;                       // takes the lock
  virtual void after_fork(bool is_child) noexcept = 0;  // releases it

 protected:
  ~ForkAware() = default;
};

// Registers an object's functions with fork() for its own lifetime. Make it the last member, so
// that it is destroyed before the lock.
class ForkRegistration {
 public:
  ForkRegistration(ForkAware& object, ForkAware::Order order);
  ForkRegistration(const ForkRegistration&) = delete;
  ForkRegistration& operator=(const ForkRegistration&) = delete;
  ~ForkRegistration();

 private:
  ForkAware& object_;
  ForkAware::Order order_;
};

}  // namespace turtlewire
