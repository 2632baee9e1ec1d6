#include "monarch_flight/viz/frames.h"

#include "monarch_flight/math/rotation.h"

namespace monarch_flight {
namespace {

template <class Message>
Message withComponents(const Eigen::Vector3d& v) {
  Message out;
  out.x = v.x();
  out.y = v.y();
  out.z = v.z();
  return out;
}

geometry_msgs::TransformStamped transform(const char* parent, const char* child,
                                          const Eigen::Vector3d& origin, const Eigen::Matrix3d& R,
                                          const ros::Time& stamp) {
  geometry_msgs::TransformStamped out;
  out.header.stamp = stamp;
  out.header.frame_id = parent;
  out.child_frame_id = child;
  out.transform.translation = toVector3(origin);
  out.transform.rotation = toQuaternion(R);
  return out;
}

/// The three hinges of a wing, one after the other (wingAttitude is their product).
void addWing(Side side, const Insect& insect, const JointAngles& angles, const ros::Time& stamp,
             std::vector<geometry_msgs::TransformStamped>& out) {
  const bool left = side == Side::kLeft;
  const double sign = left ? -1.0 : 1.0;
  const WingAngles& wing = angles.wings[side];
  const char* flapping = left ? frames::kLeftFlapping : frames::kRightFlapping;
  const char* deviation = left ? frames::kLeftDeviation : frames::kRightDeviation;
  const Eigen::Vector3d here = Eigen::Vector3d::Zero();
  out.push_back(transform(frames::kStrokePlane, flapping, wingRoot(insect, side),
                          rotationX(sign * wing.phi.q), stamp));
  out.push_back(transform(flapping, deviation, here, rotationZ(-sign * wing.psi.q), stamp));
  out.push_back(transform(deviation, left ? frames::kLeftWing : frames::kRightWing, here,
                          rotationY(wing.theta.q), stamp));
}

}  // namespace

Eigen::Vector3d wingRoot(const Insect& insect, Side side) {
  const Appendage& plate = insect.wings[side].plate;
  const Eigen::Vector3d mu = side == Side::kLeft ? mirrored(plate).mu : plate.mu;
  return rotationY(insect.beta).transpose() * mu;
}

Eigen::Matrix3d nedToEnu() {
  Eigen::Matrix3d R;
  R << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  return R;
}

Eigen::Matrix3d frdToFlu() { return Eigen::Vector3d(1, -1, -1).asDiagonal(); }

Eigen::Matrix3d baseLinkAttitude(const BodyState& body) {
  return nedToEnu() * body.R_IB() * frdToFlu();
}

geometry_msgs::Quaternion toQuaternion(const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(R).normalized();
  geometry_msgs::Quaternion out;
  out.x = q.x();
  out.y = q.y();
  out.z = q.z();
  out.w = q.w();
  return out;
}

geometry_msgs::Point toPoint(const Eigen::Vector3d& v) {
  return withComponents<geometry_msgs::Point>(v);
}

geometry_msgs::Vector3 toVector3(const Eigen::Vector3d& v) {
  return withComponents<geometry_msgs::Vector3>(v);
}

std::vector<geometry_msgs::TransformStamped> staticTransforms(const Insect& insect,
                                                              const ros::Time& stamp) {
  const Eigen::Vector3d here = Eigen::Vector3d::Zero();
  return {transform(frames::kWorld, frames::kWorldNed, here, nedToEnu(), stamp),
          transform(frames::kBaseLink, frames::kBodyFrd, here, frdToFlu(), stamp),
          transform(frames::kBodyFrd, frames::kStrokePlane, here, rotationY(insect.beta), stamp)};
}

std::vector<geometry_msgs::TransformStamped> movingTransforms(const Insect& insect,
                                                              const BodyState& body,
                                                              const JointAngles& angles,
                                                              const ros::Time& stamp) {
  std::vector<geometry_msgs::TransformStamped> out;
  out.reserve(8);
  out.push_back(transform(frames::kWorld, frames::kBaseLink, nedToEnu() * body.x,
                          baseLinkAttitude(body), stamp));
  addWing(Side::kRight, insect, angles, stamp, out);
  if (insect.bare_wing) return out;
  addWing(Side::kLeft, insect, angles, stamp, out);
  out.push_back(transform(frames::kBodyFrd, frames::kAbdomen, insect.abdomen.mu,
                          abdomenAttitude(angles), stamp));
  return out;
}

}  // namespace monarch_flight
