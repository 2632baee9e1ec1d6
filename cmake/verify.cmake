# Proofs and studies, built only when asked for: monarch_proof(NAME SOURCE...) makes target monarch_NAME,
# program NAME.
function(monarch_proof name)
  add_executable(monarch_${name} EXCLUDE_FROM_ALL ${ARGN})
  set_target_properties(monarch_${name} PROPERTIES OUTPUT_NAME ${name})
  target_include_directories(monarch_${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src ${CMAKE_CURRENT_SOURCE_DIR}/bench)
  target_compile_definitions(monarch_${name} PRIVATE CONFIG_DIR="${CMAKE_CURRENT_SOURCE_DIR}/config"
    VERIFY_DATA_DIR="${CMAKE_CURRENT_SOURCE_DIR}/bench/verify/data" TEST_DATA_DIR="${CMAKE_CURRENT_SOURCE_DIR}/test/data")
  target_link_libraries(monarch_${name} PRIVATE monarch_run nlohmann_json::nlohmann_json)
endfunction()

set(CMAKE_UNITY_BUILD OFF)  # here and in the tests: their files may use the same names
# The flow solver (monarch verify).
file(GLOB verify_sources CONFIGURE_DEPENDS bench/verify/*.cpp)
monarch_proof(verify ${verify_sources})

# A controller in quasi-steady air (monarch study-control).
monarch_proof(study_control bench/control/study.cpp bench/control/lateral.cpp)
target_link_libraries(monarch_study_control PRIVATE monarch_trim)

# The flight dynamics (monarch verify dynamics). Simbody, the independent engine, is used by these alone.
find_package(Simbody QUIET)
file(GLOB dynamics_sources CONFIGURE_DEPENDS bench/dynamics/*.cpp bench/verify/report.cpp)
if(NOT Simbody_FOUND)
  list(FILTER dynamics_sources EXCLUDE REGEX "simbody")
endif()
monarch_proof(verify_dynamics ${dynamics_sources})
# GCC 12 calls its own AVX-512 intrinsics uninitialised when Eigen inlines them (GCC bug 105593).
set_source_files_properties(bench/dynamics/reduced.cpp PROPERTIES COMPILE_OPTIONS -Wno-uninitialized)
if(Simbody_FOUND)
  target_include_directories(monarch_verify_dynamics SYSTEM PRIVATE ${Simbody_INCLUDE_DIR})
  target_link_libraries(monarch_verify_dynamics PRIVATE ${Simbody_LIBRARIES})
  target_compile_definitions(monarch_verify_dynamics PRIVATE MONARCH_SIMBODY)
  # Simbody's own headers, inlined.
  set_source_files_properties(bench/dynamics/simbody.cpp PROPERTIES COMPILE_OPTIONS -Wno-array-bounds)
endif()
