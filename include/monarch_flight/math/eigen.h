#pragma once
/// Eigen, as every public header takes it: matrices are aligned to 16 bytes whatever the
/// instruction set, so that code compiled with and without -march=native can share them.
#ifdef EIGEN_WORLD_VERSION  // Eigen was here before: it has chosen
#if EIGEN_MAX_ALIGN_BYTES != 16 || EIGEN_MAX_STATIC_ALIGN_BYTES != 16
#error \
    "Eigen was included before monarch_flight with another alignment: include monarch_flight/math/eigen.h (or any of its headers) first, or compile with -DEIGEN_MAX_ALIGN_BYTES=16 -DEIGEN_MAX_STATIC_ALIGN_BYTES=16, as find_package(catkin COMPONENTS monarch_flight) does"
#endif
#else
#if (defined(EIGEN_MAX_ALIGN_BYTES) && EIGEN_MAX_ALIGN_BYTES != 16) || \
    (defined(EIGEN_MAX_STATIC_ALIGN_BYTES) && EIGEN_MAX_STATIC_ALIGN_BYTES != 16)
#error \
    "monarch_flight shares matrices that are aligned to 16 bytes: take EIGEN_MAX_ALIGN_BYTES and EIGEN_MAX_STATIC_ALIGN_BYTES out of the compiler's options, or set both to 16"
#endif
#undef EIGEN_MAX_ALIGN_BYTES
#define EIGEN_MAX_ALIGN_BYTES 16
#undef EIGEN_MAX_STATIC_ALIGN_BYTES
#define EIGEN_MAX_STATIC_ALIGN_BYTES 16
#endif

#include <Eigen/Dense>

#if EIGEN_MAX_ALIGN_BYTES != 16 || EIGEN_MAX_STATIC_ALIGN_BYTES != 16
#error \
    "Eigen does not align to 16 bytes: take EIGEN_DONT_ALIGN and EIGEN_DONT_ALIGN_STATICALLY out of the compiler's options"
#endif
