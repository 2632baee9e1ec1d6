#pragma once
#include <cstddef>
#include <cstring>

namespace monarch_flight::fluid::momentum {

#if defined(__AVX512F__)
constexpr int kPack = 8;
#elif defined(__AVX__)
constexpr int kPack = 4;
#else
constexpr int kPack = 2;
#endif

/// As many doubles as one register of the processor holds.
using Pack = double __attribute__((vector_size(8 * kPack)));

inline Pack load(const double* p) {
  Pack v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
inline void store(Pack v, double* p) { std::memcpy(p, &v, sizeof v); }

inline Pack absolute(Pack v) { return v < 0 ? -v : v; }
inline Pack smaller(Pack a, Pack b) { return a < b ? a : b; }
inline Pack larger(Pack a, Pack b) { return a < b ? b : a; }

/// Transposes kPack vectors in place.
inline void transpose(Pack (&v)[kPack]) {
  Pack t[kPack];
#if defined(__AVX512F__)
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
#elif defined(__AVX__)
  for (int i = 0; i < 4; i += 2) {
    t[i] = __builtin_shufflevector(v[i], v[i + 1], 0, 4, 2, 6);
    t[i + 1] = __builtin_shufflevector(v[i], v[i + 1], 1, 5, 3, 7);
  }
  for (int j = 0; j < 2; ++j) {
    v[j] = __builtin_shufflevector(t[j], t[j + 2], 0, 1, 4, 5);
    v[j + 2] = __builtin_shufflevector(t[j], t[j + 2], 2, 3, 6, 7);
  }
#else
  t[0] = __builtin_shufflevector(v[0], v[1], 0, 2);
  v[1] = __builtin_shufflevector(v[0], v[1], 1, 3);
  v[0] = t[0];
#endif
}

/// Lines along x that are solved together, one in each lane of two packs: the divisions of one
/// chain hide behind those of the other.
constexpr int kLines = 2 * kPack;

/// out[i * kLines + l] = rows[l * stride + i] for l < lines and i < n rounded up to a multiple of
/// kPack; lanes without a line get 0.
inline void interleave(const double* rows, std::ptrdiff_t stride, int lines, int n, double* out) {
  for (int first = 0; first < kLines; first += kPack) {
    const int here = lines - first < kPack ? lines - first : kPack;
    const double* in = rows + first * stride;
    for (int i = 0; i < n; i += kPack) {
      Pack v[kPack] = {};
      if (here == kPack) {
        for (int l = 0; l < kPack; ++l) v[l] = load(in + l * stride + i);
      } else {
        for (int l = 0; l < here; ++l) v[l] = load(in + l * stride + i);
      }
      transpose(v);
      for (int l = 0; l < kPack; ++l) store(v[l], out + (i + l) * kLines + first);
    }
  }
}

/// The inverse: rows[l * stride + i] = in[i * kLines + l].
inline void separate(const double* in, int lines, int n, double* rows, std::ptrdiff_t stride) {
  for (int first = 0; first < lines; first += kPack) {
    const int here = lines - first < kPack ? lines - first : kPack;
    double* out = rows + first * stride;
    for (int i = 0; i < n; i += kPack) {
      Pack v[kPack];
      for (int l = 0; l < kPack; ++l) v[l] = load(in + (i + l) * kLines + first);
      transpose(v);
      if (here == kPack) {
        for (int l = 0; l < kPack; ++l) store(v[l], out + l * stride + i);
      } else {
        for (int l = 0; l < here; ++l) store(v[l], out + l * stride + i);
      }
    }
  }
}

}  // namespace monarch_flight::fluid::momentum
