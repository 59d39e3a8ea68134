// A loop over few indices, each of them a constant from the start where their number is known when compiling: compilers keep an
// array's numbers in registers only where every index is such a constant before loops are unrolled.
#pragma once

#include <type_traits>
#include <utility>

namespace boresight {

// f(k) for k = 0 .. N - 1, or for k = 0 .. count - 1 where N is 0. f takes `auto`: an integral constant or an int.
template <int N, typename F>
[[gnu::always_inline]] inline void each_index(int count, F&& f) {
  if constexpr (N == 0) {
    for (int k = 0; k < count; ++k) f(k);
  } else {
    [&]<int... K>(std::integer_sequence<int, K...>) __attribute__((always_inline)) {
      (f(std::integral_constant<int, K>()), ...);
    }
    (std::make_integer_sequence<int, N>());
  }
}

}  // namespace boresight
