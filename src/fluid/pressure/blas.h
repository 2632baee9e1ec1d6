#pragma once
#include <cblas.h>

namespace monarch_flight::fluid::pressure {

/// Use of BLAS by so many threads at a time, for as long as this object lives. Taken before
/// whatever is large, since a process without memory must fail here and not inside BLAS: OpenBLAS
/// asks for its work buffers at the first call that needs one, and where they are refused asks
/// again for ever. It keeps them, so that as many uses at a time as once lived never ask again. Any
/// thread may make one. Throws std::runtime_error, with what is needed and the remedy, when they
/// cannot be had.
///
/// BLAS itself works with one thread from here on, for the whole process: results then do not
/// depend on the machine's load, and small products do not pay for waking threads.
class BlasUse {
 public:
  explicit BlasUse(int threads = 1);
  ~BlasUse();
  BlasUse(const BlasUse&) = delete;
  BlasUse& operator=(const BlasUse&) = delete;

 private:
  int threads_;
};

/// Has BLAS' buffers taken ahead of the use, as early as can be. Throws as that.
inline void takeBlasBuffers(int threads = 1) { const BlasUse first(threads); }

/// c (m x n) = alpha op(a) (m x k) op(b) (k x n), all column major with leading dimensions ld*.
inline void product(CBLAS_TRANSPOSE op_a, CBLAS_TRANSPOSE op_b, int m, int n, int k, double alpha,
                    const double* a, int lda, const double* b, int ldb, double* c, int ldc) {
  cblas_dgemm(CblasColMajor, op_a, op_b, m, n, k, alpha, a, lda, b, ldb, 0.0, c, ldc);
}

}  // namespace monarch_flight::fluid::pressure
