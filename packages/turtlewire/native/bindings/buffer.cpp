#include "buffer.hpp"

#include "errors.hpp"
#include "waiting.hpp"

namespace turtlewire::python {
namespace {

Status ask(SharedBuffer& shared, const Request& request, Found* found, Failure& failure) {
  return found != nullptr ? shared.lookup(request, *found, failure)
                          : shared.can_transform(request, failure);
}

Status ask(SharedBuffer& shared, const FullRequest& request, Found* found, Failure& failure) {
  return found != nullptr ? shared.lookup(request, *found, failure)
                          : shared.can_transform(request, failure);
}

}  // namespace

namespace {

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
