#include "monarch_flight/math/errors.h"

namespace monarch_flight {
namespace {

std::string oneALine(const std::vector<std::string>& faults) {
  std::string text;
  for (const std::string& fault : faults) {
    if (!text.empty()) text += '\n';
    text += fault;
  }
  return text;
}

}  // namespace

InputError::InputError(const std::vector<std::string>& faults)
    : std::runtime_error(oneALine(faults)) {}

}  // namespace monarch_flight
