#pragma once
#include <vector>

#include "verify/report.h"

namespace monarch_flight::verify {

/// A comparison of the flow solver with something known.
struct Subject {
  const char* name;
  bool quick;  ///< seconds to a few minutes; the others take hours
  void (*run)(Report&);
};

void directSolve(Report&);
void addedMass(Report&);
void uniformStream(Report&);
void affine(Report&);
void taylorGreen(Report&);
void stokes(Report&);
void blasius(Report&);
void plateRe100(Report&);
void momentumBalance(Report&);
void rim(Report&);
void stability(Report&);
void monarchFlap(Report&);
void outerBoundary(Report&);
void discDrag(Report&);
void pitchingRolling(Report&);
void revolvingWing(Report&);

}  // namespace monarch_flight::verify
