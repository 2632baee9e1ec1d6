# For packages that compile against this one: matrices aligned as in its libraries, whatever their
# processor (monarch_flight/math/eigen.h).
add_compile_definitions(EIGEN_MAX_ALIGN_BYTES=16 EIGEN_MAX_STATIC_ALIGN_BYTES=16)
