#pragma once
#include <cstddef>
#include <cstring>

namespace monarch_flight::fluid::momentum {

constexpr int kLines = 8;  ///< lines along x that are solved together, one in each lane of a vector

namespace lanes {

using Eight = double __attribute__((vector_size(64)));

/// Transposes eight vectors in place.
inline void transpose(Eight (&v)[8]) {
  Eight t[8];
  for (int i = 0; i < 8; i += 2) {
    t[i] = __builtin_shufflevector(v[i], v[i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    t[i + 1] = __builtin_shufflevector(v[i], v[i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  for (int i = 0; i < 8; i += 4) {
    for (int j = i; j < i + 2; ++j) {
      v[j] = __builtin_shufflevector(t[j], t[j + 2], 0, 1, 8, 9, 4, 5, 12, 13);
      v[j + 2] = __builtin_shufflevector(t[j], t[j + 2], 2, 3, 10, 11, 6, 7, 14, 15);
    }
  }
  for (int j = 0; j < 4; ++j) {
    t[j] = __builtin_shufflevector(v[j], v[j + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    t[j + 4] = __builtin_shufflevector(v[j], v[j + 4], 4, 5, 6, 7, 12, 13, 14, 15);
  }
  for (int j = 0; j < 8; ++j) v[j] = t[j];
}

}  // namespace lanes

/// out[i * kLines + l] = rows[l * stride + i] for l < lines and i < n rounded up to a multiple of
/// eight; lanes without a line get 0.
inline void interleave(const double* rows, std::ptrdiff_t stride, int lines, int n, double* out) {
  lanes::Eight v[8] = {};
  for (int i = 0; i < n; i += 8) {
    if (lines == 8) {
      for (int l = 0; l < 8; ++l) std::memcpy(&v[l], rows + l * stride + i, sizeof v[l]);
    } else {
      for (int l = 0; l < 8; ++l) v[l] = lanes::Eight{};
      for (int l = 0; l < lines; ++l) std::memcpy(&v[l], rows + l * stride + i, sizeof v[l]);
    }
    lanes::transpose(v);
    for (int l = 0; l < 8; ++l) std::memcpy(out + (i + l) * kLines, &v[l], sizeof v[l]);
  }
}

/// The inverse: rows[l * stride + i] = in[i * kLines + l].
inline void separate(const double* in, int lines, int n, double* rows, std::ptrdiff_t stride) {
  lanes::Eight v[8];
  for (int i = 0; i < n; i += 8) {
    for (int l = 0; l < 8; ++l) std::memcpy(&v[l], in + (i + l) * kLines, sizeof v[l]);
    lanes::transpose(v);
    if (lines == 8) {
      for (int l = 0; l < 8; ++l) std::memcpy(rows + l * stride + i, &v[l], sizeof v[l]);
    } else {
      for (int l = 0; l < lines; ++l) std::memcpy(rows + l * stride + i, &v[l], sizeof v[l]);
    }
  }
}

}  // namespace monarch_flight::fluid::momentum
