#include "boresight_analyses/budget/quadrature.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include <memory>

namespace boresight {
namespace {

constexpr std::size_t kIntervals = 400;
constexpr double kRelative = 1e-10;

// GSL ends the program where rounding keeps it from the tolerance; here the result it has reached stands.
class QuietErrors {
 public:
  QuietErrors() : before_(gsl_set_error_handler_off()) {}
  ~QuietErrors() { gsl_set_error_handler(before_); }
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;

 private:
  gsl_error_handler_t* before_;
};

using Workspace = std::unique_ptr<gsl_integration_workspace, decltype(&gsl_integration_workspace_free)>;
using Oscillation = std::unique_ptr<gsl_integration_qawo_table, decltype(&gsl_integration_qawo_table_free)>;

Workspace workspace() { return {gsl_integration_workspace_alloc(kIntervals), &gsl_integration_workspace_free}; }

gsl_function function_of(const Integrand& f) {
  return {[](double x, void* of) { return (*static_cast<const Integrand*>(of))(x); }, const_cast<Integrand*>(&f)};
}

}  // namespace

double integral(const Integrand& f, double from, double to) {
  const QuietErrors quiet;
  gsl_function function = function_of(f);
  double result = 0.0, error = 0.0;
  gsl_integration_qags(&function, from, to, 0.0, kRelative, kIntervals, workspace().get(), &result, &error);
  return result;
}

double integral_to_infinity(const Integrand& f, double from) {
  const QuietErrors quiet;
  gsl_function function = function_of(f);
  double result = 0.0, error = 0.0;
  gsl_integration_qagiu(&function, from, 0.0, kRelative, kIntervals, workspace().get(), &result, &error);
  return result;
}

double cosine_integral(const Integrand& f, double rate, double from, double to) {
  if (rate == 0.0) return integral(f, from, to);
  const QuietErrors quiet;
  gsl_function function = function_of(f);
  constexpr std::size_t kBisections = 30;
  const Oscillation oscillation(gsl_integration_qawo_table_alloc(rate, to - from, GSL_INTEG_COSINE, kBisections),
                                &gsl_integration_qawo_table_free);
  // What turns much cancels: relative to the integral without turning is near enough.
  const double whole = integral(f, from, to);
  double result = 0.0, error = 0.0;
  gsl_integration_qawo(&function, from, kRelative * (whole < 0.0 ? -whole : whole), 0.0, kIntervals, workspace().get(),
                       oscillation.get(), &result, &error);
  return result;
}

}  // namespace boresight
