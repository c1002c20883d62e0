// The few helpers around the raw Python interface that the hot methods need.
#pragma once

#include <nanobind/nanobind.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <new>
#include <span>
#include <string_view>
#include <vector>

#include "../core/samples.hpp"
#include "gil.hpp"

namespace turtlewire::python {

namespace nb = nanobind;

// Inside of tuples and bytes: CPython's macros where a wheel is for one version, and the functions
// of the stable ABI where it is for all later ones.
#if defined(Py_LIMITED_API)
inline Py_ssize_t tuple_size(PyObject* tuple) { return PyTuple_Size(tuple); }
inline PyObject* tuple_item(PyObject* tuple, Py_ssize_t i) { return PyTuple_GetItem(tuple, i); }
inline void set_tuple_item(PyObject* tuple, Py_ssize_t i, PyObject* item) {
  PyTuple_SetItem(tuple, i, item);
}
inline char* bytes_start(PyObject* bytes) { return PyBytes_AsString(bytes); }
#else
inline Py_ssize_t tuple_size(PyObject* tuple) { return PyTuple_GET_SIZE(tuple); }
inline PyObject* tuple_item(PyObject* tuple, Py_ssize_t i) { return PyTuple_GET_ITEM(tuple, i); }
inline void set_tuple_item(PyObject* tuple, Py_ssize_t i, PyObject* item) {
  PyTuple_SET_ITEM(tuple, i, item);
}
inline char* bytes_start(PyObject* bytes) { return PyBytes_AS_STRING(bytes); }
#endif

// A method in the vectorcall convention, as the method table wants it. No C++ exception may pass
// through Python.
using FastMethod = PyObject* (*)(PyObject*, PyObject* const*, Py_ssize_t, PyObject*);
template <FastMethod Method>
PyObject* guarded(PyObject* self, PyObject* const* arguments, Py_ssize_t count,
                  PyObject* keywords) {
  try {
    return Method(self, arguments, count, keywords);
  } catch (nb::python_error& error) {
    error.restore();
    return nullptr;
  } catch (const nb::builtin_exception& error) {
    const bool is_value = error.type() == nb::exception_type::value_error;
    PyErr_SetString(is_value ? PyExc_ValueError : PyExc_TypeError, error.what());
    return nullptr;
  } catch (const std::bad_alloc&) {
    return PyErr_NoMemory();
  } catch (const std::exception& error) {
    PyErr_SetString(PyExc_RuntimeError, error.what());
    return nullptr;
  }
}
template <FastMethod Method>
PyMethodDef fast_method(const char* name, const char* doc) {
  const FastMethod method = guarded<Method>;
  return {name, reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(method)),
          METH_FASTCALL | METH_KEYWORDS, doc};
}

// Owns a new reference; throws the Python error for a null.
inline nb::object checked(PyObject* object) {
  if (object == nullptr) throw nb::python_error();
  return nb::steal(object);
}

// Calls a function of a module, which is imported only now, with arguments as PyObject_CallMethod()
// takes them. Null with a Python error set.
template <typename... Arguments>
PyObject* call_python(const char* home, const char* function, const char* format,
                      Arguments... arguments) {
  return taking_gil([=]() -> PyObject* {
    PyObject* module = PyImport_ImportModule(home);
    if (module == nullptr) return nullptr;
    PyObject* result = PyObject_CallMethod(module, function, format, arguments...);
    Py_DECREF(module);
    return result;
  });
}

// A tuple of objects; null with a Python error set.
PyObject* tuple_of(std::span<PyObject* const> items);

// False, with the TypeError of turtlewire.call_errors for arguments that do not fit; `keywords` is
// null or a tuple.
bool raise_misfit(const char* method, std::span<PyObject* const> names, std::size_t required,
                  std::size_t positional, Py_ssize_t given, PyObject* keywords);

// False, with the TypeError of turtlewire.call_errors for an object that is no time of ROS.
bool raise_no_ros_time(PyObject* object, const char* what);

// A name as the str that the interpreter has of it only once, made at first use. That takes no
// lock: a thread that waits for a lock of C++ keeps a free-threaded interpreter from pausing its
// threads, and the one that holds it may be waiting for that pause to end.
class Interned {
 public:
  PyObject* get(const char* name) const {
    PyObject* known = object_.load(std::memory_order_acquire);
    if (known != nullptr) [[likely]]
      return known;
    PyObject* made = PyUnicode_InternFromString(name);
    object_.store(made, std::memory_order_release);
    return made;
  }

 private:
  mutable std::atomic<PyObject*> object_ = nullptr;
};

// The names of a method's parameters. The first `required` must be given, those after the first
// `positional` by keyword.
template <std::size_t N>
struct Parameters {
  const char* method;
  std::size_t required, positional;
  std::array<const char*, N> names;
};

// The arguments of a call in the order of the parameters; null for omitted ones.
template <std::size_t N>
using Values = std::array<PyObject*, N>;

// Reads the positional and keyword arguments of a call.
template <std::size_t N>
class Signature {
 public:
  constexpr explicit Signature(const Parameters<N>& parameters) : parameters_(parameters) {}

  // False with a TypeError if they do not fit.
  bool read(PyObject* const* arguments, Py_ssize_t count, PyObject* keywords,
            Values<N>& values) const {
    if (take(arguments, count, keywords, values)) [[likely]]
      return true;
    Values<N> names;
    for (std::size_t i = 0; i < N; ++i) names[i] = name(i);
    return raise_misfit(parameters_.method, names, parameters_.required, parameters_.positional,
                        count, keywords);
  }

