// What a linear system makes of what enters it: a ratio of polynomials in s, such as a pointing loop between a sensor and the boresight.
//
//     H(s) = (b_0 + b_1 s + .. + b_m s^m) / (a_0 + a_1 s + .. + a_n s^n),      stationary noise: S_out(f) = |H(i 2 pi f)|^2 S_in(f)
//
// Source: Franklin, Powell, Emami-Naeini (2010), Feedback Control of Dynamic Systems, 3.1, 6.1; Bendat and Piersol (2010), eq. 6.8.
#pragma once

#include <complex>
#include <string>
#include <vector>

namespace boresight {

class TransferFunction {
 public:
  // Coefficients by rising powers of s. Throws std::invalid_argument: a denominator of zeros, or more powers above than below.
  TransferFunction(std::vector<double> numerator, std::vector<double> denominator);

  static TransferFunction first_order(double bandwidth);                   // 1 / (1 + s / w), w = 2 pi bandwidth [Hz]
  static TransferFunction second_order(double frequency, double damping);  // wn^2 / (s^2 + 2 zeta wn s + wn^2) [Hz]
  static TransferFunction sensitivity(double frequency, double damping);   // 1 less that
  // Of the open loop L: what a disturbance at its output becomes, 1 / (1 + L), and what a sensor's error becomes, L / (1 + L).
  TransferFunction closed_on_disturbance() const;
  TransferFunction closed_on_sensor() const;
  TransferFunction operator*(const TransferFunction& second) const;

  std::complex<double> at(double f) const;  // [Hz]
  double power(double f) const { return std::norm(at(f)); }
  double standing() const;     // H(0)
  double at_infinity() const;  // towards which H goes with the frequency
  double slope() const;        // dH/ds at s = 0: what a ramp of 1/s is behind, once settled [s]
  // e of |H| ~ f^e towards zero and towards infinity.
  int order_at_zero() const;
  int order_at_infinity() const { return static_cast<int>(numerator_.size()) - static_cast<int>(denominator_.size()); }
  std::vector<std::complex<double>> poles() const;
  bool is_stable() const;               // every pole has a negative real part
  std::vector<double> corners() const;  // sizes of its poles and zeros but those at zero [Hz]
  const std::vector<double>& numerator() const { return numerator_; }
  const std::vector<double>& denominator() const { return denominator_; }
  std::string text() const;  // equal texts are equal functions

 private:
  std::vector<double> numerator_, denominator_;  // without zeros at the upper end
};

}  // namespace boresight
