# Messages, ros_io and the nodes: everything that knows ROS.
if(NOT DEFINED PYTHON_EXECUTABLE AND EXISTS /usr/bin/python3)
  # catkin's tools belong to the system's python, whatever comes first in PATH.
  set(PYTHON_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python of catkin and of the message generators")
endif()
if(NOT DEFINED Python3_EXECUTABLE AND DEFINED PYTHON_EXECUTABLE)
  set(Python3_EXECUTABLE ${PYTHON_EXECUTABLE} CACHE FILEPATH "The same, for ament's modules")
endif()

set(ROS_PACKAGES actionlib actionlib_msgs diagnostic_msgs diagnostic_updater geometry_msgs nav_msgs pluginlib rosbag roscpp
  rosgraph_msgs roslz4 sensor_msgs std_msgs std_srvs tf2_msgs topic_tools visualization_msgs)
find_package(catkin REQUIRED COMPONENTS message_generation ${ROS_PACKAGES})

# The python package and monarch, in bin/; the messages join the package, so this comes before them.
catkin_python_setup()

add_message_files(DIRECTORY msg FILES BodyMotion.msg CoordinateResiduals.msg CouplingKey.msg FlightState.msg
  FluidKernelTimes.msg GuidanceState.msg Hello.msg IgnoredCounts.msg InterfaceState.msg JointMotion.msg
  LoadDerivatives.msg ParticipantReply.msg ParticipantRequest.msg PrescribedLevel.msg PressureFacet.msg RoleTimes.msg
  StepIterations.msg SubIteration.msg VortexSample.msg WholeFlow.msg WingFace.msg WingJoints.msg WingLoads.msg
  WingbeatCommand.msg)
add_service_files(DIRECTORY srv FILES FlySteps.srv)
add_action_files(DIRECTORY action FILES Fly.action)
generate_messages(DEPENDENCIES actionlib_msgs geometry_msgs std_msgs)

catkin_package(
  INCLUDE_DIRS include
  LIBRARIES monarch_ros_io ${CORE_LAYERS}
  CATKIN_DEPENDS message_runtime ${ROS_PACKAGES}
  CFG_EXTRAS monarch_flight-alignment.cmake
  DEPENDS EIGEN3)

# Where catkin looks for them.
set_target_properties(${CORE_LAYERS} PROPERTIES LIBRARY_OUTPUT_DIRECTORY
  ${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_LIB_DESTINATION})

# Headers of ROS are the system's: -Wpedantic does not apply to them. That the core does not include
# them is checked in core.cmake.
include_directories(include)
include_directories(SYSTEM ${catkin_INCLUDE_DIRS})

file(GLOB ros_sources CONFIGURE_DEPENDS src/ros_io/*.cpp src/viz/*.cpp)
add_library(monarch_ros_io SHARED ${ros_sources})
target_include_directories(monarch_ros_io PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
#catkin_lint: ignore_once external_directory
target_include_directories(monarch_ros_io SYSTEM PUBLIC ${CATKIN_DEVEL_PREFIX}/include)
target_link_libraries(monarch_ros_io PUBLIC ${CORE_LAYERS} ${catkin_LIBRARIES} PRIVATE OpenSSL::Crypto ${CMAKE_DL_LIBS})
add_dependencies(monarch_ros_io monarch_flight_generate_messages_cpp ${catkin_EXPORTED_TARGETS})
target_compile_definitions(monarch_ros_io PRIVATE
  MONARCH_SOURCE_SHARE="${CMAKE_CURRENT_SOURCE_DIR}")

# One executable per file of src/nodes, named after it; the targets carry a prefix because `fluid`,
# `flight` and `wing` are also layers.
file(GLOB node_sources CONFIGURE_DEPENDS src/nodes/*.cpp)
set(NODE_TARGETS)
add_library(monarch_loopback OBJECT src/loopback/bind.cpp)
foreach(source ${node_sources})
  get_filename_component(name ${source} NAME_WE)
  add_executable(node_${name} ${source})
  set_target_properties(node_${name} PROPERTIES OUTPUT_NAME ${name} INSTALL_RPATH "$ORIGIN/..")
  target_link_libraries(node_${name} PRIVATE monarch_ros_io monarch_loopback ${CMAKE_DL_LIBS})
  list(APPEND NODE_TARGETS node_${name})
endforeach()
add_custom_target(nodes DEPENDS ${NODE_TARGETS})

# Installed programs find their libraries without any environment.
function(install_libraries)
  set_target_properties(${ARGN} PROPERTIES INSTALL_RPATH "$ORIGIN")
  install(TARGETS ${ARGN} LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})
endfunction()
install_libraries(${CORE_LAYERS})
set_target_properties(monarch_ros_io PROPERTIES INSTALL_RPATH "$ORIGIN")
install(TARGETS monarch_ros_io LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})
set_target_properties(trim inverse_dynamics PROPERTIES INSTALL_RPATH "$ORIGIN/..")
install(TARGETS ${NODE_TARGETS} trim inverse_dynamics RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
install(PROGRAMS examples/drag_fluid.py examples/climb_guidance.py examples/joy_guidance.py
  scripts/flown.py scripts/joint_sliders.py
  DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
install(DIRECTORY include/monarch_flight/ DESTINATION ${CATKIN_PACKAGE_INCLUDE_DESTINATION}
  FILES_MATCHING PATTERN "*.h")
install(DIRECTORY config launch rviz urdf DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})

if(MONARCH_TESTS)
  include(cmake/ros_tests.cmake)
endif()
