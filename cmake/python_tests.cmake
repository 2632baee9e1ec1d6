# Tests of the python modules, one file test/python/*_test.py each.
find_program(SYSTEM_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH REQUIRED)
file(GLOB python_tests CONFIGURE_DEPENDS test/python/*_test.py)
foreach(source ${python_tests})
  get_filename_component(name ${source} NAME_WE)
  add_test(NAME python_${name} COMMAND ${SYSTEM_PYTHON} ${source})
  set_tests_properties(python_${name} PROPERTIES TIMEOUT 60 LABELS python ENVIRONMENT "OPENBLAS_NUM_THREADS=1")
endforeach()
