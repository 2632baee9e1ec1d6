# ros_io, the nodes, and what is installed: everything that knows ROS but the messages.
#catkin_lint: ignore_once duplicate_cmd
catkin_package(
  INCLUDE_DIRS include
  LIBRARIES monarch_ros_io ${CORE_LAYERS}
  CATKIN_DEPENDS message_runtime ${ROS_PACKAGES}
  CFG_EXTRAS monarch_flight-alignment.cmake
  DEPENDS EIGEN3)

# Headers of ROS are the system's: -Wpedantic does not apply to them. That the core does not include
# them is checked in core.cmake.
include_directories(include)
include_directories(SYSTEM ${catkin_INCLUDE_DIRS})

file(GLOB ros_sources CONFIGURE_DEPENDS src/ros_io/*.cpp src/viz/*.cpp)
add_library(monarch_ros_io SHARED ${ros_sources})
target_include_directories(monarch_ros_io PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
#catkin_lint: ignore_once external_directory
target_include_directories(monarch_ros_io SYSTEM PUBLIC ${CATKIN_DEVEL_PREFIX}/include)
target_link_libraries(monarch_ros_io PUBLIC monarch_run monarch_fields ${catkin_LIBRARIES} PRIVATE OpenSSL::Crypto ${CMAKE_DL_LIBS})
add_dependencies(monarch_ros_io monarch_flight_generate_messages_cpp ${catkin_EXPORTED_TARGETS})

# Installed programs find their libraries without any environment. In Debian's packages these lie in a folder
# of the machine's name.
file(RELATIVE_PATH to_libraries /${CATKIN_PACKAGE_BIN_DESTINATION} /${CATKIN_PACKAGE_LIB_DESTINATION})

# One executable per file of src/nodes, named after it.
file(GLOB node_sources CONFIGURE_DEPENDS src/nodes/*.cpp)
add_library(monarch_loopback OBJECT src/loopback/bind.cpp)
foreach(source ${node_sources})
  get_filename_component(name ${source} NAME_WE)
  add_executable(monarch_node_${name} ${source})
  set_target_properties(monarch_node_${name} PROPERTIES OUTPUT_NAME ${name} INSTALL_RPATH "$ORIGIN/${to_libraries}")
  target_link_libraries(monarch_node_${name} PRIVATE monarch_ros_io monarch_loopback ${CMAKE_DL_LIBS})
  list(APPEND NODE_TARGETS monarch_node_${name})
endforeach()
add_custom_target(monarch_nodes DEPENDS ${NODE_TARGETS})
# What a flight needs, and no more (scripts/build).
add_custom_target(monarch_fly DEPENDS monarch_nodes monarch_flight_generate_messages_py)

function(monarch_install_libraries)
  set_target_properties(${ARGN} PROPERTIES INSTALL_RPATH "$ORIGIN")
  install(TARGETS ${ARGN} LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})
endfunction()
monarch_install_libraries(${CORE_LAYERS})
set_target_properties(monarch_ros_io PROPERTIES INSTALL_RPATH "$ORIGIN")
install(TARGETS monarch_ros_io LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})
foreach(level ${FLUID_LEVELS})
  install(TARGETS monarch_fluid_${level}
    LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}/glibc-hwcaps/x86-64-${level})
endforeach()
set_target_properties(${CORE_PROGRAMS} PROPERTIES INSTALL_RPATH "$ORIGIN/${to_libraries}")
install(TARGETS ${NODE_TARGETS} ${CORE_PROGRAMS} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
install(PROGRAMS examples/first_fluid.py examples/drag_fluid.py examples/first_guidance.py
  examples/climb_guidance.py examples/joy_guidance.py
  scripts/flown.py scripts/joint_sliders.py scripts/measured_path.py scripts/play.py scripts/show.py
  DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
install(DIRECTORY include/monarch_flight/ DESTINATION ${CATKIN_PACKAGE_INCLUDE_DESTINATION}
  FILES_MATCHING PATTERN "*.h")
install(DIRECTORY config docs launch report rviz urdf DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
# Compiled by the generators of messages, with paths of the build.
#catkin_lint: ignore_once env_var
install(CODE "file(GLOB_RECURSE compiled \$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CATKIN_PACKAGE_PYTHON_DESTINATION}/*.pyc)
  if(compiled)
    file(REMOVE \${compiled})
  endif()")
