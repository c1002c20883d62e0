// The arguments of lookups and of the questions whether one would succeed, read in one place.
#pragma once

#include <array>
#include <cstddef>

#include "buffer.hpp"
#include "python.hpp"

namespace turtlewire::python {

// How Buffer's methods call their arguments, and how they read times.
struct Nanoseconds {
  static constexpr std::size_t kRequired = 2;
  static constexpr std::array<const char*, 4> kNames{"target_frame", "source_frame", "stamp_ns",
                                                     "timeout_ns"};
  static constexpr std::array<const char*, 6> kFullNames{"target_frame", "target_stamp_ns",
                                                         "source_frame", "source_stamp_ns",
                                                         "fixed_frame",  "timeout_ns"};
  static bool time(PyObject* object, Stamp& t, const char* name) {
    return nanoseconds_of(object, t, name);
  }
  static bool timeout(PyObject* object, Stamp& span, const char* name) {
    return nanoseconds_of(object, span, name);
  }
};

template <typename Times>
struct AtOneTime {
  using Values = std::array<PyObject*, 4>;

  PyObject *target = nullptr, *source = nullptr;
  Stamp t = 0, timeout = 0;

  static Signature<4> signature(const char* method) {
    return {method, Times::kRequired, Times::kNames};
  }
  bool take(const Values& v) {
    target = v[0];
    source = v[1];
    return Times::time(v[2], t, Times::kNames[2]) &&
           Times::timeout(v[3], timeout, Times::kNames[3]);
  }

  bool lookup(BufferObject& buffer, Found& found) const {
    return buffer.lookup(target, source, t, timeout, found);
  }
  bool certainly_can_transform(BufferObject& buffer) const {
    return buffer.certainly_can_transform(target, source, t);
  }
  bool can_transform(BufferObject& buffer, Failure& failure) const {
    return buffer.can_transform(target, source, t, timeout, failure);
  }
};

// By way of a frame that did not move meanwhile.
template <typename Times>
struct AtTwoTimes {
  using Values = std::array<PyObject*, 6>;

  PyObject *target = nullptr, *source = nullptr, *fixed = nullptr;
  Stamp target_time = 0, source_time = 0, timeout = 0;

  static Signature<6> signature(const char* method) { return {method, 5, Times::kFullNames}; }
  bool take(const Values& v) {
    target = v[0];
    source = v[2];
    fixed = v[4];
    return Times::time(v[1], target_time, Times::kFullNames[1]) &&
           Times::time(v[3], source_time, Times::kFullNames[3]) &&
           Times::timeout(v[5], timeout, Times::kFullNames[5]);
  }

  bool lookup(BufferObject& buffer, Found& found) const {
    return buffer.lookup(target, target_time, source, source_time, fixed, timeout, found);
  }
  bool certainly_can_transform(BufferObject&) const { return false; }
  bool can_transform(BufferObject& buffer, Failure& failure) const {
    return buffer.can_transform(target, target_time, source, source_time, fixed, timeout, failure);
  }
};

// A method that reads Arguments and gives them to `Answer`, with the object that `SelfOf` finds.
template <const char* Method, typename Arguments, auto SelfOf, auto Answer>
PyObject* with_arguments(PyObject* object, PyObject* const* given, Py_ssize_t count,
                         PyObject* keywords) {
  static const auto signature = Arguments::signature(Method);
  typename Arguments::Values values;
  Arguments arguments;
  auto* self = SelfOf(object);
  if (self == nullptr || !signature.read(given, count, keywords, values) ||
      !arguments.take(values)) {
    return nullptr;
  }
  return Answer(*self, arguments);
}

}  // namespace turtlewire::python
