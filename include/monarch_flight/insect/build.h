#pragma once
#include <string>

#include "monarch_flight/insect/insect.h"

namespace monarch_flight {

/// A uniform circular cylinder along its own x axis (body, abdomen).
struct Cylinder {
  double mass = 0.0;    ///< [kg]
  double length = 0.0;  ///< [m]
  double width = 0.0;   ///< diameter [m]
  /// Inertia about the mass centre: diag(m w^2/8, m (3 w^2/4 + l^2)/12, same) [kg m^2].
  Eigen::Matrix3d inertia() const;
};

/// What a wing and its hinge are made of, the outline apart.
struct WingParameters {
  double mass = 0.0;  ///< of one wing [kg]
  Eigen::Vector3d root =
      Eigen::Vector3d::Zero();  ///< right wing root from the body's mass centre, F_B [m]
  double beta = 0.0;            ///< stroke plane angle [rad]
  double kappa = 0.0;           ///< hinge stiffness [N m/rad]
  double theta_0 = 0.0;         ///< rest angle of the hinge [rad]
  HingeAdditions additions;     ///< to the linear spring
};

/// A flat-plate wing of uniform areal density.
Wing makeWing(const WingParameters& wing, const Planform& planform);

/// Butterfly of body, abdomen (mass centre half its length behind its joint) and two mirrored
/// flat-plate wings of uniform areal density. Values are taken as they are: ask Insect::problems()
/// afterwards.
Insect makeButterfly(const std::string& name, const Cylinder& body, const Cylinder& abdomen,
                     const Eigen::Vector3d& abdomen_joint, const WingParameters& wing,
                     const Planform& planform);

/// One wing without body: the body frame is the frame of the wing's root, and mu_R = 0.
Insect makeBareWing(const std::string& name, const WingParameters& wing, const Planform& planform);

}  // namespace monarch_flight
