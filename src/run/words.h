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

/// "; did you mean 'word'?", or nothing where no word is near to `wrong`.
std::string nearest(const std::string& wrong, const std::vector<std::string>& words);

}  // namespace monarch_flight
