// The spectrum of a [[budget.contributor]] and what it goes through:
//
//   spectrum = { white = "0.04 arcsec^2/Hz", flicker = "0.1 arcsec^2/Hz", lower = "0.01 Hz" }     # one-sided; flicker at 1 Hz
//   spectrum = { table = { file = "jitter.csv", frequency = "f", density = "psd", unit = "arcsec^2/Hz" } }
//   through = [{ second_order = { frequency = "5 Hz", damping = 0.3 } }]                             # one after the other
#pragma once

#include <vector>

#include "boresight/io/cursor.hpp"
#include "boresight_analyses/budget/noise.hpp"

namespace boresight {

// The column of the CSV file that the table names under `file`; a fault is one of the table's `key`. Throws InputError.
std::vector<double> read_column(Cursor& table, const char* key, const std::string& column);
// Of the contributor's table; none without the key. Throws InputError.
std::vector<TransferFunction> read_through(Cursor& table, const std::string& key = "through");
// One after the other.
TransferFunction in_a_row(const std::vector<TransferFunction>& functions);

// In which unit values of a contributor are written: the index', or that of `of`, which `through` turns into the index.
class UnitOfInput {
 public:
  // inside: the contributor's table that may hold `of`. squared: a density. Throws InputError.
  UnitOfInput(Cursor& contributor, Cursor& inside, const std::string& si_unit, bool squared);
  SiUnit si() const { return {what_.c_str(), unit_.c_str(), example_.c_str()}; }

 private:
  std::string what_, unit_, example_;
};

// `si_unit`: of the index, "rad" or "m". Throws InputError, also where the variance has no bound.
Noise read_noise(Cursor& contributor, const std::string& si_unit);

}  // namespace boresight
