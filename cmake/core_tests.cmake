# Core tests: one executable per file test/core/<layer>_<subject>_test.cpp, run by ctest.
file(GLOB core_tests CONFIGURE_DEPENDS test/core/*_test.cpp)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
foreach(source ${core_tests})
  get_filename_component(name ${source} NAME_WE)
  monarch_test_program(${name} ${source})
  target_link_libraries(monarch_${name} PRIVATE ${CORE_LAYERS} nlohmann_json::nlohmann_json PkgConfig::YAML_CPP
    GTest::gtest_main)
  add_test(NAME ${name} COMMAND monarch_${name})
  set_tests_properties(${name} PROPERTIES TIMEOUT ${TEST_LIMIT} ENVIRONMENT "OPENBLAS_NUM_THREADS=1")
endforeach()

# The flow solver on 1 to 4 processes.
monarch_test_program(fluid_parallel_test test/mpi/fluid_parallel_test.cpp)
target_link_libraries(monarch_fluid_parallel_test PRIVATE monarch_fluid)
foreach(ranks 1 2 3 4)
  add_test(NAME fluid_parallel_${ranks}
    COMMAND ${MPIEXEC_EXECUTABLE} --oversubscribe ${MPIEXEC_NUMPROC_FLAG} ${ranks} $<TARGET_FILE:monarch_fluid_parallel_test>)
  set_tests_properties(fluid_parallel_${ranks} PROPERTIES TIMEOUT 300
    ENVIRONMENT "OPENBLAS_NUM_THREADS=1;OMPI_ALLOW_RUN_AS_ROOT=1;OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1;OMPI_MCA_mpi_yield_when_idle=1")
endforeach()

# One of several processes is lost to the flow: the end of them all says which, and why.
function(monarch_lost_process_test name ranks program way words)
  add_test(NAME ${name} COMMAND ${MPIEXEC_EXECUTABLE} --oversubscribe ${MPIEXEC_NUMPROC_FLAG} ${ranks}
    $<TARGET_FILE:monarch_${program}> ${way})
  set_tests_properties(${name} PROPERTIES TIMEOUT 60 PASS_REGULAR_EXPRESSION "${words}" FAIL_REGULAR_EXPRESSION "nevertheless"
    ENVIRONMENT "OPENBLAS_NUM_THREADS=1;OMPI_ALLOW_RUN_AS_ROOT=1;OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1;OMPI_MCA_mpi_yield_when_idle=1")
endfunction()

foreach(program lost_memory hung_process)
  monarch_test_program(fluid_${program}_test test/mpi/${program}_test.cpp)
  target_link_libraries(monarch_fluid_${program}_test PRIVATE monarch_fluid)
endforeach()
set(alone "process 1 of the flow failed alone")
monarch_lost_process_test(fluid_lost_memory 2 fluid_lost_memory_test flow "${alone}: std::bad_alloc")
monarch_lost_process_test(fluid_lost_memory_blas 2 fluid_lost_memory_test blas "${alone}: no memory for BLAS: its 1 work buffer")
set(vain "waited in vain for process")
monarch_lost_process_test(fluid_hung_stopped 2 fluid_hung_process_test stopped "${vain} 1, which hangs: it gives no sign of life")
monarch_lost_process_test(fluid_hung_computing 3 fluid_hung_process_test computing "${vain} 2, which hangs: it runs, but did not come")
monarch_lost_process_test(fluid_hung_in_a_wait 3 fluid_hung_process_test in_a_wait "${vain} 2, which hangs")
monarch_lost_process_test(fluid_hung_caller 2 fluid_hung_process_test caller_stopped "${vain} 0, which hangs: it gives no sign of life")
monarch_lost_process_test(fluid_hung_before 2 fluid_hung_process_test before "not all began")

# The files of the flow, where they can be written.
if(VTK_FOUND)
  monarch_test_program(fields_output_test test/fields/fields_output_test.cpp)
  target_link_libraries(monarch_fields_output_test PRIVATE monarch_fields GTest::gtest_main
    VTK::CommonCore VTK::CommonDataModel VTK::IOXML)
  add_test(NAME fields_output_test COMMAND monarch_fields_output_test)
  set_tests_properties(fields_output_test PROPERTIES TIMEOUT 120 ENVIRONMENT "OPENBLAS_NUM_THREADS=1")
endif()

# What the compiler made of the flow's eliminations; sanitizers keep it from making vectors.
if(NOT MONARCH_SANITIZERS AND CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  find_program(SYSTEM_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH REQUIRED)
  add_test(NAME fluid_packed_divisions
    COMMAND ${SYSTEM_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/test/core/packed_divisions_check.py $<TARGET_FILE:monarch_fluid>)
  set_tests_properties(fluid_packed_divisions PROPERTIES TIMEOUT 60)
endif()
