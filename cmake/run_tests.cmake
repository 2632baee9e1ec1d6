# catkin's targets: run_tests, run_tests_monarch_flight. Their result file is that of all of ctest, which
# knows time limits, environments and tests that are no gtests; so no test is registered twice. ctest counts
# no errors, which catkin_test_results wants to read.
if(CMAKE_VERSION VERSION_LESS 3.21 OR NOT TARGET run_tests)
  return()
endif()
set(results ${CATKIN_TEST_RESULTS_DIR}/${PROJECT_NAME}/ctest.xml)
set(MONARCH_RUN_TESTS "" CACHE STRING "Arguments of ctest in run_tests, as -R lockstep; empty: all tests")
add_custom_target(run_tests_monarch_flight
  COMMAND ${CATKIN_ENV} ${PYTHON_EXECUTABLE} ${catkin_EXTRAS_DIR}/test/run_tests.py ${results}
    --working-dir ${CMAKE_CURRENT_BINARY_DIR}
    "${CMAKE_CTEST_COMMAND} --output-on-failure --output-junit ${results} ${MONARCH_RUN_TESTS}; sed -i 's/^<testsuite/& errors=\"0\"/' ${results}"
  VERBATIM USES_TERMINAL)
add_dependencies(run_tests_monarch_flight tests)
add_dependencies(run_tests run_tests_monarch_flight)
