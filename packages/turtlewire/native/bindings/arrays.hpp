// NumPy arrays in and out.
#pragma once

#include <nanobind/ndarray.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "python.hpp"

namespace turtlewire::python {

using Stamps = nb::ndarray<const Stamp, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

// Whether `object` is such an array without a conversion. A scalar is not: NumPy's times offer a
// buffer without strides, which nanobind would read. An object without a length is a scalar.
template <typename Array>
bool is_array(nb::handle object, Array& array) {
  return nb::hasattr(object, "__len__") && nb::try_cast(object, array, false);
}

// A named tuple of turtlewire.tf.answers.
nb::object make_answer(const char* name, const nb::tuple& fields);

// The array that a function of turtlewire.tf.array_arguments makes of an argument; its errors name
// the accepted types.
nb::object checked_array(const char* function, nb::handle object);

// int64 stamps from an array or sequence of integers or datetime64.
Stamps stamps_of(nb::handle object);

// A new array that owns its memory.
template <typename T>
nb::ndarray<nb::numpy, T> new_array(std::initializer_list<std::size_t> shape) {
  std::size_t size = 1;
  for (const std::size_t extent : shape) size *= extent;
  auto data = std::make_unique<T[]>(std::max<std::size_t>(size, 1));
  T* const begin = data.get();
  const nb::capsule owner(data.release(), [](void* p) noexcept { delete[] static_cast<T*>(p); });
  return nb::ndarray<nb::numpy, T>(begin, shape, owner);
}

// As Python writes tuples: (7,) and (5, 7).
template <typename Extents>
std::string shape_text(const Extents& extents) {
  std::string text;
  for (const std::size_t extent : extents)
    text += (text.empty() ? "" : ", ") + std::to_string(extent);
  return "(" + text + (extents.size() == 1 ? ",)" : ")");
}

// Throws a ValueError that names both shapes unless they are equal.
template <typename Array>
void check_shape(const Array& array, std::initializer_list<std::size_t> shape, const char* name) {
  bool fits = array.ndim() == shape.size();
  for (std::size_t i = 0; fits && i < shape.size(); ++i) fits = array.shape(i) == shape.begin()[i];
  if (fits) return;
  std::vector<std::size_t> given(array.ndim());
  for (std::size_t i = 0; i < given.size(); ++i) given[i] = array.shape(i);
  throw nb::value_error((std::string(name) + " must have the shape " + shape_text(shape) +
                         ", not " + shape_text(given))
                            .c_str());
}

}  // namespace turtlewire::python
