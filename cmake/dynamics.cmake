# Proofs of the flight dynamics: built only when asked for (`make verify_dynamics`; monarch verify
# dynamics does). Simbody, the independent engine, is used by these alone.
find_package(Simbody QUIET)
file(GLOB dynamics_sources CONFIGURE_DEPENDS bench/dynamics/*.cpp bench/verify/report.cpp)
if(NOT Simbody_FOUND)
  list(FILTER dynamics_sources EXCLUDE REGEX "simbody")
endif()
add_executable(verify_dynamics EXCLUDE_FROM_ALL ${dynamics_sources})
target_include_directories(verify_dynamics PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src ${CMAKE_CURRENT_SOURCE_DIR}/bench)
target_compile_definitions(verify_dynamics PRIVATE CONFIG_DIR="${CMAKE_CURRENT_SOURCE_DIR}/config"
  TEST_DATA_DIR="${CMAKE_CURRENT_SOURCE_DIR}/test/data")
target_link_libraries(verify_dynamics PRIVATE monarch_run nlohmann_json::nlohmann_json)
# GCC 12 calls its own AVX-512 intrinsics uninitialised when Eigen inlines them (GCC bug 105593).
set_source_files_properties(bench/dynamics/reduced.cpp PROPERTIES COMPILE_OPTIONS -Wno-uninitialized)
if(Simbody_FOUND)
  target_include_directories(verify_dynamics SYSTEM PRIVATE ${Simbody_INCLUDE_DIR})
  target_link_libraries(verify_dynamics PRIVATE ${Simbody_LIBRARIES})
  target_compile_definitions(verify_dynamics PRIVATE MONARCH_SIMBODY)
  # Simbody's own headers, inlined.
  set_source_files_properties(bench/dynamics/simbody.cpp PROPERTIES COMPILE_OPTIONS -Wno-array-bounds)
endif()
