#pragma once
#include <memory>
#include <vector>

#include "monarch_flight/insect/numeric_table.h"
#include "monarch_flight/insect/prescribed_motion.h"

namespace monarch_flight {

class SmoothSpline;

/// What a motion table holds.
enum class TableKind {
  /// t, x, y, z (wing root, NED [m]), qw, qx, qy, qz (wing axes to NED). For a bare wing: the body
  /// frame
  /// is the wing's root frame, so the table's attitude is R_IB, and all joint angles are zero.
  kWing,
  /// t, x, y, z (body's mass centre, NED [m]), theta_B, phi, psi, theta_R, theta_A [rad].
  kBody
};

/// Motion by a table of samples. Positions and angles are quintic splines (C4); attitudes are the
/// normalised quintic spline of the quaternion's components with continuous signs, differentiated
/// exactly: velocity and acceleration are the derivatives of the position and attitude given.
/// Angles are continuous, too: from row to row the shorter way round (at most pi).
class TableMotion : public PrescribedMotion {
 public:
  /// `table` must hold the columns of `kind`, further ones are ignored. Throws InputError naming
  /// table, row and column of every fault: fewer than 6 rows, time that does not increase, a gap (a
  /// spacing above 1.5 times the median), quaternions off unit length by more than 1e-4, turns of
  /// more than 90 degrees from row to row, changes from row to row that those around them do not
  /// lead to (docs/case_files.md, motion). `length` [m]: changes of position below a hundredth of
  /// it, and of angles below 0.01 rad, are taken for rounding.
  TableMotion(const NumericTable& table, TableKind kind, double length);
  ~TableMotion() override;
  PrescribedState at(double t) const override;

  /// Names of the columns of a kind, in the order given above.
  static const std::vector<std::string>& columnsOf(TableKind kind);
  double tBegin() const { return t_begin_; }  ///< [s]
  double tEnd() const { return t_end_; }      ///< [s]

 private:
  TableKind kind_;
  double t_begin_ = 0.0, t_end_ = 0.0;
  std::unique_ptr<const SmoothSpline> spline_;
};

}  // namespace monarch_flight
