#include "monarch_flight/run/csv_tables.h"

#include <cstdio>

namespace monarch_flight {
namespace {

void put(std::string& row, double value) {
  char text[32];
  const int n = std::snprintf(text, sizeof text, "%.17g,", value);
  row.append(text, static_cast<std::size_t>(n));
}

void put(std::string& row, const Eigen::Vector3d& v) {
  for (int i = 0; i < 3; ++i) put(row, v[i]);
}

void put(std::string& row, const Coordinate& c) {
  put(row, c.q);
  put(row, c.qd);
  put(row, c.qdd);
}

void putInteger(std::string& row, unsigned long value) { row += std::to_string(value) + ","; }

/// What a replay needs beside the columns above (guidance/replay_guidance.h).
void putGuidance(std::string& row, const CommittedStep& step) {
  const WingAngles& wing = step.angles.wings.right;
  for (const Coordinate* c : {&wing.phi, &wing.psi, &step.angles.theta_A}) {
    put(row, c->qd);
    put(row, c->qdd);
  }
  put(row, step.guided.rest_angle.right);
  put(row, step.guided.wind.v);
  put(row, step.guided.wind.a);
  const GuidanceReport& report = step.guidance;
  put(row, report.phase);
  putInteger(row, report.clipped);
  putInteger(row, report.refused);
  putInteger(row, report.lost);
  for (const WingbeatChange* change : {&report.command, &report.applied}) {
    for (const CommandInfo& info : kCommandTable) put(row, change->*info.value);
  }
}

/// The left wing as its mirror image: in a symmetric flight the numbers of the right one. Attitude
/// and rates of a body that leaves its plane.
void putSides(std::string& row, const CommittedStep& step) {
  const WingAngles& wing = step.angles.wings.left;
  for (const Coordinate* c : {&wing.phi, &wing.psi, &wing.theta}) put(row, *c);
  put(row, step.guided.rest_angle.left);
  put(row, step.loads.left.force());
  put(row, step.loads.left.moment());
  const BodyState& body = step.interface.body;
  const Eigen::Vector3d angles = rollPitchYaw(body.R_IB());
  put(row, angles.x());
  put(row, angles.z());
  put(row, body.Omega_B);
  put(row, body.Omega_dot_B);
}

void endRow(std::string& row) { row.back() = '\n'; }

OutputMark markOf(StateVisitor* resumed, const std::string& name) {
  OutputMark mark;
  if (resumed != nullptr) showMark(*resumed, name, mark);
  return mark;
}

// An empty mark opens a new file.
OutputFile opened(const std::string& path, const OutputMark& mark) {
  return mark.bytes > 0 ? OutputFile(path, mark) : OutputFile(path);
}

}  // namespace

void showMark(StateVisitor& state, const std::string& name, OutputMark& mark) {
  state((name + "_bytes").c_str(), mark.bytes);
  state((name + "_sha256").c_str(), mark.sha256);
}

const std::string& FlightTable::header() {
  static const std::string names = [] {
    std::string all =
        "t,x,y,z,vx,vy,vz,ax,ay,az,theta_B,theta_B_dot,theta_B_ddot,qw,qx,qy,qz,"
        "phi,psi,theta_R,theta_R_dot,theta_R_ddot,theta_A,fx,fy,fz,mx,my,mz,"
        "fx_p,fy_p,fz_p,mx_p,my_p,mz_p,FX,FY,FZ,sub_iterations,courant,"
        "phi_dot,phi_ddot,psi_dot,psi_ddot,theta_A_dot,theta_A_ddot,rest_angle,wx,wy,wz,wax,way,"
        "waz,"
        "phase,clipped,refused,lost";
    for (const char* kind : {",command_", ",applied_"}) {
      for (const CommandInfo& info : kCommandTable) all += std::string(kind) + info.name;
    }
    all +=
        ",phi_L,phi_L_dot,phi_L_ddot,psi_L,psi_L_dot,psi_L_ddot,theta_L,theta_L_dot,theta_L_ddot,"
        "rest_angle_L,fx_L,fy_L,fz_L,mx_L,my_L,mz_L,roll,yaw,p,q,r,p_dot,q_dot,"
        "r_dot";
    return all;
  }();
  return names;
}

FlightTable::FlightTable(const std::string& path, StateVisitor* resumed)
    : file_(opened(path, markOf(resumed, "flight_csv"))) {
  if (resumed == nullptr)
    file_.write(header() + "\n");
  else
    (*resumed)("flight_csv_quaternion", last_.coeffs());
}

void FlightTable::onCheckpoint(StateVisitor& state) {
  OutputMark mark = file_.mark();
  showMark(state, "flight_csv", mark);
  state("flight_csv_quaternion", last_.coeffs());
}

void FlightTable::append(const CommittedStep& step) {
  const BodyState& body = step.interface.body;
  Eigen::Quaterniond q(body.q_IB);
  if (q.dot(last_) < 0.0) q.coeffs() *= -1.0;
  last_ = q;

  row_.clear();
  put(row_, step.t);
  put(row_, body.x);
  put(row_, body.v);
  put(row_, body.a);
  put(row_, body.pitch);
  for (double component : {q.w(), q.x(), q.y(), q.z()}) put(row_, component);
  put(row_, step.angles.wings.right.phi.q);
  put(row_, step.angles.wings.right.psi.q);
  put(row_, step.interface.theta.right);
  put(row_, step.angles.theta_A.q);
  const Loads& right = step.loads.right;
  put(row_, right.force());
  put(row_, right.moment());
  put(row_, right.force_pressure);
  put(row_, right.moment_pressure);
  put(row_, step.force_I);
  putInteger(row_, step.iterations.size());
  put(row_, step.fluid.courant);
  putGuidance(row_, step);
  putSides(row_, step);
  endRow(row_);
  file_.write(row_);
}

const std::string& IterationTable::header() {
  static const std::string names = [] {
    std::string all = "step,iteration,t,";
    for (const CoordinateInfo& info : kCoordinateTable)
      all += std::string("residual_") + info.name + ",";
    return all + "load_residual,relaxation,fluid_wall_s,attempt";
  }();
  return names;
}

IterationTable::IterationTable(const std::string& path, StateVisitor* resumed)
    : file_(opened(path, markOf(resumed, "iterations_csv"))) {
  if (resumed == nullptr) file_.write(header() + "\n");
}

void IterationTable::onCheckpoint(StateVisitor& state) {
  OutputMark mark = file_.mark();
  showMark(state, "iterations_csv", mark);
}

void IterationTable::append(const CommittedStep& step) {
  rows_.clear();
  for (const IterationRecord& record : step.iterations) {
    putInteger(rows_, record.step);
    putInteger(rows_, record.iteration);
    put(rows_, step.t);
    for (double residual : record.residual) put(rows_, residual);
    put(rows_, record.load_residual);
    put(rows_, record.relaxation);
    put(rows_, record.fluid_wall_s);
    putInteger(rows_, record.attempt);
    endRow(rows_);
  }
  file_.write(rows_);
}

}  // namespace monarch_flight
