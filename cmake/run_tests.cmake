# catkin's targets: run_tests, run_tests_monarch_flight. Their result file is that of all of ctest, which
# knows time limits, environments and tests that are no gtests; so no test is registered twice.
if(CMAKE_VERSION VERSION_LESS 3.21 OR NOT TARGET run_tests)
  return()
endif()
set(results ${CATKIN_TEST_RESULTS_DIR}/${PROJECT_NAME}/ctest.xml)
set(MONARCH_RUN_TESTS "" CACHE STRING "Arguments of ctest in run_tests, as -R lockstep; empty: all tests")
add_custom_target(run_tests_monarch_flight
  COMMAND ${CATKIN_ENV} ${PYTHON_EXECUTABLE} ${catkin_EXTRAS_DIR}/test/run_tests.py ${results}
    --working-dir ${CMAKE_CURRENT_BINARY_DIR}
    "${CMAKE_CTEST_COMMAND} --output-on-failure --output-junit ${results} ${MONARCH_RUN_TESTS} || true"
  VERBATIM USES_TERMINAL)
add_dependencies(run_tests_monarch_flight tests)
add_dependencies(run_tests run_tests_monarch_flight)
