#include "monarch_flight/fields/field_output.h"
#include "monarch_flight/fields/iso_surface.h"
#include "monarch_flight/math/errors.h"

namespace monarch_flight {

std::unique_ptr<StepSink> makeFieldOutput(const Case& c, const std::string&, StateVisitor*) {
  throw InputError("output/fields_every = " + std::to_string(c.output.fields_every) +
                   ": this build has no VTK, which writes the fields; must be 0, or run "
                   "scripts/install fields and build again");
}

bool hasIsoSurfaces() { return false; }

IsoSurface isoSurface(const FlowPicture&, double, std::size_t) { return {}; }

}  // namespace monarch_flight
