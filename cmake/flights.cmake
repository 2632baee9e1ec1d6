# Short whole flights through scripts/fly, one file test/flights/*_test.py each. `ctest -L flight` runs them.
file(GLOB flight_tests CONFIGURE_DEPENDS test/flights/*_test.py)
# A guidance node of one's own in C++, which own_guidance_test.py and hostile_test.cpp fly.
monarch_test_program(own_guidance_node test/flights/own_guidance_node.cpp)
set_target_properties(monarch_own_guidance_node PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${NODE_DIR})
target_link_libraries(monarch_own_guidance_node PRIVATE monarch_ros_io)
add_dependencies(monarch_ros_hostile_test monarch_own_guidance_node)

foreach(source ${flight_tests})
  get_filename_component(name ${source} NAME_WE)
  add_test(NAME flight_${name} COMMAND ${PYTHON_EXECUTABLE} ${source} -v)
  set_tests_properties(flight_${name} PROPERTIES TIMEOUT 400 COST 100 LABELS flight  # the longest first
    ENVIRONMENT "MONARCH_BUILD=${CMAKE_BINARY_DIR};MONARCH_INSTALL=${CMAKE_INSTALL_PREFIX};PYTHONPATH=${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_PYTHON_DESTINATION}:$ENV{PYTHONPATH}")
endforeach()
