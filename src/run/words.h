#pragma once
#include <string>
#include <vector>

namespace monarch_flight {

/// "a, b, c", for messages.
inline std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace monarch_flight
