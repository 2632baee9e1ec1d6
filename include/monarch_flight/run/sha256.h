#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace monarch_flight {

/// SHA-256 of bytes that come piece by piece. Between two pieces it can be written down and taken
/// up again.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  void add(const void* bytes, std::size_t size);
  /// Of everything added so far, lower-case hex. More may be added afterwards.
  std::string hex() const;
  /// Where it stands, to go on elsewhere with the same program.
  std::vector<char> state() const;
  /// Throws std::invalid_argument when these bytes are no state.
  void setState(const std::vector<char>& state);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Of a whole text, 64 hexadecimal digits.
std::string sha256Hex(std::string_view text);

}  // namespace monarch_flight
