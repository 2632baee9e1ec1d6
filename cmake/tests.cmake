# Core tests: one executable per file test/core/<layer>_<subject>_test.cpp, run by ctest.
find_package(GTest REQUIRED)
file(GLOB core_tests CONFIGURE_DEPENDS test/core/*_test.cpp)
foreach(source ${core_tests})
  get_filename_component(name ${source} NAME_WE)
  add_executable(${name} ${source})
  target_link_libraries(${name} PRIVATE ${CORE_LAYERS} nlohmann_json::nlohmann_json PkgConfig::YAML_CPP
    GTest::gtest GTest::gtest_main)
  target_include_directories(${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src ${CMAKE_CURRENT_SOURCE_DIR}/test ${CMAKE_CURRENT_SOURCE_DIR}/bench)
  target_compile_definitions(${name} PRIVATE TEST_DATA_DIR="${CMAKE_CURRENT_SOURCE_DIR}/test/data"
    CONFIG_DIR="${CMAKE_CURRENT_SOURCE_DIR}/config")
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES TIMEOUT ${TEST_LIMIT} ENVIRONMENT "OPENBLAS_NUM_THREADS=1")
endforeach()

# The flow solver on 1 to 4 processes.
add_executable(fluid_parallel_test test/mpi/fluid_parallel_test.cpp)
target_link_libraries(fluid_parallel_test PRIVATE monarch_fluid GTest::gtest)
target_include_directories(fluid_parallel_test PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
foreach(ranks 1 2 3 4)
  add_test(NAME fluid_parallel_${ranks}
    COMMAND ${MPIEXEC_EXECUTABLE} --oversubscribe ${MPIEXEC_NUMPROC_FLAG} ${ranks} $<TARGET_FILE:fluid_parallel_test>)
  set_tests_properties(fluid_parallel_${ranks} PROPERTIES TIMEOUT 300
    ENVIRONMENT "OPENBLAS_NUM_THREADS=1;OMPI_ALLOW_RUN_AS_ROOT=1;OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1;OMPI_MCA_mpi_yield_when_idle=1")
endforeach()

# One of several processes is lost to the flow: the end of them all says which, and why.
function(lost_process_test name ranks program way words)
  add_test(NAME ${name} COMMAND ${MPIEXEC_EXECUTABLE} --oversubscribe ${MPIEXEC_NUMPROC_FLAG} ${ranks}
    $<TARGET_FILE:${program}> ${way})
  set_tests_properties(${name} PROPERTIES TIMEOUT 60 PASS_REGULAR_EXPRESSION "${words}" FAIL_REGULAR_EXPRESSION "nevertheless"
    ENVIRONMENT "OPENBLAS_NUM_THREADS=1;OMPI_ALLOW_RUN_AS_ROOT=1;OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1;OMPI_MCA_mpi_yield_when_idle=1")
endfunction()

foreach(program lost_memory hung_process)
  add_executable(fluid_${program}_test test/mpi/${program}_test.cpp)
  target_link_libraries(fluid_${program}_test PRIVATE monarch_fluid)
  target_include_directories(fluid_${program}_test PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
endforeach()
set(alone "process 1 of the flow failed alone")
lost_process_test(fluid_lost_memory 2 fluid_lost_memory_test flow "${alone}: std::bad_alloc")
lost_process_test(fluid_lost_memory_blas 2 fluid_lost_memory_test blas "${alone}: no memory for BLAS: its 1 work buffer")
set(vain "waited in vain for process")
lost_process_test(fluid_hung_stopped 2 fluid_hung_process_test stopped "${vain} 1, which hangs: it gives no sign of life")
lost_process_test(fluid_hung_computing 3 fluid_hung_process_test computing "${vain} 2, which hangs: it runs, but did not come")
lost_process_test(fluid_hung_in_a_wait 3 fluid_hung_process_test in_a_wait "${vain} 2, which hangs")
lost_process_test(fluid_hung_caller 2 fluid_hung_process_test caller_stopped "${vain} 0, which hangs: it gives no sign of life")
lost_process_test(fluid_hung_before 2 fluid_hung_process_test before "not all began")

# The files of the flow, where they can be written.
if(VTK_FOUND)
  add_executable(fields_output_test test/fields/fields_output_test.cpp)
  target_link_libraries(fields_output_test PRIVATE monarch_fields GTest::gtest GTest::gtest_main
    VTK::CommonCore VTK::CommonDataModel VTK::IOXML)
  target_compile_definitions(fields_output_test PRIVATE CONFIG_DIR="${CMAKE_CURRENT_SOURCE_DIR}/config")
  add_test(NAME fields_output_test COMMAND fields_output_test)
  set_tests_properties(fields_output_test PROPERTIES TIMEOUT 120 ENVIRONMENT "OPENBLAS_NUM_THREADS=1")
endif()
