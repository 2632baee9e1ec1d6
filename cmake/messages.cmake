# catkin, the python package, messages, services and the action.
if(NOT DEFINED PYTHON_EXECUTABLE AND EXISTS /usr/bin/python3)
  # catkin's tools belong to the system's python, whatever comes first in PATH.
  set(PYTHON_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python of catkin and of the message generators")
endif()
if(NOT DEFINED Python3_EXECUTABLE AND DEFINED PYTHON_EXECUTABLE)
  set(Python3_EXECUTABLE ${PYTHON_EXECUTABLE} CACHE FILEPATH "The same, for ament's modules")
endif()

set(ROS_PACKAGES actionlib_msgs geometry_msgs std_msgs)
if(NOT MONARCH_MESSAGES_ONLY)
  list(APPEND ROS_PACKAGES actionlib diagnostic_msgs diagnostic_updater nav_msgs pluginlib rosbag roscpp rosgraph_msgs
    roslz4 sensor_msgs std_srvs tf2_msgs topic_tools visualization_msgs)
endif()
find_package(catkin REQUIRED COMPONENTS message_generation ${ROS_PACKAGES})

if(NOT MONARCH_MESSAGES_ONLY)
  # The python package and monarch, in bin/; the messages join the package, so this comes before them.
  catkin_python_setup()
endif()

add_message_files(DIRECTORY msg FILES BodyMotion.msg ColourScale.msg ColourScales.msg CoordinateResiduals.msg
  CouplingKey.msg FlightState.msg FluidKernelTimes.msg GuidanceState.msg Hello.msg IgnoredCounts.msg
  InterfaceState.msg JointMotion.msg LoadDerivatives.msg ParticipantReply.msg ParticipantRequest.msg
  PrescribedLevel.msg PressureFacet.msg RoleTimes.msg StepIterations.msg SubIteration.msg VortexSample.msg
  WholeFlow.msg WingFace.msg WingJoints.msg WingLoads.msg WingbeatCommand.msg)
add_service_files(DIRECTORY srv FILES FlySteps.srv)
add_action_files(DIRECTORY action FILES Fly.action)
generate_messages(DEPENDENCIES actionlib_msgs geometry_msgs std_msgs)

if(MONARCH_MESSAGES_ONLY)
  catkin_package(CATKIN_DEPENDS message_runtime ${ROS_PACKAGES})
endif()
