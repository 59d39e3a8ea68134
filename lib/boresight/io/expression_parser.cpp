#include "boresight/io/expression_parser.hpp"

#include <charconv>
#include <cmath>
#include <vector>

#include "boresight/keys/units.hpp"
#include "boresight/keys/value_fault.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {

using GiNaC::ex;
using GiNaC::is_a;
using GiNaC::numeric;

static ex magnitude_derivative(const ex& x, unsigned) { return sign_of(x); }
static ex sign_derivative(const ex&, unsigned) { return 0; }
REGISTER_FUNCTION(magnitude, derivative_func(magnitude_derivative))
REGISTER_FUNCTION(sign_of, derivative_func(sign_derivative))

std::mutex& ginac_lock() {
  static std::mutex lock;
  return lock;
}

namespace {

constexpr std::size_t kLongestText = 4000;
constexpr int kDeepestBrackets = 40;
constexpr double kLargestExponent = 64.0;
constexpr std::size_t kMostFactors = 32;
constexpr int kMostBits = 512;  // of an exact integer; beyond it numbers are doubles

// `of_number` is used for doubles: CLN's own functions of very large doubles are wrong (exp(1e300) gives 1). Exact numbers stay
// symbolic and are evaluated by the tape.
struct FunctionEntry {
  const char* name;
  ex (*symbolic)(const ex&);
  double (*of_number)(double);
};

const std::vector<FunctionEntry>& functions() {
  static const std::vector<FunctionEntry> table = {
      {"sin", [](const ex& x) -> ex { return GiNaC::sin(x); }, [](double x) { return std::sin(x); }},
      {"cos", [](const ex& x) -> ex { return GiNaC::cos(x); }, [](double x) { return std::cos(x); }},
      {"tan", [](const ex& x) -> ex { return GiNaC::tan(x); }, [](double x) { return std::tan(x); }},
      {"asin", [](const ex& x) -> ex { return GiNaC::asin(x); }, [](double x) { return std::asin(x); }},
      {"acos", [](const ex& x) -> ex { return GiNaC::acos(x); }, [](double x) { return std::acos(x); }},
      {"atan", [](const ex& x) -> ex { return GiNaC::atan(x); }, [](double x) { return std::atan(x); }},
      {"sinh", [](const ex& x) -> ex { return GiNaC::sinh(x); }, [](double x) { return std::sinh(x); }},
      {"cosh", [](const ex& x) -> ex { return GiNaC::cosh(x); }, [](double x) { return std::cosh(x); }},
      {"tanh", [](const ex& x) -> ex { return GiNaC::tanh(x); }, [](double x) { return std::tanh(x); }},
      {"exp", [](const ex& x) -> ex { return GiNaC::exp(x); }, [](double x) { return std::exp(x); }},
      {"log", [](const ex& x) -> ex { return GiNaC::log(x); }, [](double x) { return std::log(x); }},
      {"abs", [](const ex& x) -> ex { return magnitude(x); }, [](double x) { return std::abs(x); }},
      {"sqrt", nullptr, nullptr},
  };
  return table;
}

bool is_inexact(const ex& value) { return is_a<numeric>(value) && !GiNaC::ex_to<numeric>(value).is_rational(); }

int bits(const ex& number) {
  const numeric& n = GiNaC::ex_to<numeric>(number);
  return n.is_rational() ? n.numer().int_length() + n.denom().int_length() : 0;
}

double as_double(const ex& number) { return GiNaC::ex_to<numeric>(number).to_double(); }

class Parser {
 public:
  Parser(const std::string& text, const std::map<std::string, ex>& names) : text_(text), names_(names) {}

  ex whole() {
    if (text_.size() > kLongestText) {
      throw ValueFault("an expression of " + std::to_string(text_.size()) + " characters",
                       "at most " + std::to_string(kLongestText));
    }
    const ex result = sum();
    skip_blanks();
    if (at_ < text_.size()) fault(rest(), "an operator or the end of the expression");
    return result;
  }

