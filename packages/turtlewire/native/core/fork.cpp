#include "fork.hpp"

#include <array>
#include <cstddef>
#include <mutex>
#include <unordered_set>

#if !defined(_WIN32)
#include <pthread.h>
#endif

namespace turtlewire {
namespace {

class Registry {
 public:
  void add(ForkAware& object, ForkAware::Order order) {
    const std::scoped_lock lock(mutex_);
    objects(order).insert(&object);
  }
  void remove(ForkAware& object, ForkAware::Order order) {
    const std::scoped_lock lock(mutex_);
    objects(order).erase(&object);
  }

  void before() {
    mutex_.lock();
    for (const auto& some : objects_) {
      for (ForkAware* object : some) object->before_fork();
    }
  }
  void after(bool is_child) noexcept {
    for (const auto& some : objects_) {
      for (ForkAware* object : some) object->after_fork(is_child);
    }
    mutex_.unlock();
  }

 private:
  std::unordered_set<ForkAware*>& objects(ForkAware::Order order) {
    return objects_[static_cast<std::size_t>(order)];
  }

  std::mutex mutex_;
  std::array<std::unordered_set<ForkAware*>, 2> objects_;  // by order
};

// Never destroyed: daemon threads may still make and drop buffers while the process exits.
Registry& registry() {
  static Registry* const made = [] {
    auto* registry = new Registry;
#if !defined(_WIN32)
    static Registry* known;  // the handlers take no argument
    known = registry;
    pthread_atfork([] { known->before(); }, [] { known->after(false); },
                   [] { known->after(true); });
#endif
    return registry;
  }();
  return *made;
}

}  // namespace

ForkRegistration::ForkRegistration(ForkAware& object, ForkAware::Order order)
    : object_(object), order_(order) {
  registry().add(object_, order_);
}

ForkRegistration::~ForkRegistration() { registry().remove(object_, order_); }

}  // namespace turtlewire
