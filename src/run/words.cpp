#include "run/words.h"

#include <algorithm>
#include <numeric>

namespace monarch_flight {
namespace {

/// Letters to insert, remove or replace (Levenshtein).
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string nearest(const std::string& wrong, const std::vector<std::string>& words) {
  const auto far = [&wrong](const std::string& a, const std::string& b) {
    return distance(wrong, a) < distance(wrong, b);
  };
  const auto best = std::min_element(words.begin(), words.end(), far);
  if (best == words.end() || 3 * distance(wrong, *best) > std::max(wrong.size(), best->size()))
    return "";
  return "; did you mean '" + *best + "'?";
}

}  // namespace monarch_flight
