#include "boresight/io/expression.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <sstream>

#include "boresight/io/expression_parser.hpp"
#include "boresight/io/tape.hpp"
#include "boresight/keys/units.hpp"
#include "boresight/keys/value_fault.hpp"
#include "boresight/math/constant_law.hpp"

namespace boresight {
namespace {

using GiNaC::ex;
using GiNaC::is_a;
using GiNaC::numeric;

constexpr std::size_t kLongestTape = 20000;

// Too long to be differentiated or kept.
struct TooLong {};

// Writes expressions onto one tape, each distinct sub-expression once.
class Compiler {
 public:
  explicit Compiler(const ex& time, const ex& coordinate = ex()) : time_(time), coordinate_(coordinate) {}

  int slot_of(const ex& e) {
    if (const auto it = slots_.find(e); it != slots_.end()) return it->second;
    const int slot = compile(e);
    slots_.emplace(e, slot);
    return slot;
  }

  int constant(double value) { return push(Operation::constant, 0, 0, value); }
  int push(Operation operation, int first, int second = 0, double value = 0.0) {
    if (entries.size() >= kLongestTape) throw TooLong();
    entries.push_back({operation, first, second, value});
    return static_cast<int>(entries.size()) - 1;
  }

  std::vector<TapeEntry> entries;

 private:
  int compile(const ex& e) {
    if (e.is_equal(time_)) return push(Operation::time, 0);
    if (is_a<GiNaC::symbol>(e) && e.is_equal(coordinate_)) return push(Operation::coordinate, 0);
    if (is_a<numeric>(e) || is_a<GiNaC::constant>(e)) {
      const ex value = e.evalf();
      if (!is_a<numeric>(value) || !GiNaC::ex_to<numeric>(value).is_real()) {
        throw ValueFault("a number that is not real", "a real expression of t");
      }
      return constant(GiNaC::ex_to<numeric>(value).to_double());
    }
    if (is_a<GiNaC::add>(e) || is_a<GiNaC::mul>(e)) {
      const Operation operation = is_a<GiNaC::add>(e) ? Operation::add : Operation::multiply;
      int result = -1;
      for (const ex& part : in_order(e)) {
        const int next = slot_of(part);
        result = result < 0 ? next : push(operation, result, next);
      }
      return result;
    }
    if (is_a<GiNaC::power>(e)) return compile_power(e.op(0), e.op(1));
    if (is_a<GiNaC::function>(e)) return compile_function(GiNaC::ex_to<GiNaC::function>(e).get_name(), e);
    throw ValueFault("something that has no value", "a real expression of t");
  }

  // GiNaC keeps the terms of a sum in an order that depends on where the program was loaded. Rounding would then differ from one
  // start to the next, and a motion with impacts carries the last bit into its result: so the terms get an order of their own.
  std::vector<ex> in_order(const ex& e) {
    std::vector<ex> parts(e.begin(), e.end());
    std::stable_sort(parts.begin(), parts.end(), [this](const ex& a, const ex& b) { return rank(a) < rank(b); });
    return parts;
  }

  // A fingerprint of the expression's structure alone (FNV-1a).
  std::uint64_t rank(const ex& e) {
    if (const auto it = ranks_.find(e); it != ranks_.end()) return it->second;
    std::ostringstream text;
    if (e.nops() == 0) {
      text << e;
    } else {
      text << (is_a<GiNaC::function>(e) ? GiNaC::ex_to<GiNaC::function>(e).get_name()
                                        : GiNaC::ex_to<GiNaC::basic>(e).class_name());
      std::vector<std::uint64_t> parts;
      for (std::size_t i = 0; i < e.nops(); ++i) parts.push_back(rank(e.op(i)));
      if (is_a<GiNaC::add>(e) || is_a<GiNaC::mul>(e)) std::sort(parts.begin(), parts.end());
      for (const std::uint64_t part : parts) text << ' ' << part;
    }
    std::uint64_t hash = 0xcbf29ce484222325ULL;
    for (const char c : text.str()) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
    ranks_.emplace(e, hash);
    return hash;
  }

  // Whole powers by repeated squaring, half ones through the square root.
  int compile_power(const ex& base, const ex& exponent) {
    const int b = slot_of(base);
    if (is_a<numeric>(exponent)) {
      const numeric twice = GiNaC::ex_to<numeric>(exponent) * numeric(2);
      if (twice.is_integer() && std::abs(twice.to_double()) <= 128.0) {
        const int halves = twice.to_int(), size = std::abs(halves);
        int result = -1;
        if (size % 2 != 0) result = push(Operation::square_root, b);
        int factor = b;
        for (int n = size / 2; n > 0; n /= 2) {
          if (n % 2 != 0) result = result < 0 ? factor : push(Operation::multiply, result, factor);
          if (n > 1) factor = push(Operation::square, factor);
        }
        if (result < 0) result = constant(1.0);
        return halves < 0 ? push(Operation::reciprocal, result) : result;
      }
    }
    const int n = slot_of(exponent);
    return push(Operation::power, b, n);
  }

