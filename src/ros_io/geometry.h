#pragma once
#include <geometry_msgs/Point.h>
#include <geometry_msgs/Quaternion.h>
#include <geometry_msgs/Vector3.h>
#include <geometry_msgs/Wrench.h>
#include <monarch_flight/JointMotion.h>

#include "monarch_flight/insect/state.h"
#include "monarch_flight/viz/frames.h"

namespace monarch_flight {

inline Eigen::Vector3d vector(const geometry_msgs::Vector3& v) { return {v.x, v.y, v.z}; }
inline Eigen::Vector3d vector(const geometry_msgs::Point& p) { return {p.x, p.y, p.z}; }

/// Number by number: not made a unit quaternion again.
inline geometry_msgs::Quaternion sameQuaternion(const Quaternion& q) {
  geometry_msgs::Quaternion out;
  out.x = q.x();
  out.y = q.y();
  out.z = q.z();
  out.w = q.w();
  return out;
}
inline Quaternion quaternion(const geometry_msgs::Quaternion& q) { return {q.w, q.x, q.y, q.z}; }

inline geometry_msgs::Wrench wrench(const Eigen::Vector3d& force, const Eigen::Vector3d& torque) {
  geometry_msgs::Wrench out;
  out.force = toVector3(force);
  out.torque = toVector3(torque);
  return out;
}

inline Coordinate coordinate(const JointMotion& joint) {
  return {joint.position, joint.velocity, joint.acceleration};
}

}  // namespace monarch_flight
