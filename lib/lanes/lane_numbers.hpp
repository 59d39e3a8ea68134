// Arrays of lanes: of a size known when compiling, so that loops over few coordinates unroll, or of one known when running.
#pragma once

#include <array>
#include <type_traits>
#include <vector>

namespace boresight {

template <typename T, int Fixed>
using LaneNumbers = std::conditional_t<(Fixed > 0), std::array<T, (Fixed > 0 ? Fixed : 1)>, std::vector<T>>;

// All zero.
template <typename T, std::size_t Fixed>
void shape(std::array<T, Fixed>& numbers, int) {
  for (T& x : numbers) x = T(0.0);
}
template <typename T>
void shape(std::vector<T>& numbers, int size) {
  numbers.assign(static_cast<std::size_t>(size), T(0.0));
}

}  // namespace boresight
