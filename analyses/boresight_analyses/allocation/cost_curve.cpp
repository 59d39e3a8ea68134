#include "boresight_analyses/allocation/cost_curve.hpp"

#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace boresight {

double CostCurve::price(double t) const {
  return law == Law::exponential ? a * std::exp(-b * t) : a + b / std::pow(t, exponent);
}

double CostCurve::slope(double t) const {
  return law == Law::exponential ? -a * b * std::exp(-b * t) : -exponent * b / std::pow(t, exponent + 1.0);
}

double CostCurve::above(double t, double than) const {
  return law == Law::exponential ? a * (std::exp(-b * t) - std::exp(-b * than))
                                 : b / std::pow(t, exponent) - b / std::pow(than, exponent);
}

std::string CostCurve::text() const {
  char text[120];
  if (law == Law::exponential)
    std::snprintf(text, sizeof text, "%.6g exp(-%.6g t)", a, b);
  else
    std::snprintf(text, sizeof text, "%.6g + %.6g / t^%.6g", a, b, exponent);
  return text;
}

std::vector<std::string> cost_law_names() {
  return {"reciprocal", "reciprocal-squared", "reciprocal-power", "exponential"};
}

CostCurve make_cost_curve(const std::string& law, double a, double b, double exponent, double metres) {
  if (law == "exponential") return {CostCurve::Law::exponential, a, b / metres, 1.0};
  double k = exponent;
  if (law == "reciprocal") k = 1.0;
  if (law == "reciprocal-squared") k = 2.0;
  if (law != "reciprocal" && law != "reciprocal-squared" && law != "reciprocal-power")
    throw std::invalid_argument("no cost law " + law);
  return {CostCurve::Law::reciprocal, a, b * std::pow(metres, k), k};
}

}  // namespace boresight