 private:
  [[noreturn]] void fault(const std::string& found, const std::string& expected,
                          const std::string& nearest = "") const {
    throw ValueFault(found + " in " + in_quotes(text_), expected, nearest);
  }
  std::string rest() const { return at_ < text_.size() ? in_quotes(text_.substr(at_, 12)) : "the end"; }
  void skip_blanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n' || text_[at_] == '\r'))
      ++at_;
  }
  bool take(char c) {
    skip_blanks();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  void go_deeper() {
    if (++depth_ > kDeepestBrackets)
      fault("brackets, signs or powers nested too deep", "at most " + std::to_string(kDeepestBrackets));
  }

  // Every number that GiNaC has computed must be real, finite as a double and of bounded size.
  ex bounded(const ex& value) const {
    if (!is_a<numeric>(value)) return value;
    const numeric& number = GiNaC::ex_to<numeric>(value);
    if (!number.is_real()) fault("a number that is not real", "a real expression of t");
    const double d = number.to_double();
    if (!std::isfinite(d)) fault("a number that is too large", "a finite expression of t");
    return bits(value) > kMostBits ? ex(numeric(d)) : value;
  }

  ex finite(double value) const {
    if (!std::isfinite(value)) fault("a number that is not finite", "a finite expression of t");
    return numeric(value);
  }

  ex sum() {
    go_deeper();
    ex result = product();
    for (;;) {
      if (take('+')) {
        result = bounded(result + product());
      } else if (take('-')) {
        result = bounded(result - product());
      } else {
        --depth_;
        return result;
      }
    }
  }

  ex product() {
    ex result = signed_power();
    for (;;) {
      if (take('*')) {
        result = times(result, signed_power());
      } else if (take('/')) {
        result = times(result, power(signed_power(), -1));
      } else {
        return result;
      }
    }
  }

  ex times(const ex& a, const ex& b) const {
    const ex result = bounded(a * b);
    if (is_a<GiNaC::mul>(result) && result.nops() > kMostFactors) {
      fault("a product of more than " + std::to_string(kMostFactors) + " factors", "fewer factors");
    }
    check_powers(result);
    return result;
  }

  ex signed_power() {
    if (take('-')) {
      go_deeper();
      const ex result = -signed_power();
      --depth_;
      return result;
    }
    if (take('+')) {
      go_deeper();
      const ex result = signed_power();
      --depth_;
      return result;
    }
    const ex base = primary();
    if (!take('^')) return base;
    go_deeper();
    const ex exponent = signed_power();
    --depth_;
    return power(base, exponent);
  }

  // Refuses what GiNaC would multiply out into astronomically large numbers or degrees.
  void check_powers(const ex& value) const {
    if (is_a<GiNaC::power>(value)) check_exponent(value.op(1), 1.0);
    if (is_a<GiNaC::mul>(value)) {
      for (std::size_t i = 0; i < value.nops(); ++i) {
        if (is_a<GiNaC::power>(value.op(i))) check_exponent(value.op(i).op(1), 1.0);
        if (is_a<numeric>(value.op(i)) && bits(value.op(i)) > kMostBits)
          fault("numbers that grow too large", "smaller numbers");
      }
    }
  }

  void check_exponent(const ex& exponent, double factor) const {
    if (is_a<numeric>(exponent) && !(std::abs(as_double(exponent) * factor) <= kLargestExponent)) {
      fault("an exponent beyond " + std::to_string(static_cast<int>(kLargestExponent)), "a smaller exponent");
    }
  }

  ex power(const ex& base, const ex& exponent) const {
    if (is_a<numeric>(base) && is_a<numeric>(exponent)) {
      const double value = std::pow(as_double(base), as_double(exponent));
      if (!std::isfinite(value)) fault("a power that is not a finite real number", "a finite expression of t");
      const double n = as_double(exponent);
      const bool exact =
          n == std::floor(n) && std::abs(n) * bits(base) <= kMostBits && GiNaC::ex_to<numeric>(base).is_rational();
      return exact ? bounded(GiNaC::pow(base, exponent)) : bounded(numeric(value));
    }
    if (is_a<numeric>(exponent)) {
      const double n = as_double(exponent);
      check_exponent(exponent, 1.0);
      const auto check_part = [&](const ex& part) {
        if (is_a<GiNaC::power>(part)) check_exponent(part.op(1), n);
        if (is_a<numeric>(part) && bits(part) * std::abs(n) > kMostBits)
          fault("numbers that grow too large", "smaller numbers");
      };
      check_part(base);
      // A sum's common factor is taken out of the power as well.
      if (is_a<GiNaC::mul>(base) || is_a<GiNaC::add>(base)) {
        for (std::size_t i = 0; i < base.nops(); ++i) {
          const ex part = base.op(i);
          check_part(part);
          if (is_a<GiNaC::mul>(part)) {
            for (std::size_t j = 0; j < part.nops(); ++j) check_part(part.op(j));
          }
        }
      }
    }
    const ex result = bounded(GiNaC::pow(base, exponent));
    check_powers(result);
    return result;
  }

  ex primary() {
    skip_blanks();
    if (at_ >= text_.size()) fault("the end", "a number, a name or a bracket");
    const char c = text_[at_];
    if (c == '(') {
      ++at_;
      const ex inside = sum();
      if (!take(')')) fault(rest(), "a closing bracket");
      return inside;
    }
    if ((c >= '0' && c <= '9') || c == '.') return literal();
    if ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_') return name();
    fault(rest(), "a number, a name or a bracket");
  }

  // Short decimal numbers are kept exact (0.5 is 1/2), so that GiNaC can simplify; others are doubles.
  ex literal() {
    double value = 0.0;
    const char* begin = text_.data() + at_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
    if (error != std::errc() || !std::isfinite(value)) fault(rest(), "a finite number");
    at_ += static_cast<std::size_t>(end - begin);
    double scaled = value;
    long denominator = 1;
    for (; denominator <= 1000000; denominator *= 10, scaled = value * static_cast<double>(denominator)) {
      if (std::abs(scaled) > 1e9) break;
      if (scaled == std::floor(scaled) && scaled / static_cast<double>(denominator) == value) {
        return numeric(static_cast<long>(scaled), denominator);
      }
    }
    return numeric(value);
  }

  ex name() {
    const std::size_t begin = at_;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (!((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_')) break;
      ++at_;
    }
    const std::string word = text_.substr(begin, at_ - begin);
    if (const auto it = names_.find(word); it != names_.end()) return it->second;
    if (word == "pi") return GiNaC::Pi;
    if (word == "pow" || word == "atan2") {
      const std::vector<ex> inside = arguments(word, 2);
      if (word == "pow") return power(inside[0], inside[1]);
      if (is_a<numeric>(inside[0]) && is_a<numeric>(inside[1])) {
        return numeric(std::atan2(as_double(inside[0]), as_double(inside[1])));
      }
      return bounded(GiNaC::atan2(inside[0], inside[1]));
    }
    for (const FunctionEntry& entry : functions()) {
      if (word != entry.name) continue;
      const ex inside = arguments(word, 1)[0];
      if (entry.symbolic == nullptr) return power(inside, numeric(1, 2));
      if (is_inexact(inside)) return finite(entry.of_number(as_double(inside)));
      return bounded(entry.symbolic(inside));
    }
    std::vector<std::string> known;
    for (const FunctionEntry& entry : functions()) known.push_back(entry.name);
    std::string list;
    for (const auto& entry : names_) {
      known.push_back(entry.first);
      list += entry.first + ", ";
    }
    known.insert(known.end(), {"pow", "atan2", "pi"});
    fault("the unknown name " + in_quotes(word), list + "pi or a function such as sin", nearest_name(word, known));
  }

  std::vector<ex> arguments(const std::string& word, std::size_t count) {
    if (!take('(')) fault(rest(), "an opening bracket after " + word);
    std::vector<ex> values = {sum()};
    while (take(',')) values.push_back(sum());
    if (!take(')')) fault(rest(), "a closing bracket");
    if (values.size() != count) {
      fault(word + " of " + std::to_string(values.size()) + " arguments", word + " of " + std::to_string(count));
    }
    return values;
  }

  const std::string& text_;
  const std::map<std::string, ex>& names_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

ex parse_to_ginac(const std::string& text, const std::map<std::string, ex>& names) {
  try {
    return Parser(text, names).whole();
  } catch (const ValueFault&) {
    throw;
  } catch (const std::exception& error) {  // GiNaC: a pole, CLN: an overflow
    throw ValueFault(in_quotes(text) + " (" + error.what() + ")", "an expression of t that has a value");
  }
}

}  // namespace boresight