  int compile_function(const std::string& name, const ex& e) {
    static const std::map<std::string, Operation> one = {{"sin", Operation::sine},
                                                         {"cos", Operation::cosine},
                                                         {"tan", Operation::tangent},
                                                         {"asin", Operation::arcsine},
                                                         {"acos", Operation::arccosine},
                                                         {"atan", Operation::arctangent},
                                                         {"sinh", Operation::hyperbolic_sine},
                                                         {"cosh", Operation::hyperbolic_cosine},
                                                         {"tanh", Operation::hyperbolic_tangent},
                                                         {"exp", Operation::exponential},
                                                         {"log", Operation::logarithm},
                                                         {"magnitude", Operation::magnitude},
                                                         {"sign_of", Operation::sign}};
    const int x = slot_of(e.op(0));
    if (name == "atan2") {
      const int y = slot_of(e.op(1));
      return push(Operation::arctangent2, x, y);
    }
    const auto it = one.find(name);
    if (it == one.end()) throw ValueFault("the function " + name, "a function of real numbers");
    return push(it->second, x);
  }

  ex time_, coordinate_;
  std::map<ex, int, GiNaC::ex_is_less> slots_;
  std::map<ex, std::uint64_t, GiNaC::ex_is_less> ranks_;
};

// Counts the nodes of an expression, shared ones as often as they occur, up to a bound.
std::size_t nodes(const ex& e, std::size_t bound) {
  std::size_t count = 1;
  for (std::size_t i = 0; i < e.nops() && count < bound; ++i) count += nodes(e.op(i), bound - count);
  return count;
}

class Combination final : public TimeFunction {
 public:
  explicit Combination(std::vector<std::pair<double, TimeFunctionPtr>> parts) : parts_(std::move(parts)) {}
  TimeValue at(double t) const override {
    TimeValue sum;
    for (const auto& [factor, part] : parts_) {
      const TimeValue v = part->at(t);
      sum.value += factor * v.value;
      sum.rate += factor * v.rate;
      sum.acceleration += factor * v.acceleration;
    }
    return sum;
  }

 private:
  std::vector<std::pair<double, TimeFunctionPtr>> parts_;
};

TimeFunctionPtr compile(const std::string& text, const NamedExpressions& named, double scale) {
  constexpr std::size_t kMostNodes = 100000;
  const GiNaC::realsymbol t("t");
  std::map<std::string, ex> names = {{"t", t}};
  for (const auto& [name, expression] : named) names.emplace(name, parse_to_ginac(expression, names));

  const ex value = parse_to_ginac(text, names);
  const ex rate = value.diff(t);
  if (nodes(rate, kMostNodes) >= kMostNodes) throw TooLong();
  const ex acceleration = rate.diff(t);

  Compiler compiler(t);
  std::array<int, 3> results{};
  const std::array<ex, 3> wanted = {value, rate, acceleration};
  for (int k = 0; k < 3; ++k) {
    results[k] = compiler.slot_of(wanted[k]);
    if (scale != 1.0) {
      const int factor = compiler.constant(scale);
      results[k] = compiler.push(Operation::multiply, results[k], factor);
    }
  }
  return std::make_shared<Tape>(std::move(compiler.entries), results);
}

CoordinateFunctionPtr compile_of_coordinate(const std::string& text) {
  constexpr std::size_t kMostNodes = 100000;
  const GiNaC::realsymbol t("t"), q("q");
  const ex value = parse_to_ginac(text, {{"t", t}, {"q", q}});
  const ex by_q = value.diff(q), by_t = value.diff(t);
  if (nodes(by_q, kMostNodes) + nodes(by_t, kMostNodes) >= kMostNodes) throw TooLong();
  const std::array<ex, 6> wanted = {value, by_q, by_t, by_q.diff(q), by_q.diff(t), by_t.diff(t)};
  Compiler compiler(t, q);
  std::array<int, 6> results{};
  for (std::size_t k = 0; k < wanted.size(); ++k) results[k] = compiler.slot_of(wanted[k]);
  auto tape = std::make_shared<CoordinateTape>(std::move(compiler.entries), results);
  if (!value.has(q) && !value.has(t)) return std::make_shared<ConstantLaw>(tape->at({}, 0.0).value);
  return tape;
}

// What compiles, with its faults as those of the text.
template <typename Compile>
auto compiled(const std::string& text, const char* expected, const Compile& compile) {
  const std::lock_guard<std::mutex> guard(ginac_lock());
  try {
    return compile();
  } catch (const ValueFault&) {
    throw;
  } catch (const TooLong&) {
    throw ValueFault(in_quotes(text) + ", which is too long when differentiated", "a shorter expression");
  } catch (const std::exception& error) {
    throw ValueFault(in_quotes(text) + " (" + error.what() + ")", expected);
  }
}

}  // namespace

TimeFunctionPtr parse_expression(const std::string& text, const NamedExpressions& named, double scale) {
  return compiled(text, "an expression of t that can be differentiated twice",
                  [&] { return compile(text, named, scale); });
}

CoordinateFunctionPtr parse_coordinate_function(const std::string& text) {
  return compiled(text, "an expression of q and t that can be differentiated twice",
                  [&] { return compile_of_coordinate(text); });
}

TimeFunctionPtr combination(std::vector<std::pair<double, TimeFunctionPtr>> parts) {
  return std::make_shared<Combination>(std::move(parts));
}

}  // namespace boresight
