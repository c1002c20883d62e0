// NumPy arrays in and out.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>

#include "../core/samples.hpp"
#include "gil.hpp"

namespace turtlewire::python {

namespace nb = nanobind;

using Stamps = nb::ndarray<const Stamp, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

// Whether `object` is such an array as it stands. A scalar is none: those of NumPy's times offer a
// buffer without strides, which nanobind would read. What has no length is a scalar.
template <typename Array>
bool is_array(nb::handle object, Array& array) {
  return nb::hasattr(object, "__len__") && nb::try_cast(object, array, false);
}

// numpy.ascontiguousarray(object, dtype)
nb::object contiguous_array(nb::handle object, const char* dtype);

// int64 stamps from an array or sequence of integers. Floats raise a TypeError, as they cannot hold
// a present stamp; integers beyond 64 bits raise an OverflowError.
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

// Throws a ValueError that names both shapes unless they are equal.
template <typename Array>
void check_shape(const Array& array, std::initializer_list<std::size_t> shape, const char* name) {
  std::string wanted, given;
  for (const std::size_t extent : shape)
    wanted += (wanted.empty() ? "" : ", ") + std::to_string(extent);
  for (std::size_t i = 0; i < array.ndim(); ++i)
    given += (given.empty() ? "" : ", ") + std::to_string(array.shape(i));
  if (wanted == given) return;
  throw nb::value_error(
      (std::string(name) + " must have the shape (" + wanted + "), not (" + given + ")").c_str());
}

}  // namespace turtlewire::python
