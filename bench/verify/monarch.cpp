#include "verify/monarch.h"

#include <algorithm>
#include <map>
#include <sstream>

#include "monarch_flight/insect/insect.h"
#include "monarch_flight/run/case.h"
#include "verify/setup.h"

namespace monarch_flight::verify {
namespace {

FlapSeries flown(const GridSettings& grid, int steps_per_flap, int flaps) {
  const Case c = loadCase("tethered_fwuav", {}, CONFIG_DIR);
  const double dt = c.time.period / steps_per_flap;
  auto motion = [&](double t) {
    const PrescribedState s = c.motion->at(t);
    return wingMotion(Side::kRight, c.insect, s.body, s.angles);
  };
  const auto flow = makeNavierStokes(c.insect.wings.right.planform, c.air, grid);
  flow->start(motion(0), dt);
  FlapSeries s;
  for (int n = 1; n <= flaps * steps_per_flap; ++n) {
    const WingMotion m = motion(n * dt);
    const Loads l = flow->evaluate(m);
    flow->commit();
    const Vector3d F_I = m.R_IW * l.force();
    s.lift.push_back(-2 * F_I.z());
    s.thrust.push_back(2 * F_I.x());
    s.F_z.push_back(l.force().z());
    s.M_y.push_back(l.moment().y());
    s.power.push_back(-2 * (l.force().dot(m.v_W) + l.moment().dot(m.omega_W)));
    s.worst_courant = std::max(s.worst_courant, flow->report().courant);
  }
  return s;
}

}  // namespace

const FlapSeries& monarchSeries(const GridSettings& g, int steps_per_flap, int flaps) {
  static std::map<std::string, FlapSeries> known;
  std::ostringstream key;
  key << g.cells_per_chord << ' ' << g.first_cell << ' ' << g.growth_plane << ' ' << g.growth_normal
      << ' ' << g.far_field << ' ' << g.outer << ' ' << steps_per_flap << ' ' << flaps;
  const auto found = known.find(key.str());
  if (found != known.end()) return found->second;
  return known.emplace(key.str(), flown(g, steps_per_flap, flaps)).first->second;
}

}  // namespace monarch_flight::verify
