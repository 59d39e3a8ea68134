// What standing errors change of the loads on the coordinates, to first order: columns of dr over time, one per error.
//
// An error leaves the loads what they were but for its own small share of them, with one exception: where nothing pushes a journal, the
// error's tilt or its drive's ripple does, and the journal goes to the end of its play. A column is r of the mechanism built with a little
// of one error, its joints closed exactly, less r of the drawn one, divided by that little. Each has a grid of its own: the ripple of a
// screw needs a fine one, a length does not; and so has each set of masses, by itself, whichever were asked for before. Masses and gravity enter r by parts (riding_masses.hpp), which are kept: another payload asks
// for no new columns.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "boresight/math/time_table.hpp"
#include "boresight/mechanism/offset_choice.hpp"
#include "boresight/scene/standing_errors.hpp"

namespace boresight {

class StandingLoads {
 public:
  // commanded: the motion of this drawn mechanism; both outlive this.
  StandingLoads(const Mechanism& drawn, const IdealMotion& commanded);
  ~StandingLoads();
  // Between the knots a column is kept to this share of its largest value, or of a thousandth of the largest load.
  static constexpr double kAccuracy = 1e-3;

  // dr of one sample at equal distances from 0 to the end of the motion.
  struct Change {
    double spacing = 0.0;        // [s]
    std::vector<double> values;  // knots x n, row by row; empty: nothing changes
    // n functions, or none.
    TimeTable table(int n) const { return values.empty() ? TimeTable() : TimeTable(spacing, n, values); }
  };
  // Safe to share between threads. All parameters asked for have their bodies' centres of mass in the same places. Throws
  // ComputationError where a built mechanism's joints do not close, or where a column ripples too fast for a table.
  Change change(const Parameters& parameters, const StandingErrors& influence) const;

 private:
  class Instants;  // a mechanism at instants
  struct Parts;    // of one column at the knots that samples have needed so far
  // Columns for one set of masses, gravity and springs.
  struct Columns {
    Parameters of;
    struct Column {
      int cells = 0;
      VecX values;  // knots x n, per unit of the error
    };
    std::map<std::size_t, Column> of_error;
  };

  std::shared_ptr<const Columns> columns(const Parameters& parameters, const StandingErrors& influence) const;
  Parts& parts(std::size_t error, const Parameters& parameters, const StandingErrors& influence) const;
  double time_of(int knot, int cells) const;
  VecX change_at(Parts& of, double t) const;
  void halve(Parts& of) const;
  Columns::Column column(std::size_t error, Parts& of, const Parameters& parameters) const;
  VecX assembled(const VecX& parts, const Parameters& parameters) const;
  double size_of(std::size_t error, const StandingErrors& influence) const;

  const Mechanism& mechanism_;
  std::shared_ptr<const IdealMotion> commanded_;  // refers to what outlives this
  std::shared_ptr<const Mechanism> as_drawn_;     // without errors, told what the built ones are told
  OffsetChoice choice_;
  VecX unit_;  // of each coordinate's load: 1, of a slope's the characteristic length
  mutable std::mutex mutex_;
  mutable Parameters parts_of_;
  mutable std::map<std::size_t, Parts> parts_;
  mutable std::unique_ptr<Instants> drawn_;
  mutable std::shared_ptr<const Columns> columns_;
};

}  // namespace boresight
