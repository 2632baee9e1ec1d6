# Core tests: one executable per file test/core/<layer>_<subject>_test.cpp, run by ctest.
find_package(GTest REQUIRED)
file(GLOB core_tests CONFIGURE_DEPENDS test/core/*_test.cpp)
foreach(source ${core_tests})
  get_filename_component(name ${source} NAME_WE)
  add_executable(${name} ${source})
  target_link_libraries(${name} PRIVATE ${CORE_LAYERS} nlohmann_json::nlohmann_json GTest::gtest GTest::gtest_main)
  target_include_directories(${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src ${CMAKE_CURRENT_SOURCE_DIR}/test)
  target_compile_definitions(${name} PRIVATE TEST_DATA_DIR="${CMAKE_CURRENT_SOURCE_DIR}/test/data"
    CONFIG_DIR="${CMAKE_CURRENT_SOURCE_DIR}/config")
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES TIMEOUT 300 ENVIRONMENT "OPENBLAS_NUM_THREADS=1")
endforeach()
