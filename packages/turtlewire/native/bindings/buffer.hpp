// What stands behind turtlewire.Buffer.
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

class BufferObject {
 public:
  BufferObject(std::optional<Stamp> cache_time_ns, std::optional<std::int64_t> max_frames);
  BufferObject(const BufferObject&) = delete;
  BufferObject& operator=(const BufferObject&) = delete;
  ~BufferObject();

  SharedBuffer shared;
  nb::list listeners;  // called after data came in
  std::atomic<std::uint64_t> interrupts = 0;

  // Looks up; on failure sets the Python error and returns false.
  bool lookup(PyObject* target, PyObject* source, Stamp t, Stamp timeout, Found& found);
  bool lookup(PyObject* target, Stamp target_time, PyObject* source, Stamp source_time,
              PyObject* fixed, Stamp timeout, Found& found);

  // Whether a path exists; `failure` says why not. False with a Python error set if the arguments
  // or a wait failed.
  bool can_transform(PyObject* target, PyObject* source, Stamp t, Stamp timeout, Failure& failure);
  bool can_transform(PyObject* target, Stamp target_time, PyObject* source, Stamp source_time,
                     PyObject* fixed, Stamp timeout, Failure& failure);
  // The quick yes: without words.
  bool certainly_can_transform(PyObject* target, PyObject* source, Stamp t);

  // Adds one transform; the reason if it is refused. Wakes who waits, but does not call the
  // listeners.
  std::string set(std::string_view parent, std::string_view child, Stamp stamp, const Pose& pose,
                  std::string_view authority, bool is_static);
  void refuse_message(std::string_view fault, std::string_view authority);
  void call_listeners();
  void listeners_changed();  // to be called then
  void wake();

 private:
  // A pair of names seen before, known again by the identity of the two string objects, which it
  // keeps alive.
  struct KnownPath {
    PyObject* target = nullptr;
    PyObject* source = nullptr;
    const Path* path = nullptr;
    std::uint64_t epoch = 0;
  };

  KnownPath& place_of(PyObject* target, PyObject* source);
  const Path* known_path(Tree& tree, PyObject* target, PyObject* source);
  void remember_path(PyObject* target, PyObject* source, std::string_view target_name,
                     std::string_view source_name);
  bool lookup_by_name(PyObject* target, PyObject* source, Stamp t, Stamp timeout, Found& found);
  template <typename Request, typename Ask>
  bool answer(const Request& request, Stamp timeout, Failure& failure, Ask ask);

  std::array<KnownPath, 256> known_paths_;
};

void add_buffer_type(nb::module_& module);

// The object behind a Python `Buffer`; null with a Python error set if it was never initialised.
BufferObject* buffer_of(PyObject* self);

}  // namespace turtlewire::python
