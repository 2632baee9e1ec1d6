#include "monarch_flight/coupling/settings.h"

#include <cmath>
#include <sstream>

namespace monarch_flight {
namespace {

/// "coupling/key = value: must be <bound>; <remedy>".
template <typename T>
std::string fault(const char* key, T value, const std::string& bound, const char* remedy) {
  std::ostringstream text;
  text << "coupling/" << key << " = " << value << ": must be " << bound << "; " << remedy;
  return text.str();
}

bool positive(double value) { return std::isfinite(value) && value > 0.0; }

}  // namespace

std::vector<std::string> CouplingSettings::problems() const {
  std::vector<std::string> faults;
  if (!(positive(omega_initial) && omega_initial <= 1.0)) {
    faults.push_back(fault("omega_initial", omega_initial, "in (0, 1]", "0.5 is a good start"));
  }
  if (!(positive(omega_min) && omega_min <= 1.0)) {
    faults.push_back(fault("omega_min", omega_min, "in (0, 1]", "0.05 is usual"));
  }
  if (!(positive(omega_max) && omega_max <= 2.0)) {
    faults.push_back(fault("omega_max", omega_max, "in (0, 2]", "1.5 is usual"));
  }
  if (omega_min > omega_max) {
    faults.push_back(fault("omega_min", omega_min, "at most omega_max", "exchange the two bounds"));
  }
  if (reuse_steps < 0 || reuse_steps > 20) {
    faults.push_back(fault("reuse_steps", reuse_steps, "in 0 to 20", "4 is a good start"));
  }
  if (operator_every < 1) {
    faults.push_back(fault("operator_every", operator_every, "at least 1", "250 is usual"));
  }
  if (!(positive(tolerance) && tolerance < 1.0)) {
    faults.push_back(fault("tolerance", tolerance, "in (0, 1)", "the published value is 1e-8"));
  }
  if (!(positive(load_tolerance) && load_tolerance < 1.0)) {
    faults.push_back(fault("load_tolerance", load_tolerance, "in (0, 1)", "1e-6 is usual"));
  }
  if (max_sub_iterations < 2) {
    faults.push_back(fault("max_sub_iterations", max_sub_iterations, "at least 2", "60 is usual"));
  }
  if (prescribed_steps < 0) {
    faults.push_back(
        fault("prescribed_steps", prescribed_steps, "at least 0", "the published value is 10"));
  }
  if (!positive(length_scale)) {
    faults.push_back(fault("length_scale", length_scale, "above 0 m", "use the wing's mean chord"));
  }
  if (pictures.surface_every < 0 || pictures.flow_every < 0 || pictures.fields_every < 0) {
    faults.push_back("pictures: steps between them must be at least 0 (0: never)");
  }
  if (pictures.flow_every > 0 && pictures.flow_points < 8)
    faults.push_back(
        fault("pictures.flow_points", pictures.flow_points, "at least 8", "40000 is usual"));
  return faults;
}

}  // namespace monarch_flight