  // The same for the arguments of a constructor: a tuple and a dictionary, which may be null.
  bool read_all(PyObject* arguments, PyObject* keywords, Values<N>& values) const {
    std::vector<PyObject*> given, names;
    for (Py_ssize_t i = 0; i < tuple_size(arguments); ++i)
      given.push_back(tuple_item(arguments, i));
    PyObject *name = nullptr, *value = nullptr;
    Py_ssize_t place = 0;
    while (keywords != nullptr && PyDict_Next(keywords, &place, &name, &value)) {
      names.push_back(name);
      given.push_back(value);
    }
    PyObject* all_names = tuple_of(names);
    if (all_names == nullptr) return false;
    const bool fits = read(given.data(), tuple_size(arguments), all_names, values);
    Py_DECREF(all_names);
    return fits;
  }

 private:
  bool take(PyObject* const* arguments, Py_ssize_t count, PyObject* keywords,
            Values<N>& values) const {
    values.fill(nullptr);
    if (static_cast<std::size_t>(count) > parameters_.positional) return false;
    for (Py_ssize_t i = 0; i < count; ++i) values[static_cast<std::size_t>(i)] = arguments[i];
    if (keywords != nullptr && !take_keywords(arguments + count, keywords, values)) return false;
    for (std::size_t i = 0; i < parameters_.required; ++i) {
      if (values[i] == nullptr) return false;
    }
    return true;
  }

  bool take_keywords(PyObject* const* given, PyObject* keywords, Values<N>& values) const {
    for (Py_ssize_t k = 0; k < tuple_size(keywords); ++k) {
      const std::size_t i = index_of(tuple_item(keywords, k));
      if (i == N || values[i] != nullptr) return false;
      values[i] = given[k];
    }
    return true;
  }

  // N for a name that is none of them. Calls spell keywords with interned strings, so the pointers
  // of all names are compared before the text of any.
  std::size_t index_of(PyObject* keyword) const {
    for (std::size_t i = 0; i < N; ++i)
      if (name(i) == keyword) return i;
    std::size_t i = 0;
    while (i < N && PyUnicode_Compare(name(i), keyword) != 0) ++i;
    return i;
  }

  PyObject* name(std::size_t i) const { return names_[i].get(parameters_.names[i]); }

  Parameters<N> parameters_;
  std::array<Interned, N> names_;
};

// False, with the TypeError of turtlewire.call_errors for an object that is no str.
bool raise_no_text(PyObject* object, const char* what);

// A string's own bytes; they live as long as the object. False with a TypeError or
// UnicodeEncodeError set.
inline bool text_of(PyObject* object, std::string_view& text, const char* what) {
  if (!PyUnicode_Check(object)) {
    return raise_no_text(object, what);
  }
  Py_ssize_t size = 0;
  const char* bytes = PyUnicode_AsUTF8AndSize(object, &size);
  if (bytes == nullptr) return false;
  text = {bytes, static_cast<std::size_t>(size)};
  return true;
}

// A str of UTF-8; invalid bytes become U+FFFD.
inline PyObject* to_python(std::string_view text) {
  return PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace");
}
inline nb::str text(std::string_view value) { return nb::str(value.data(), value.size()); }

// As PyLong_AsLongLong(), which takes a detour through an array of bytes for ints of stamps' size.
inline std::int64_t to_int64(PyObject* object) {
  if (PyLong_CheckExact(object)) {
    int overflow = 0;
    const long long value = PyLong_AsLongLongAndOverflow(object, &overflow);
    if (overflow == 0) [[likely]]
      return value;
  }
  return taking_gil([object] { return PyLong_AsLongLong(object); });
}

// Nanoseconds from an int (or what has __index__) or a datetime64; a null object leaves the
// default. False with a Python error set. The second function goes on where to_int64 has failed.
bool nanoseconds_of_other(PyObject* object, Stamp& value, const char* what);
inline bool nanoseconds_of(PyObject* object, Stamp& value, const char* what) {
  if (object == nullptr) return true;
  value = to_int64(object);
  if (value != -1 || PyErr_Occurred() == nullptr) [[likely]]
    return true;
  return nanoseconds_of_other(object, value, what);
}

// The time of a question: a null object or None is kLatest. False with a Python error set.
bool raise_no_time(const char* what);
inline bool moment_of(PyObject* object, Stamp& value, const char* what) {
  value = kLatest;
  if (object == nullptr || object == Py_None) return true;
  return nanoseconds_of(object, value, what) && (value != kLatest || raise_no_time(what));
}

// Reads a fixed count of numbers from a sequence. False with a Python error set.
bool numbers_of(PyObject* sequence, double* values, Py_ssize_t count, const char* what);

// None for an argument that was left out.
inline nb::handle or_none(PyObject* value) { return value == nullptr ? Py_None : value; }

// The same for functions of nanobind: throws if there is a Python error.
Stamp nanoseconds_of(nb::handle object, const char* what);
Stamp nanoseconds_or(PyObject* object, Stamp value, const char* what);  // null is `value`
Stamp moment_of(nb::handle object, const char* what);
bool is_true(PyObject* object);  // null is false
// Reads one of two words; null is the first.
int choice_of(PyObject* object, const char* what, std::string_view first, std::string_view second);
std::string_view text_of(nb::handle object, const char* what);

}  // namespace turtlewire::python
