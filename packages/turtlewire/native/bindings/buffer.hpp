// The implementation of turtlewire.Buffer.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "../core/shared_buffer.hpp"
#include "../feeds/tf_message.hpp"
#include "python.hpp"

namespace turtlewire::python {

// The default sender of transforms.
constexpr std::string_view kUnknownSender = "default_authority";

class BufferObject {
 public:
  BufferObject(nb::handle cache_time_ns, nb::handle max_frames);
  BufferObject(const BufferObject&) = delete;
  BufferObject& operator=(const BufferObject&) = delete;
  ~BufferObject();

  SharedBuffer shared;
  nb::list listeners;  // called after data came in
  std::atomic<std::uint64_t> interrupts = 0;

  // Looks up; on failure sets the Python error and returns false.
  bool lookup(PyObject* target, PyObject* source, Stamp t, Stamp timeout, Found& found);

  // Whether a path exists; `failure` says why not. False with a Python error set if the arguments
  // or a wait failed.
  bool can_transform(PyObject* target, PyObject* source, Stamp t, Stamp timeout, Failure& failure);

  // The same for rare kinds of lookups: with `found` a lookup, else only whether one
  // would succeed. Without `failure`, a lookup that has no answer sets the Python error.
  template <typename Request>
  bool ask(const Request& request, Stamp timeout, Found* found, Failure* failure) {
    Failure own;
    Failure& why = failure != nullptr ? *failure : own;
    if (!answer(request, timeout, why, found)) return false;
    if (failure != nullptr || why.status == Status::ok) return true;
    return raise_failure(why);
  }
  // The fast path: no reason for a failure.
  bool certainly_can_transform(PyObject* target, PyObject* source, Stamp t);

  // Adds one transform and calls the listeners, unless it is refused.
  Verdict set(std::string_view parent, std::string_view child, Stamp stamp, const Pose& pose,
              std::string_view authority, bool is_static);
  void refuse_message(std::string_view fault, std::string_view authority);
  void call_listeners();
  void listeners_changed();  // to be called then
  void wake();

 private:
  // A cached pair of names, recognized by the identity of the two string objects, which it keeps
  // alive. The lock of `shared` guards it.
  struct KnownPath {
    PyObject* target = nullptr;
    PyObject* source = nullptr;
    const Path* path = nullptr;
    std::uint64_t epoch = 0;
  };

  KnownPath& place_of(PyObject* target, PyObject* source);
  const Path* known_path(const Tree& tree, PyObject* target, PyObject* source);
  void remember_path(PyObject* target, PyObject* source, std::string_view target_name,
                     std::string_view source_name);
  bool lookup_by_name(PyObject* target, PyObject* source, Stamp t, Stamp timeout, Found& found);
  bool answer(const Request& request, Stamp timeout, Failure& failure, Found* found);
  bool answer(const FullRequest& request, Stamp timeout, Failure& failure, Found* found);
  template <typename Request>
  bool answer_or_wait(const Request& request, Stamp timeout, Failure& failure, Found* found);
  bool raise_failure(const Failure& failure);  // always false

  std::array<KnownPath, 256> known_paths_;
};

// Raises the error of a question without an answer, for functions of nanobind.
[[noreturn]] void throw_failure(BufferObject& buffer, const Failure& failure, Question question);

// The object behind a Python `Buffer`; null with a Python error set if it was never initialised.
BufferObject* buffer_of(PyObject* self);

// A method of Buffer: `Answer` gets the arguments that `Names` reads, and returns an object.
template <const auto& Names, auto Answer>
PyObject* answered(PyObject* object, PyObject* const* given, Py_ssize_t count, PyObject* keywords) {
  static constinit const Signature signature(Names);
  Values<Names.names.size()> values;
  BufferObject* self = buffer_of(object);
  if (self == nullptr || !signature.read(given, count, keywords, values)) return nullptr;
  return nb::object(Answer(*self, values)).release().ptr();
}
template <const auto& Names, auto Answer>
PyMethodDef buffer_method(const char* doc) {
  return fast_method<answered<Names, Answer>>(Names.method, doc);
}

}  // namespace turtlewire::python
