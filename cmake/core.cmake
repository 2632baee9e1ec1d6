# The core: no ROS. One library per layer; dependencies point one way only:
#   math <- insect <- fluid, flight, wing <- coupling <- guidance <- run <- trim
find_package(Eigen3 3.3 REQUIRED NO_MODULE)
find_package(BLAS REQUIRED)
find_package(LAPACK REQUIRED)
find_package(MPI REQUIRED COMPONENTS C)
find_package(OpenSSL REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(HDF5 REQUIRED COMPONENTS C)
find_package(PkgConfig REQUIRED)
pkg_check_modules(YAML_CPP REQUIRED IMPORTED_TARGET yaml-cpp)

# Fails the configuration when a core source includes a ROS or message header: these lie in the default
# include path of Debian, so the compiler alone would not object.
function(forbid_ros layer)
  foreach(source ${ARGN})
    file(STRINGS ${source} bad REGEX "#include *[<\"](ros|tf2|tf2_ros|rosbag|std_msgs|geometry_msgs|sensor_msgs|nav_msgs|visualization_msgs|diagnostic_[a-z]*|tf2_msgs|monarch_flight/[A-Z][A-Za-z]*)[/.]")
    if(bad)
      message(FATAL_ERROR "layer ${layer} is core and must not know ROS: ${source}: ${bad}")
    endif()
  endforeach()
endfunction()

# One alignment of matrices for this package and all that link with it, whatever their processor
# (math/eigen.h); their own copies of inlined code do not stand in for this package's.
add_compile_definitions(EIGEN_MAX_ALIGN_BYTES=16 EIGEN_MAX_STATIC_ALIGN_BYTES=16)
add_link_options(-Wl,-Bsymbolic-functions)

function(core_layer name)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS src/${name}/*.cpp)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS include/monarch_flight/${name}/*.h src/${name}/*.h)
  forbid_ros(${name} ${sources} ${headers})
  add_library(monarch_${name} SHARED ${sources})
  target_include_directories(monarch_${name} PUBLIC ${CMAKE_CURRENT_SOURCE_DIR}/include PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
  target_link_libraries(monarch_${name} PUBLIC Eigen3::Eigen ${ARGN})
  target_link_options(monarch_${name} PRIVATE -Wl,--no-undefined)
endfunction()

core_layer(math)
core_layer(insect monarch_math)
core_layer(fluid monarch_insect)
target_compile_definitions(monarch_fluid PUBLIC OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
find_package(OpenMP REQUIRED COMPONENTS CXX)
target_link_libraries(monarch_fluid PUBLIC MPI::MPI_C PRIVATE OpenMP::OpenMP_CXX lapacke LAPACK::LAPACK BLAS::BLAS)
core_layer(flight monarch_insect)
core_layer(wing monarch_insect)
core_layer(coupling monarch_insect monarch_fluid monarch_flight monarch_wing)
core_layer(guidance monarch_coupling)
core_layer(run monarch_guidance)
target_link_libraries(monarch_run PRIVATE PkgConfig::YAML_CPP OpenSSL::Crypto nlohmann_json::nlohmann_json
  ${HDF5_C_LIBRARIES})
target_include_directories(monarch_run SYSTEM PRIVATE ${HDF5_C_INCLUDE_DIRS})
target_compile_definitions(monarch_run PRIVATE MONARCH_FLIGHT_VERSION="${PROJECT_VERSION}")
core_layer(trim monarch_run)
find_package(Threads REQUIRED)
target_link_libraries(monarch_trim PRIVATE PkgConfig::YAML_CPP Threads::Threads)
set(CORE_LAYERS monarch_math monarch_insect monarch_fluid monarch_flight monarch_wing monarch_coupling monarch_guidance monarch_run monarch_trim)

# Programs of the core, one per file of src/programs.
foreach(program trim inverse_dynamics)
  add_executable(${program} src/programs/${program}.cpp)
  target_link_libraries(${program} PRIVATE monarch_trim)
  target_compile_definitions(${program} PRIVATE MONARCH_CONFIG_DIR="${CMAKE_CURRENT_SOURCE_DIR}/config")
endforeach()
