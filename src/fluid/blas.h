#pragma once
#include <cblas.h>

/// OpenBLAS' own setting; absent (null) with another BLAS.
extern "C" void openblas_set_num_threads(int threads) __attribute__((weak));

namespace monarch_flight {

/// One thread in BLAS, for the whole process: results then do not depend on the machine's load, and
/// small products do not pay for waking threads.
inline void useOneBlasThread() {
  if (openblas_set_num_threads != nullptr) openblas_set_num_threads(1);
}

/// c (m x n) = alpha op(a) (m x k) op(b) (k x n), all column major with leading dimensions ld*.
inline void product(CBLAS_TRANSPOSE op_a, CBLAS_TRANSPOSE op_b, int m, int n, int k, double alpha,
                    const double* a, int lda, const double* b, int ldb, double* c, int ldc) {
  cblas_dgemm(CblasColMajor, op_a, op_b, m, n, k, alpha, a, lda, b, ldb, 0.0, c, ldc);
}

}  // namespace monarch_flight
