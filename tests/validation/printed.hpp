// Numbers that a publication prints or a closed form gives, held by a test and listed with what the program computes.
//
//   expect_printed("Bari test set, car axis", "x of the left wheel at 3 s [m]", "0.0493455784275402809", left.pose.p.x(), 1e-9);
//
// The expectation is EXPECT_NEAR's. Where the environment variable BORESIGHT_VALIDATION names a file, a line is added to it; table.py
// beside this file makes the table of tests/README.md of these lines.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace boresight::validation {

// count: how many printed numbers the line stands for; of more than one it gives the largest deviation alone.
inline void record(const std::string& file, const std::string& source, const std::string& quantity,
                   const std::string& printed, double ours, double deviation, double tolerance, int count) {
  const char* name = std::getenv("BORESIGHT_VALIDATION");
  if (name == nullptr) return;
  const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
  std::FILE* out = std::fopen(name, "a");
  ASSERT_NE(out, nullptr) << name;
  std::fprintf(out, "%s\t%s.%s\t%s\t%s\t%s\t%.17g\t%.17g\t%.17g\t%d\n", file.c_str(), test->test_suite_name(),
               test->name(), source.c_str(), quantity.c_str(), printed.c_str(), ours, deviation, tolerance, count);
  std::fclose(out);
}

// printed: word for word.
inline void expect_printed(const std::string& source, const std::string& quantity, const std::string& printed,
                           double ours, double tolerance, const char* file = __builtin_FILE()) {
  const double value = std::stod(printed);
  EXPECT_NEAR(ours, value, tolerance) << source << ": " << quantity;
  record(file, source, quantity, printed, ours, std::abs(ours - value), tolerance, 1);
}

// A printed table of numbers, of which the largest deviation is listed.
class PrintedTable {
 public:
  PrintedTable(std::string source, std::string quantity, double tolerance, const char* file = __builtin_FILE())
      : source_(std::move(source)), quantity_(std::move(quantity)), tolerance_(tolerance), file_(file) {}
  PrintedTable(const PrintedTable&) = delete;
  PrintedTable& operator=(const PrintedTable&) = delete;
  ~PrintedTable() { record(file_, source_, quantity_, "", 0.0, largest_, tolerance_, count_); }

  void expect(const std::string& where, double printed, double ours) {
    EXPECT_NEAR(ours, printed, tolerance_) << source_ << ": " << quantity_ << ", " << where;
    largest_ = std::max(largest_, std::abs(ours - printed));
    ++count_;
  }

 private:
  std::string source_, quantity_;
  double tolerance_, largest_ = 0.0;
  const char* file_;
  int count_ = 0;
};

}  // namespace boresight::validation
