#include "buffer.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>

#include "errors.hpp"

namespace turtlewire::python {
namespace {

// Python's own lock, as threading.Lock is: the only portable way to sleep that a signal interrupts.
class Sleeper final : public Waiter {
 public:
  Sleeper() : lock_(PyThread_allocate_lock()) {
    if (lock_ != nullptr) PyThread_acquire_lock(lock_, WAIT_LOCK);
  }
  Sleeper(const Sleeper&) = delete;
  Sleeper& operator=(const Sleeper&) = delete;
  ~Sleeper() {
    if (lock_ == nullptr) return;
    PyThread_release_lock(lock_);
    PyThread_free_lock(lock_);
  }

  bool valid() const { return lock_ != nullptr; }

  void wake() noexcept override {
    if (!awake_.exchange(true)) PyThread_release_lock(lock_);
  }

  // Sleeps until woken or for `microseconds`; true if a signal may have come. Call without the GIL.
  bool sleep(std::int64_t microseconds) {
    const PyLockStatus status = PyThread_acquire_lock_timed(lock_, microseconds, 1);
    if (status == PY_LOCK_ACQUIRED) awake_ = false;
    return status == PY_LOCK_INTR;
  }

 private:
  PyThread_type_lock lock_;
  std::atomic<bool> awake_ = false;
};

enum class Waited : std::uint8_t { done, python_error };

// Repeats `attempt` whenever data comes in, until it returns true or the time is over; it runs
// without the GIL. `interrupts` counts the calls of Buffer.wake(): after one, and after a signal,
// Python's signal handlers run, and an exception that they raise ends the wait.
template <typename Attempt>
Waited wait_until(SharedBuffer& shared, const std::atomic<std::uint64_t>& interrupts,
                  std::int64_t timeout_ns, Attempt attempt) {
  using Clock = std::chrono::steady_clock;
  constexpr std::int64_t longest_sleep_us = 3'600'000'000;
  Sleeper sleeper;
  if (!sleeper.valid()) {
    PyErr_NoMemory();
    return Waited::python_error;
  }
  const auto start = Clock::now();
  const Waiting known(shared, sleeper);
  std::uint64_t seen = interrupts;
  for (;;) {
    bool over = false, signalled = false;
    {
      const Unlocked unlocked;
      while (!over && !signalled) {
        over = attempt();
        const std::int64_t left =
            timeout_ns - std::chrono::nanoseconds(Clock::now() - start).count();
        over = over || left <= 0;
        if (!over)
          signalled =
              sleeper.sleep(std::min((left + 999) / 1000, longest_sleep_us)) || interrupts != seen;
      }
    }
    if (over) return Waited::done;
    seen = interrupts;
    if (taking_gil(PyErr_CheckSignals) != 0) return Waited::python_error;
  }
}

Status ask(SharedBuffer& shared, const Request& request, Found* found, Failure& failure) {
  return found != nullptr ? shared.lookup(request, *found, failure)
                          : shared.can_transform(request, failure);
}

Status ask(SharedBuffer& shared, const FullRequest& request, Found* found, Failure& failure) {
  return found != nullptr ? shared.lookup(request, *found, failure)
                          : shared.can_transform(request, failure);
}

Stamp keep_of(nb::handle cache_time) {
  if (cache_time.is_none()) return kForever;
  const Stamp keep = nanoseconds_of(cache_time, "cache_time_ns");
  if (keep < 0) throw nb::value_error("cache_time_ns must not be negative");
  return keep;
}

std::size_t most_frames_of(nb::handle max_frames) {
  if (max_frames.is_none()) return 0;
  const long long most = taking_gil([max_frames] { return PyLong_AsLongLong(max_frames.ptr()); });
  if (most == -1 && PyErr_Occurred() != nullptr) {
    if (PyErr_ExceptionMatches(PyExc_TypeError) == 0) throw nb::python_error();
    PyErr_Clear();
    const nb::str text("max_frames must be an int or None, not {}");
    throw nb::type_error(text.format(max_frames.type().attr("__name__")).c_str());
  }
  if (most < 2) throw nb::value_error("max_frames must be at least 2");
  return static_cast<std::size_t>(most);
}

}  // namespace

BufferObject::BufferObject(nb::handle cache_time_ns, nb::handle max_frames)
    : shared(keep_of(cache_time_ns), most_frames_of(max_frames)) {}

BufferObject::~BufferObject() {
  for (const KnownPath& known : known_paths_) {
    Py_XDECREF(known.target);
    Py_XDECREF(known.source);
  }
}

BufferObject::KnownPath& BufferObject::place_of(PyObject* target, PyObject* source) {
  const auto a = reinterpret_cast<std::uintptr_t>(target) >> 4,
             b = reinterpret_cast<std::uintptr_t>(source) >> 4;
  return known_paths_[(a * 3 ^ b ^ b >> 8) % known_paths_.size()];
}

const Path* BufferObject::known_path(const Tree& tree, PyObject* target, PyObject* source) {
  const KnownPath& known = place_of(target, source);
  const bool is_known =
      known.target == target && known.source == source && known.epoch == tree.path_epoch();
  return is_known && tree.is_current(*known.path) ? known.path : nullptr;
}

void BufferObject::remember_path(PyObject* target, PyObject* source, std::string_view target_name,
                                 std::string_view source_name) {
  KnownPath old;
  {
    const SharedBuffer::Access access(shared);
    FrameId target_id = 0, source_id = 0;
    if (target_name == source_name || access->resolve(target_name, target_id) != Status::ok ||
        access->resolve(source_name, source_id) != Status::ok) {
      return;
    }
    const Path* path = &access->path(target_id, source_id);
    old = std::exchange(place_of(target, source),
                        {Py_NewRef(target), Py_NewRef(source), path, access->path_epoch()});
  }
  Py_XDECREF(old.target);
  Py_XDECREF(old.source);
}

// Looks up; after a failure, waits for data as long as new data can help. False if a Python error
// is set.
template <typename Request>
bool BufferObject::answer_or_wait(const Request& request, Stamp timeout, Failure& failure,
                                  Found* found) {
  if (python::ask(shared, request, found, failure) == Status::ok || timeout <= 0) return true;
  const auto attempt = [&] {
    failure = {};
    return python::ask(shared, request, found, failure) == Status::ok ||
           !shared.worth_waiting(failure);
  };
  return wait_until(shared, interrupts, timeout, attempt) == Waited::done;
}

bool BufferObject::answer(const Request& request, Stamp timeout, Failure& failure, Found* found) {
  return answer_or_wait(request, timeout, failure, found);
}

bool BufferObject::answer(const FullRequest& request, Stamp timeout, Failure& failure,
                          Found* found) {
  return answer_or_wait(request, timeout, failure, found);
}

bool BufferObject::raise_failure(const Failure& failure) {
  raise(failure, Question::lookup, nb::find(*this).ptr());
  return false;
}

bool BufferObject::lookup(PyObject* target, PyObject* source, Stamp t, Stamp timeout,
                          Found& found) {
  {
    const SharedBuffer::View tree(shared);
    const Path* path = known_path(*tree, target, source);
    found.stamp = t;
    if (path != nullptr && tree->lookup(*path, found.stamp, found.target_from_source, nullptr) ==
                               Status::ok) [[likely]] {
      return true;
    }
  }
  return lookup_by_name(target, source, t, timeout, found);
}

bool BufferObject::lookup_by_name(PyObject* target, PyObject* source, Stamp t, Stamp timeout,
                                  Found& found) {
  Request request{.t = t};
  if (!text_of(target, request.target, "target_frame") ||
      !text_of(source, request.source, "source_frame"))
    return false;
  Failure failure;
  if (!answer(request, timeout, failure, &found)) return false;
  if (failure.status == Status::ok) {
    remember_path(target, source, request.target, request.source);
    return true;
  }
  return raise_failure(failure);
}

bool BufferObject::certainly_can_transform(PyObject* target, PyObject* source, Stamp t) {
  const SharedBuffer::View tree(shared);
  const Path* path = known_path(*tree, target, source);
  return path != nullptr && tree->can_transform(*path, t, nullptr) == Status::ok;
}

bool BufferObject::can_transform(PyObject* target, PyObject* source, Stamp t, Stamp timeout,
                                 Failure& failure) {
  Request request{.t = t};
  if (!text_of(target, request.target, "target_frame") ||
      !text_of(source, request.source, "source_frame"))
    return false;
  if (!answer(request, timeout, failure, nullptr)) return false;
  if (failure.status == Status::ok) remember_path(target, source, request.target, request.source);
  return true;
}

Verdict BufferObject::set(std::string_view parent, std::string_view child, Stamp stamp,
                          const Pose& pose, std::string_view authority, bool is_static) {
  Verdict verdict;
  {
    const SharedBuffer::Access access(shared);
    verdict = access->set(parent, child, stamp, pose, access->sender(authority), is_static);
    if (verdict == Verdict::accepted) access.wake_waiters();
  }
  if (verdict == Verdict::accepted) call_listeners();
  return verdict;
}

void BufferObject::refuse_message(std::string_view fault, std::string_view authority) {
  const SharedBuffer::Access access(shared);
  access->refuse_message(fault, access->sender(authority));
}

void BufferObject::call_listeners() {
  if (listeners.size() == 0) return;
  for (const nb::handle listener : nb::tuple(listeners)) {
    taking_gil([listener] {
      PyObject* result = PyObject_CallNoArgs(listener.ptr());
      // The data is stored: an error of a listener is not the error of the caller that brought it.
      if (result == nullptr) PyErr_WriteUnraisable(listener.ptr());
      Py_XDECREF(result);
    });
  }
}

void BufferObject::listeners_changed() {
  const std::size_t count = listeners.size();
  const SharedBuffer::Access access(shared);
  access.set_listeners(count);
}

void BufferObject::wake() {
  const SharedBuffer::Access access(shared);
  ++interrupts;
  access.wake_waiters();
}

void throw_failure(BufferObject& buffer, const Failure& failure, Question question) {
  raise(failure, question, nb::find(buffer).ptr());
  throw nb::python_error();
}

}  // namespace turtlewire::python
