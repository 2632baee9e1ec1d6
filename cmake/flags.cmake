# One set of flags for the whole package, so that all of it computes alike.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release)  # of this package; nobody else's, nor what a person gave
endif()
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_UNITY_BUILD ${MONARCH_UNITY})  # of libraries: most of a file's compile time goes into headers that all of them need
set(CMAKE_UNITY_BUILD_BATCH_SIZE 10)
add_compile_options(-Wall -Wextra -Wpedantic -Wfloat-conversion -fno-math-errno -fno-trapping-math)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 calls its own AVX-512 intrinsics uninitialised wherever Eigen inlines them (GCC bug 105593).
  add_compile_options(-Wno-maybe-uninitialized -Wno-uninitialized)
endif()
# No program names the folders in which it was built (__FILE__).
add_compile_options(-fmacro-prefix-map=${CMAKE_BINARY_DIR}=. -fmacro-prefix-map=${CMAKE_CURRENT_SOURCE_DIR}=.)
if(MONARCH_NATIVE)
  add_compile_options(-march=native)
endif()
if(MONARCH_SANITIZERS)
  add_compile_options(-fsanitize=${MONARCH_SANITIZERS} -fno-sanitize-recover=all -fno-omit-frame-pointer -g1 -O1)
  add_link_options(-fsanitize=${MONARCH_SANITIZERS})
endif()
# One alignment of matrices for this package and all that link with it, whatever their processor
# (math/eigen.h); their own copies of inlined code do not stand in for this package's.
add_compile_definitions(EIGEN_MAX_ALIGN_BYTES=16 EIGEN_MAX_STATIC_ALIGN_BYTES=16)
add_link_options(-Wl,-Bsymbolic-functions)
