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
