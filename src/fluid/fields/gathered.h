#pragma once
#include <cstring>
#include <vector>

#include "fluid/fields/slab.h"

namespace monarch_flight::fluid {

/// The items of all processes on process 0, bottom first; elsewhere none.
template <class T>
std::vector<T> gathered(const Slab& slab, const std::vector<T>& mine) {
  if (slab.ranks() == 1) return mine;
  const char* begin = reinterpret_cast<const char*>(mine.data());
  const std::vector<char> all =
      slab.gather(std::vector<char>(begin, begin + mine.size() * sizeof(T)));
  std::vector<T> items(all.size() / sizeof(T));
  if (!all.empty()) std::memcpy(static_cast<void*>(items.data()), all.data(), all.size());
  return items;
}

}  // namespace monarch_flight::fluid
