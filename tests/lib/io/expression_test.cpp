// Expressions: values, exact derivatives, and what is refused before symbolic algebra can explode.
#include "boresight/io/expression.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <numbers>
#include <thread>

#include "boresight/keys/value_fault.hpp"

namespace boresight {
namespace expression_test {

constexpr double kPi = std::numbers::pi;

// Eighth-order central differences of a function's value.
TimeValue differences(const TimeFunction& f, double t, double h) {
  const double first[5] = {0, 4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
  const double second[5] = {-205.0 / 72, 8.0 / 5, -1.0 / 5, 8.0 / 315, -1.0 / 560};
  TimeValue d{f.at(t).value, 0.0, second[0] * f.at(t).value};
  for (int k = 1; k <= 4; ++k) {
    const double ahead = f.at(t + k * h).value, behind = f.at(t - k * h).value;
    d.rate += first[k] * (ahead - behind);
    d.acceleration += second[k] * (ahead + behind);
  }
  d.rate /= h;
  d.acceleration /= h * h;
  return d;
}

TEST(Expression, DerivativesAgreeWithDifferences) {
  for (const char* text : {"2*pi*sin(pi*t)",
                           "pi/6*sin(pi*t)",
                           "t",
                           "3",
                           "t^2",
                           "t^7 - 3*t^3",
                           "(1+t)^-3",
                           "1/(1+t^2)",
                           "sqrt(1+t)",
                           "(1+t)^1.7",
                           "2^t",
                           "(1+t)^t",
                           "pow(t+1, 2.5)",
                           "exp(-t)*cos(5*t)",
                           "log(2+t)",
                           "tan(t/2)",
                           "asin(t/3)",
                           "acos(t/3)",
                           "atan(2*t)",
                           "atan2(t, 1+t^2)",
                           "atan2(-1-t, t-3)",
                           "sinh(t)",
                           "cosh(t)",
                           "tanh(3*t)",
                           "abs(t-5)*t",
                           "sin(cos(sin(t)))",
                           "t*sin(t*sin(t*sin(t)))",
                           "-t^2",
                           "2^-t",
                           "1e-3*t + 1.5E2",
                           "(((t)))",
                           "sqrt(t^2+1)^3",
                           "0.1*sin(2*pi*2*t)/5"}) {
    const TimeFunctionPtr f = parse_expression(text);
    for (const double t : {0.21, 0.5, 0.83}) {
      const TimeValue exact = f->at(t), d = differences(*f, t, 2e-3);
      EXPECT_NEAR(exact.rate, d.rate, 1e-9 * (1 + std::abs(d.rate))) << text;
      EXPECT_NEAR(exact.acceleration, d.acceleration, 1e-6 * (1 + std::abs(d.acceleration))) << text;
    }
  }
}

TEST(Expression, ValuesAreThoseOfTheSameFormulaInC) {
  const std::pair<const char*, std::function<double(double)>> cases[] = {
      {"2*pi*sin(pi*t)", [](double t) { return 2 * kPi * std::sin(kPi * t); }},
      {"-t^2", [](double t) { return -(t * t); }},
      {"2^3^t", [](double t) { return std::pow(2, std::pow(3, t)); }},
      {"1 - 2 - t", [](double t) { return -1 - t; }},
      {"8/4/(1+t)", [](double t) { return 2 / (1 + t); }},
      {"atan2(t, -1)", [](double t) { return std::atan2(t, -1.0); }},
      {"abs(-t)", [](double t) { return t; }},
      {"2*-t", [](double t) { return -2 * t; }},
      {"exp(1)*log(10)*t", [](double t) { return std::exp(1) * std::log(10) * t; }}};
  for (const auto& [text, formula] : cases) {
    const TimeFunctionPtr f = parse_expression(text);
    for (const double t : {0.1, 0.7, 1.3})
      EXPECT_NEAR(f->at(t).value, formula(t), 1e-14 * (1 + std::abs(formula(t)))) << text;
  }
}

TEST(Expression, ThePosesOwnNamesMayBeUsedAndScaleTheWhole) {
  const NamedExpressions angles = {{"psi", "2*pi*sin(pi*t)"}, {"theta", "pi/6*sin(pi*t)"}, {"phi", "-psi"}};
  const TimeFunctionPtr x = parse_expression("500*sin(theta)*cos(psi) + 0*phi", angles, 1e-3);
  const double t = 0.37, psi = 2 * kPi * std::sin(kPi * t), theta = kPi / 6 * std::sin(kPi * t);
  EXPECT_NEAR(x->at(t).value, 0.5 * std::sin(theta) * std::cos(psi), 1e-15);
  const TimeValue d = differences(*x, t, 2e-3);
  EXPECT_NEAR(x->at(t).rate, d.rate, 1e-9);
  EXPECT_NEAR(x->at(t).acceleration, d.acceleration, 1e-6);
}

TEST(Expression, TheDerivativeOfAbsIsTheSign) {
  const TimeFunctionPtr f = parse_expression("abs(t - 0.5)");
  EXPECT_EQ(f->at(0.25).rate, -1.0);
  EXPECT_EQ(f->at(0.75).rate, 1.0);
  EXPECT_EQ(f->at(0.5).rate, 0.0);
  EXPECT_EQ(f->at(0.75).acceleration, 0.0);
}

TEST(Expression, UnknownNamesAreNamedWithTheNearest) {
  const auto fault_of = [](const char* text, const NamedExpressions& named) {
    try {
      parse_expression(text, named);
    } catch (const ValueFault& fault) {
      return fault;
    }
    return ValueFault("", "");
  };
  EXPECT_EQ(fault_of("2*sni(t)", {}).nearest, "sin");
  EXPECT_EQ(fault_of("2*sni(t)", {}).found, "the unknown name \"sni\" in \"2*sni(t)\"");
  EXPECT_EQ(fault_of("2*sni(t)", {}).expected, "t, pi or a function such as sin");
  EXPECT_EQ(fault_of("sin(thta)", {{"theta", "t"}}).nearest, "theta");
  EXPECT_EQ(fault_of("sin t", {}).found, "\"t\" in \"sin t\"");
  EXPECT_EQ(fault_of("(t", {}).found, "the end in \"(t\"");
  EXPECT_EQ(fault_of("t t", {}).expected, "an operator or the end of the expression");
}

TEST(Expression, RefusesWhatIsNotAnExpressionOfT) {
  for (const char* text : {"",       " ",        "+",          "t+",        "*t",         "(t",  "t)",       "sin",
                           "sin()",  "sin(t,t)", "atan2(t)",   "pow(t)",    "t t",        "2t",  "t;t",      "t=1",
                           "I*t",    "x",        "1e999",      "1..2",      "nan",        "inf", "sqrt(-1)", "log(0)",
                           "1/0",    "0^-1",     "t/0",        "(-8)^0.5",  "t,t",        "{t}", "[t]",      "t!",
                           "t == 1", "\xff",     "exp(1e300)", "tan(pi/2)", "asin(2.5)*t"}) {
    bool refused = false;
    try {
      const TimeFunctionPtr f = parse_expression(text);
      refused = first_time_not_finite(*f, 1.0) >= 0.0;
    } catch (const ValueFault&) {
      refused = true;
    }
    EXPECT_TRUE(refused) << text << " is " << parse_expression(text)->at(0.0).value;
  }
}

TEST(Expression, RefusesQuicklyWhatWouldExplode) {
  std::string deep, signs(3000, '-'), product = "t", squares = "t", powers = "t", nested = "t", sums = "t";
  for (int k = 0; k < 1000; ++k) deep += "(";
  for (int k = 0; k < 300; ++k) product += "*sin(" + std::to_string(k) + "*t)";
  for (int k = 0; k < 30; ++k) squares = "(" + squares + "+1)^2";
  for (int k = 0; k < 30; ++k) powers = "(2*" + powers + ")^64";
  for (int k = 0; k < 38; ++k) nested = "t*sin(t*" + nested + ")^3*cos(t)";
  for (int k = 0; k < 400; ++k) sums += "+t^" + std::to_string(k % 60);
  const std::string cases[] = {"9^9^9^9",
                               "9^9^9^9*t",
                               "t^9^9",
                               "(9*t)^999999999",
                               "(9*t)^64^2",
                               "((9*t)^60)^60",
                               "2^(2^(2^(2^(2^2))))",
                               "t^1e9",
                               "10^(10^10)*t",
                               "pow(pow(9,9),pow(9,9))",
                               "(2*t+4)^1e6",
                               "exp(exp(exp(exp(t*100))))",
                               deep,
                               signs + "t",
                               product,
                               squares,
                               powers,
                               nested,
                               sums,
                               std::string(1000000, '('),
                               std::string(100000, '1'),
                               "1e-99999999",
                               "(1+t)^64*(1+t)^64*(1+t)^64",
                               "(t^64)*(t^64)",
                               "1e300*1e300*t",
                               "(1/3)^64^64",
                               "(123456789*t)^64*(987654321*t)^64"};
  for (const std::string& text : cases) {
    const auto begin = std::chrono::steady_clock::now();
    try {
      parse_expression(text);
    } catch (const ValueFault& fault) {
      EXPECT_FALSE(fault.found.empty());
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    EXPECT_LT(seconds, 1.0) << text.substr(0, 60);
  }
  for (const char* text : {"9^9^9^9", "(9*t)^999999999", "t^9^9", "((9*t)^60)^60", "(t^64)*(t^64)"}) {
    EXPECT_THROW(parse_expression(text), ValueFault) << text;
  }
}

TEST(Expression, NamesTheTimeAtWhichItIsNotFinite) {
  EXPECT_EQ(first_time_not_finite(*parse_expression("1/(t-0.5)"), 1.0), 0.5);
  EXPECT_EQ(first_time_not_finite(*parse_expression("sqrt(t)"), 1.0), 0.0);  // its rate is infinite
  EXPECT_EQ(first_time_not_finite(*parse_expression("sqrt(1+t)"), 1.0), -1.0);
}

TEST(Expression, NamesTheTimeAtWhichItOrItsRateJumps) {
  const auto jump = [](const char* text, double duration) { return first_jump(*parse_expression(text), duration); };
  EXPECT_NEAR(jump("abs(t-0.1)", 0.2), 0.1, 1e-9);  // at one of the times that are looked at
  EXPECT_NEAR(jump("0.5*abs(t-0.0512345)", 0.2), 0.0512345, 1e-9);
  EXPECT_NEAR(jump("asin(sin(20*t))", 0.2), std::acos(-1.0) / 40.0, 1e-9);
  EXPECT_NEAR(jump("sqrt(abs(t-0.0512345))", 0.2), 0.0512345, 1e-9);
  EXPECT_NEAR(jump("atan(1/(t-0.0512345))", 0.2), 0.0512345, 1e-9);  // its rate does not
  EXPECT_NEAR(jump("t+1e-3*abs(t-0.7)", 1.0), 0.7, 1e-9);
  for (const char* smooth : {"0", "1", "t", "0.3*sin(2*pi*40*t)", "sin(1e5*t)", "t^5", "abs(t-0.1)^3", "exp(-40*t)",
                             "0.1*tanh(1e6*(t-0.0512345))", "sqrt((t-0.1)^2+1e-8)", "1e6+t^2", "2*pi*1000*t"})
    EXPECT_EQ(jump(smooth, 1.0), -1.0) << smooth;
}

TEST(Expression, MayBeParsedAndEvaluatedFromManyThreads) {
  const TimeFunctionPtr shared = parse_expression("sin(3*t)*exp(-t)");
  std::vector<std::thread> threads;
  std::vector<int> wrong(4, 0);
  for (int k = 0; k < 4; ++k) {
    threads.emplace_back([&, k] {
      for (int i = 0; i < 50; ++i) {
        const TimeFunctionPtr own = parse_expression("sin(3*t)*exp(-t)");
        const double t = 0.01 * i;
        wrong[k] += own->at(t).acceleration != shared->at(t).acceleration;
      }
    });
  }
  for (auto& thread : threads) thread.join();
  for (const int count : wrong) EXPECT_EQ(count, 0);
}

TEST(Expression, ACombinationAddsItsPartsWithTheirFactors) {
  const TimeFunctionPtr f = combination({{2.0, parse_expression("t^2")}, {-1.0, parse_expression("sin(t)")}});
  EXPECT_DOUBLE_EQ(f->at(0.5).value, 0.5 - std::sin(0.5));
  EXPECT_DOUBLE_EQ(f->at(0.5).rate, 2.0 - std::cos(0.5));
  EXPECT_DOUBLE_EQ(f->at(0.5).acceleration, 4.0 + std::sin(0.5));
}

}  // namespace expression_test
}  // namespace boresight
