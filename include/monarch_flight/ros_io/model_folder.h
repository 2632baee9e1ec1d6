#pragma once
#include <string>

#include "monarch_flight/run/case.h"

namespace monarch_flight {

/// Where ROS keeps its own files: ROS_HOME, else ~/.ros.
std::string rosHome();

/// Writes the meshes of the case's insect below `home` (`monarch_flight/model-<case>-<hash>`, one
/// for each shape) for a robot_description, and returns the folder. Runs share it, so none takes it
/// away when it ends: what no run has asked for in 30 days is removed here, as are token files of
/// runs that were killed.
std::string keptModel(const Case& c, const std::string& home);

}  // namespace monarch_flight
