#include "monarch_flight/coupling/state_visitor.h"

#include <algorithm>
#include <stdexcept>

#include "monarch_flight/coupling/interface_values.h"

namespace monarch_flight {

void StateVisitor::operator()(const char* name, Interface& interface) {
  InterfaceValues values = interfaceValues(interface);
  (*this)(name, values);
  if (loading()) interface = interfaceOf(values);
}

void StateVisitor::operator()(const char* name, PrescribedState& prescribed) {
  PrescribedValues values = prescribedValues(prescribed);
  (*this)(name, values);
  if (loading()) prescribed = prescribedOf(values);
}

void StateVisitor::operator()(const char* name, Loads& loads) {
  Eigen::Matrix<double, 12, 1> values;
  values << loads.force_pressure, loads.force_friction, loads.moment_pressure,
      loads.moment_friction;
  (*this)(name, values);
  if (!loading()) return;
  loads = {values.segment<3>(0), values.segment<3>(3), values.segment<3>(6), values.segment<3>(9)};
}

void StateSnapshot::Pass::numbers(const char* name, double* values, std::size_t count) {
  if (!loading_) {
    numbers_.insert(numbers_.end(), values, values + count);
    return;
  }
  if (count > numbers_.size() - at_)
    throw std::logic_error(std::string("snapshot: no numbers left for ") + name);
  std::copy_n(numbers_.begin() + static_cast<std::ptrdiff_t>(at_), count, values);
  at_ += count;
}

void StateSnapshot::Pass::bytes(const char* name, std::vector<char>&) {
  throw std::logic_error(std::string("snapshot: holds no bytes, so not ") + name);
}

}  // namespace monarch_flight
