// NumPy arrays that show memory of C++ as it lies there: nothing is copied, and the array keeps its owner alive.
#pragma once

#include <pybind11/numpy.h>

#include <memory>
#include <vector>

namespace boresight::python {

// Keeps `owner` for as long as an array has this as its base.
template <typename T>
pybind11::capsule kept(std::shared_ptr<T> owner) {
  return pybind11::capsule(new std::shared_ptr<T>(std::move(owner)),
                           [](void* p) { delete static_cast<std::shared_ptr<T>*>(p); });
}

inline pybind11::array read_only(pybind11::array array) {
  array.attr("setflags")(pybind11::arg("write") = false);
  return array;
}

// One number, or `width` in a row, of every element of a vector that `owner` owns: shape (n) or (n, width).
// first: that of the first element; null where there is none. every: of so many elements one, the first among them.
template <typename Element, typename Number, typename Owner>
pybind11::array column(const std::shared_ptr<Owner>& owner, const std::vector<Element>& elements, const Number* first,
                       pybind11::ssize_t width = 1, std::size_t every = 1) {
  const auto n = static_cast<pybind11::ssize_t>((elements.size() + every - 1) / every);
  std::vector<pybind11::ssize_t> shape{n}, strides{static_cast<pybind11::ssize_t>(every * sizeof(Element))};
  if (width > 1) {
    shape.push_back(width);
    strides.push_back(static_cast<pybind11::ssize_t>(sizeof(Number)));
  }
  if (n == 0) return read_only(pybind11::array(pybind11::dtype::of<Number>(), shape));
  return read_only(pybind11::array(pybind11::dtype::of<Number>(), shape, strides, first, kept(owner)));
}

// A vector that becomes the array's own memory.
inline pybind11::array owned(std::vector<double> values, std::vector<pybind11::ssize_t> shape) {
  auto owner = std::make_shared<std::vector<double>>(std::move(values));
  std::vector<pybind11::ssize_t> strides(shape.size(), static_cast<pybind11::ssize_t>(sizeof(double)));
  for (std::size_t k = shape.size(); k-- > 1;) strides[k - 1] = strides[k] * shape[k];
  return pybind11::array(pybind11::dtype::of<double>(), std::move(shape), std::move(strides), owner->data(),
                         kept(owner));
}

}  // namespace boresight::python
