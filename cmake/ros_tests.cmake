# ROS tests: one gtest per file test/ros/*_test.cpp, each with a master of its own on a free port and a
# time limit; python checks test/ros/*_check.py likewise. `ctest -L ros` runs them.
find_package(tf2 REQUIRED)
set(NODE_DIR ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
set(ROS_TEST_RUNNER ${CMAKE_CURRENT_SOURCE_DIR}/test/ros/with_master.py)
math(EXPR WITH_MASTER_LIMIT "${TEST_LIMIT} + 20")
set(ROS_TEST_ENVIRONMENT "OPENBLAS_NUM_THREADS=1"
  "PYTHONPATH=${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_PYTHON_DESTINATION}:$ENV{PYTHONPATH}")

if(MONARCH_SANITIZERS)  # these are slow
  list(APPEND ROS_TEST_ENVIRONMENT "MONARCH_HOSTILE_MESSAGES=60")
endif()

add_library(monarch_ros_test_main OBJECT EXCLUDE_FROM_ALL test/ros/main.cpp)
target_link_libraries(monarch_ros_test_main PRIVATE monarch_ros_io GTest::gtest)
# monarch_ros_test(NAME SOURCE...): a test that has a master of its own.
function(monarch_ros_test name)
  monarch_test_program(ros_${name} ${ARGN})
  # Beside the nodes: monarch hostile calls one of them.
  set_target_properties(monarch_ros_${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${NODE_DIR})
  target_link_libraries(monarch_ros_${name} PRIVATE monarch_ros_io ${tf2_LIBRARIES} nlohmann_json::nlohmann_json)
  target_compile_definitions(monarch_ros_${name} PRIVATE NODE_DIR="${NODE_DIR}")
  add_dependencies(monarch_ros_${name} monarch_nodes)
  add_test(NAME ros_${name}
    COMMAND ${PYTHON_EXECUTABLE} ${ROS_TEST_RUNNER} --limit ${TEST_LIMIT} $<TARGET_FILE:monarch_ros_${name}>)
  set_tests_properties(ros_${name} PROPERTIES TIMEOUT ${WITH_MASTER_LIMIT} LABELS ros
    ENVIRONMENT "${ROS_TEST_ENVIRONMENT}")
endfunction()

file(GLOB ros_tests CONFIGURE_DEPENDS test/ros/*_test.cpp)
foreach(source ${ros_tests})
  get_filename_component(name ${source} NAME_WE)
  monarch_ros_test(${name} ${source} $<TARGET_OBJECTS:monarch_ros_test_main>)
endforeach()

# The panel of rviz, found as rviz finds it: by the package's folder and its libraries.
if(MONARCH_PANEL)
  monarch_ros_test(panel_test test/panel/panel_test.cpp)
  target_compile_definitions(monarch_ros_panel_test PRIVATE QT_NO_KEYWORDS)
  target_include_directories(monarch_ros_panel_test SYSTEM PRIVATE ${rviz_INCLUDE_DIRS})
  target_link_libraries(monarch_ros_panel_test PRIVATE ${rviz_LIBRARIES} Qt5::Widgets)
  add_dependencies(monarch_ros_panel_test monarch_flight_panel)
  set_tests_properties(ros_panel_test PROPERTIES ENVIRONMENT
    "${ROS_TEST_ENVIRONMENT};ROS_PACKAGE_PATH=${CMAKE_CURRENT_SOURCE_DIR}:/usr/share;CMAKE_PREFIX_PATH=${CATKIN_DEVEL_PREFIX}")
endif()
