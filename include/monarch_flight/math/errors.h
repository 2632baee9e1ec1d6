#pragma once
#include <stdexcept>
#include <string>
#include <vector>

namespace monarch_flight {

/// The user's input is wrong: message says what, value, bound and remedy, one fault a line.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& what) : std::runtime_error(what) {}
  explicit InputError(const std::vector<std::string>& faults);
};

/// The numerics failed (non-finite value, limit exceeded): message says where.
class NumericalError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace monarch_flight
