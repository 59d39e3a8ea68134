// Integrals over frequency by GSL's adaptive rules (Piessens, de Doncker-Kapenga, Ueberhuber, Kahaner 1983, QUADPACK).
#pragma once

#include <cstddef>
#include <functional>

namespace boresight {

using Integrand = std::function<double(double)>;

// To 1e-10 of the result, or as near as rounding allows. `f` is smooth between the limits, but may grow without bound at either.
double integral(const Integrand& f, double from, double to);
double integral_to_infinity(const Integrand& f, double from);
// Of f(x) cos(rate x), however often it turns.
double cosine_integral(const Integrand& f, double rate, double from, double to);

}  // namespace boresight
