// Many mutations in one build, each behind a switch that the environment sets when the program runs. mutate.py's --together puts it into
// a copy of the tree; the tree itself never sees it.
//
//   BORESIGHT_MUTANT=17        does what mutation 17 says; none where it is not set
//   BORESIGHT_MUTANTS_MET=FILE marks there, a byte for each mutation, which of them were come across
//
// How an operator is switched without knowing where its operands begin and end: `a + b` becomes `a + mutants::at<17> + b`. That has the
// same precedence and groups from the left, so that what stands left of the mark is what stood left of the operator, and likewise to the
// right. A sign, `-a`, becomes `mutants::at<17>->*a`, which binds more weakly than calls and more strongly than products, as a sign does.
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <type_traits>
#include <utility>

namespace mutants {

inline constexpr int kMost = 4096;
// Added to the number of a mutation that nothing may need when compiling: a constant that it makes is then made when the program begins.
inline constexpr int kLive = 1 << 16;
inline int active = 0;
inline unsigned char nobody_looks[kMost] = {};
inline unsigned char* met =
    nobody_looks;  // shared with other processes, so that those which are killed have said it too

struct FromEnvironment {
  FromEnvironment() {
    if (const char* asked = std::getenv("BORESIGHT_MUTANT")) active = std::atoi(asked);
    const char* file = std::getenv("BORESIGHT_MUTANTS_MET");
    if (file == nullptr) return;
    const int opened = ::open(file, O_RDWR | O_CREAT, 0644);
    if (opened < 0) return;
    if (::ftruncate(opened, kMost) == 0)
      if (void* at = ::mmap(nullptr, kMost, PROT_READ | PROT_WRITE, MAP_SHARED, opened, 0); at != MAP_FAILED)
        met = static_cast<unsigned char*>(at);
    ::close(opened);
  }
};
inline const FromEnvironment from_environment;

inline bool chosen(int id) {
  if (met[id] == 0) met[id] = 1;
  return active == id;
}

// What an expression of a matrix library stands for: both sides of a switch need one type, and none may refer to what is gone.
template <typename E>
constexpr auto settled(E&& e) {
  if constexpr (requires {
                  e.eval();
                  typename std::decay_t<E>::PlainObject;
                })
    return typename std::decay_t<E>::PlainObject(std::forward<E>(e));
  else
    return std::decay_t<E>(std::forward<E>(e));
}

// original() and mutated() as callables, so that only one is computed. Where the mutation would not compile, the mark says that.
template <int id, bool valid, typename Original, typename Mutated>
constexpr auto either(const Original& original, [[maybe_unused]] const Mutated& mutated) {
  if (id >= kLive || !std::is_constant_evaluated()) {
    if constexpr (valid) {
      if (chosen(id % kLive)) return mutated();
    } else {
      met[id % kLive] = 2;
    }
  }
  return original();
}

template <int id, char op, typename L>
struct Left {
  L l;
};

// In `x += mutants::at<17> = y` and `x *= mutants::at<17> = y` what is assigned is -y and 1 / y where the mutation is chosen.
template <int id, char op = '+'>
struct At {
  template <typename R>
  constexpr auto operator=(R&& r) const {
    if constexpr (op == '*') {
      constexpr bool valid = !std::is_integral_v<std::decay_t<R>> && requires { std::decay_t<R>(1.0) / r; };
      return either<id, valid>([&] { return settled(r); },
                               [&] {
                                 if constexpr (valid)
                                   return settled(std::decay_t<R>(1.0) / r);
                                 else
                                   return settled(r);
                               });
    } else {
      // A yes or no counts as a number: the negative of a yes would be a yes.
      constexpr auto value = [](auto&& v) {
        if constexpr (std::is_same_v<std::decay_t<R>, bool>)
          return static_cast<int>(v);
        else
          return settled(std::forward<decltype(v)>(v));
      };
      constexpr bool valid = requires { -r; };
      return either<id, valid>([&] { return value(r); },
                               [&] {
                                 if constexpr (valid)
                                   return static_cast<decltype(value(r))>(settled(-r));
                                 else
                                   return value(r);
                               });
    }
  }
};
template <int id>
inline constexpr At<id> at{};
template <int id>
inline constexpr At<id, '*'> product_at{};

template <int id, typename N>
constexpr N number(N original, N mutated) {
  return either<id, true>([&] { return original; }, [&] { return mutated; });
}

// As the left operand of `&&` and `||`, in front of the two ways of it.
template <int id>
constexpr bool logical() {
  return either<id, true>([] { return false; }, [] { return true; });
}

#define MUTANTS_BINARY(TAG, OP, OTHER)                                                               \
  template <typename L, int id>                                                                      \
  constexpr Left<id, TAG, L&&> operator OP(L&& l, const At<id>&) {                                   \
    return {std::forward<L>(l)};                                                                     \
  }                                                                                                  \
  template <int id, typename L, typename R>                                                          \
  constexpr auto operator OP(const Left<id, TAG, L>& left, R&& r) {                                  \
    auto& l = left.l;                                                                                \
    constexpr bool valid = requires { static_cast<decltype(settled(l OP r))>(settled(l OTHER r)); }; \
    return either<id, valid>([&] { return settled(l OP r); },                                        \
                             [&] {                                                                   \
                               if constexpr (valid)                                                  \
                                 return static_cast<decltype(settled(l OP r))>(settled(l OTHER r));  \
                               else                                                                  \
                                 return settled(l OP r);                                             \
                             });                                                                     \
  }
MUTANTS_BINARY('+', +, -)
MUTANTS_BINARY('-', -, +)
MUTANTS_BINARY('*', *, /)
MUTANTS_BINARY('/', /, *)
MUTANTS_BINARY('<', <, <=)
MUTANTS_BINARY('>', >, >=)
MUTANTS_BINARY('l', <=, <)
MUTANTS_BINARY('g', >=, >)
MUTANTS_BINARY('e', ==, !=)
MUTANTS_BINARY('n', !=, ==)
#undef MUTANTS_BINARY

// A sign that falls away.
template <int id, typename R>
constexpr auto operator->*(const At<id>&, R&& r) {
  return either<id, true>([&] { return settled(-r); }, [&] { return static_cast<decltype(settled(-r))>(settled(r)); });
}

}  // namespace mutants
