#include "boresight_analyses/laws/law_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace boresight {
namespace law_table_test {

ClearanceParameters pin() {
  ClearanceParameters p;
  p.radial = 0.1e-3;
  p.journal_radius = 10e-3;
  p.sleeve_length = 30e-3;
  p.friction.coefficient = 0.03;
  return p;
}

TEST(LawTable, HasEveryLawWithTheRestitutionsItReturns) {
  const auto rows = normal_law_table(pin(), 1.0, 0.1);
  ASSERT_EQ(rows.size(), normal_laws().size());
  for (const NormalLawRow& row : rows) {
    ASSERT_EQ(row.returned.size(), asked_restitutions().size());
    EXPECT_GT(row.path.size(), 100u) << row.entry->name;
    if (row.entry->name == std::string("exact")) {
      EXPECT_EQ(row.good_from, 0.05);
    }
    if (row.entry->name == std::string("carvalho-martins")) {
      EXPECT_EQ(row.good_from, 0.2);  // 0.2116 for 0.2; 0.1289 for 0.1
    }
    if (row.entry->name == std::string("lee-wang")) {
      EXPECT_EQ(row.good_from, 0.99);
    }
    if (row.entry->name == std::string("kelvin-voigt")) {
      EXPECT_NEAR(row.returned.back(), 0.99, 1e-5);
      EXPECT_TRUE(std::isnan(row.returned.front()));
    }
  }
}

TEST(LawTable, LeavesOutTheLawsForCylindersWhereASleeveHasNoLength) {
  ClearanceParameters p = pin();
  p.sleeve_length = 0.0;
  for (const NormalLawRow& row : normal_law_table(p, 1.0, 0.1)) EXPECT_NE(row.entry->geometry, ContactGeometry::line);
}

TEST(LawTable, FrictionOfEveryLawComesToItsKineticCoefficient) {
  for (const FrictionLawRow& row : friction_law_table(pin().friction)) {
    const double kinetic = row.entry->kind == FrictionKind::none        ? 0.0
                           : row.entry->kind == FrictionKind::threlfall ? 0.03 * (1.0 - std::exp(-3.0))
                                                                        : 0.03;
    EXPECT_NEAR(row.force.back(), kinetic, 1e-6) << row.entry->name;
  }
}

}  // namespace law_table_test
}  // namespace boresight
