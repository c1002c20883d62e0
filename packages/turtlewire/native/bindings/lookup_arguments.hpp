// Reads the arguments of lookups, and of checks whether a lookup would succeed.
#pragma once

#include <array>
#include <cstddef>

#include "buffer.hpp"
#include "python.hpp"

namespace turtlewire::python {

// What `lookup_transform`, `can_transform` and `explain` take. With a fixed frame: the source at
// one time, as the target sees it at another.
struct Lookup {
  static constexpr std::size_t kCount = 7;

  PyObject *target = nullptr, *source = nullptr, *fixed = nullptr;
  Stamp t = kLatest, target_time = kLatest, timeout = 0, beyond = 0;

  static constexpr Parameters<kCount> parameters(const char* method) {
    return {method,
            2,
            3,
            {"target_frame", "source_frame", "stamp_ns", "timeout_ns", "extrapolate_ns",
             "fixed_frame", "target_stamp_ns"}};
  }

  bool take(const Values<kCount>& v) {
    target = v[0];
    source = v[1];
    fixed = v[5] == Py_None ? nullptr : v[5];
    return take_times(v) || prefer_frames();
  }

  bool lookup(BufferObject& buffer, Found& found) const {
    return is_plain() ? buffer.lookup(target, source, t, timeout, found)
                      : ask(buffer, &found, nullptr);
  }
  bool certainly_can_transform(BufferObject& buffer) const {
    return is_plain() && buffer.certainly_can_transform(target, source, t);
  }
  // Whether a lookup would succeed; `failure` says why not.
  bool can_transform(BufferObject& buffer, Failure& failure) const {
    return is_plain() ? buffer.can_transform(target, source, t, timeout, failure)
                      : ask(buffer, nullptr, &failure);
  }
  // What a lookup fails with; with a fixed frame, `can_transform` asks for the halves the other way
  // round, and so finds another failure if both have one.
  bool lookup_failure(BufferObject& buffer, Failure& failure) const {
    Found found;
    return ask(buffer, &found, &failure);
  }

 private:
  bool take_times(const Values<kCount>& v) {
    if (!moment_of(v[2], t, "stamp_ns") || !nanoseconds_of(v[3], timeout, "timeout_ns"))
      return false;
    if (v[4] == nullptr && v[6] == nullptr) [[likely]]
      return true;
    return nanoseconds_of(v[4], beyond, "extrapolate_ns") &&
           moment_of(v[6], target_time, "target_stamp_ns") && check();
  }

  // Always false. A call with swapped arguments reports its frames instead of its times.
  bool prefer_frames() const {
    if (PyUnicode_Check(target) && PyUnicode_Check(source)) return false;
    PyErr_Clear();
    std::string_view unused;
    return text_of(target, unused, "target_frame") && text_of(source, unused, "source_frame");
  }

  bool is_plain() const { return fixed == nullptr && beyond == 0; }

  bool check() const {
    if (beyond < 0) {
      PyErr_SetString(PyExc_ValueError, "extrapolate_ns must not be negative");
      return false;
    }
    if (fixed == nullptr && target_time != kLatest) {
      PyErr_SetString(PyExc_ValueError,
                      "target_stamp_ns needs fixed_frame, the frame that joins the two times");
      return false;
    }
    return true;
  }

  bool ask(BufferObject& buffer, Found* found, Failure* failure) const {
    if (fixed == nullptr) {
      Request request{.t = t, .beyond = beyond};
      return text_of(target, request.target, "target_frame") &&
             text_of(source, request.source, "source_frame") &&
             buffer.ask(request, timeout, found, failure);
    }
    FullRequest request{.target_time = target_time, .source_time = t, .beyond = beyond};
    return text_of(target, request.target, "target_frame") &&
           text_of(source, request.source, "source_frame") &&
           text_of(fixed, request.fixed, "fixed_frame") &&
           buffer.ask(request, timeout, found, failure);
  }
};

// A method that reads Arguments and gives them to `Answer`, with the object that `SelfOf` finds.
template <const char* Method, typename Arguments, auto SelfOf, auto Answer>
PyObject* with_arguments(PyObject* object, PyObject* const* given, Py_ssize_t count,
                         PyObject* keywords) {
  static constinit const Signature<Arguments::kCount> signature(Arguments::parameters(Method));
  Values<Arguments::kCount> values;
  Arguments arguments;
  auto* self = SelfOf(object);
  if (self == nullptr || !signature.read(given, count, keywords, values) ||
      !arguments.take(values)) {
    return nullptr;
  }
  return Answer(*self, arguments);
}

}  // namespace turtlewire::python
