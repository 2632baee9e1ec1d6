# The tests: ctest runs them all; catkin's run_tests calls ctest, and finds the results.
find_package(GTest QUIET)
if(NOT GTest_FOUND OR (MONARCH_ROS AND DEFINED CATKIN_ENABLE_TESTING AND NOT CATKIN_ENABLE_TESTING))
  message(STATUS "Built without tests: CATKIN_ENABLE_TESTING is off, or gtest is not found (scripts/install check)")
  return()
endif()
enable_testing()
set(TEST_LIMIT 300)  # of one test [s]
if(MONARCH_SANITIZERS)
  set(TEST_LIMIT 1500)
endif()
if(NOT TARGET tests)
  add_custom_target(tests)
endif()

# monarch_test_program(NAME SOURCE...): target monarch_NAME, program NAME. In a workspace it is compiled by
# the target `tests`, which run_tests asks for, elsewhere with everything else.
function(monarch_test_program name)
  add_executable(monarch_${name} ${ARGN})
  set_target_properties(monarch_${name} PROPERTIES OUTPUT_NAME ${name})
  target_include_directories(monarch_${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src ${CMAKE_CURRENT_SOURCE_DIR}/test
    ${CMAKE_CURRENT_SOURCE_DIR}/bench)
  target_compile_definitions(monarch_${name} PRIVATE CONFIG_DIR="${CMAKE_CURRENT_SOURCE_DIR}/config"
    TEST_DATA_DIR="${CMAKE_CURRENT_SOURCE_DIR}/test/data" URDF_DIR="${CMAKE_CURRENT_SOURCE_DIR}/urdf")
  target_compile_options(monarch_${name} PRIVATE -O1)  # a third less to compile; what takes time is in the libraries
  target_link_libraries(monarch_${name} PRIVATE GTest::gtest)
  add_dependencies(tests monarch_${name})
  if(IN_WORKSPACE)
    set_target_properties(monarch_${name} PROPERTIES EXCLUDE_FROM_ALL ON)
  endif()
endfunction()

include(cmake/core_tests.cmake)
include(cmake/python_tests.cmake)
if(MONARCH_ROS)
  include(cmake/ros_tests.cmake)
  include(cmake/run_tests.cmake)
  if(NOT IN_WORKSPACE)  # they fly what scripts/build has made
    include(cmake/flights.cmake)
  endif()
endif()
