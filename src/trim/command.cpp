#include "monarch_flight/trim/command.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <ostream>

#include "monarch_flight/math/angle.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/run/output_file.h"

namespace monarch_flight {
namespace {

constexpr int kShortRunIn = 10;  // steps, the paper's start, where the air has no memory

std::size_t size(const Case& c, const TrimOptions& options) {
  std::size_t states = 0;
  for (FreeCoordinate i : {kX, kY, kZ, kYaw}) states += c.free[i] ? 1u : 0u;
  for (FreeCoordinate i : {kRoll, kPitch, kThetaR, kThetaL}) states += c.free[i] ? 2u : 0u;
  return states + options.parameters.size();
}

Eigen::MatrixXd readJacobian(const std::string& path, const Case& c, const TrimOptions& options) {
  std::ifstream in(path);
  const auto columns = static_cast<Eigen::Index>(size(c, options));
  const Eigen::Index states = columns - static_cast<Eigen::Index>(options.parameters.size());
  const auto targets = static_cast<Eigen::Index>(options.targets.size());
  Eigen::Index rows = 0, found_columns = 0;
  in >> rows >> found_columns;
  const Eigen::Index beyond = rows - states;  // targets of one flap or more
  const bool whole = targets > 0 ? beyond > 0 && beyond % targets == 0 : beyond == 0;
  if (!in || found_columns != columns || !whole || beyond > 100 * targets) {
    throw InputError("jacobian:=" + path + ": must hold a matrix of " + std::to_string(states) +
                     " + " + std::to_string(targets) + " a flap rows and " +
                     std::to_string(columns) +
                     " columns, as a trim with the same fit and targets writes it; give that one");
  }
  Eigen::MatrixXd J(rows, columns);
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index j = 0; j < columns; ++j) in >> J(i, j);
  }
  if (!in || !J.allFinite()) {
    throw InputError("jacobian:=" + path + ": holds too few numbers; write it again");
  }
  return overHorizon(J, states, targets, options.horizon);
}

void writeResult(const std::string& path, const FlapMap& map, const TrimOptions& options,
                 const TrimResult& result, int flaps) {
  const double per_flap = map.baseCase().time.stepsPerFlap();
  const int run_in =
      map.runIn() > 0 ? static_cast<int>(std::lround(map.runIn() * per_flap)) : kShortRunIn;
  writeWhole(path, trimmedCase(map, options, result, run_in, flaps));
  const Eigen::MatrixXd& J = result.newton.jacobian;
  std::ostringstream text;
  text.precision(17);
  text << J.rows() << ' ' << J.cols() << '\n' << J << '\n';
  writeWhole(path + ".jacobian", text.str());
}

void printFlight(std::ostream& out, const Flight& flight) {
  out << "flap  climb deg  speed m/s  theta_B mean, swing, largest deg  theta_R swing deg  "
         "turn deg  change\n";
  int number = 0;
  for (const Flap& flap : flight.flaps) {
    const FlapState change = (flap.end - flap.start).cwiseQuotient(trimScales());
    char line[160];
    std::snprintf(line, sizeof line,
                  "%4d  %9.2f  %9.3f  %12.2f %6.2f %8.2f  %22.2f  %8.2f  %6.3g\n", ++number,
                  flap.climb / kDegree, flap.speed, flap.theta_B_mean / kDegree,
                  flap.theta_B_swing / kDegree, flap.theta_B_largest / kDegree,
                  flap.theta_R_swing / kDegree, flap.turn / kDegree, change.cwiseAbs().maxCoeff());
    out << line;
  }
  if (!flight.complete) out << "the flight ended: " << flight.failure << '\n';
  out << "wall time " << flight.wall_s << " s\n";
}

}  // namespace

void requireNew(const std::string& out, const std::vector<std::string>& endings) {
  for (const std::string& ending : endings) {
    const std::string path = out + ending;
    if (!out.empty() && std::filesystem::exists(path)) {
      throw InputError("out:=" + out + ": " + path +
                       " exists already; name another file or move that one away");
    }
  }
}

int runTrim(TrimCommand command, const std::string& config_dir, std::ostream& out) {
  requireNew(command.out, {"", ".jacobian"});
  const Case c = loadCase(command.case_name, command.overrides, config_dir);
  TrimOptions& options = command.options;
  if (!command.jacobian_file.empty()) {
    options.jacobian = readJacobian(command.jacobian_file, c, options);
    options.newton.broyden = true;
  }
  if (c.mirrored && options.start && !inPlane(*options.start)) {
    throw InputError(
        "start: v, roll, roll_dot, yaw_dot must be 0 and both wings alike with mirrored wings; "
        "give "
        "six numbers, or wings:=independent");
  }
  const FlapMap map(c, config_dir, options.parameters, options.run_in);
  const auto keep = [&](const TrimResult& result) {
    writeResult(command.out, map, options, result, command.fly > 0 ? command.fly : 6);
  };
  if (!command.out.empty()) options.better = keep;
  const TrimResult result = trim(c, config_dir, options, out);
  printTrim(out, map, options, result);
  if (!command.out.empty()) {
    keep(result);
    out << "case: " << command.out << std::endl;
  }
  if (command.fly > 0) printFlight(out, map.fly(result.point, command.fly));
  return result.newton.converged ? 0 : 1;
}

}  // namespace monarch_flight
