// Files of a run: tables, summary, hash, progress line.
#include <thread>

#include "monarch_flight/run/progress.h"
#include "run_files_fixture.h"

namespace monarch_flight {
namespace {

TEST_F(RunFiles, FlightTableHasTheNamedColumnsAndEveryBit) {
  RunOutputs outputs(smallCase(), out());
  const CommittedStep step = stepAt(3);
  outputs.onStep(stepAt(0));
  outputs.onStep(step);
  EXPECT_TRUE(exists("flight.csv.active"));
  EXPECT_FALSE(exists("flight.csv"));
  outputs.onEnd("");
  EXPECT_FALSE(exists("flight.csv.active"));
  const auto rows = lines(read("flight.csv"));
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(
      rows[0],
      "t,x,y,z,vx,vy,vz,ax,ay,az,theta_B,theta_B_dot,theta_B_ddot,qw,qx,qy,qz,phi,psi,theta_R,"
      "theta_R_dot,theta_R_ddot,theta_A,fx,fy,fz,mx,my,mz,fx_p,fy_p,fz_p,mx_p,my_p,mz_p,FX,FY,"
      "FZ,sub_iterations,courant,phi_dot,phi_ddot,psi_dot,psi_ddot,theta_A_dot,theta_A_ddot,"
      "rest_angle,wx,wy,wz,wax,way,waz,phase,clipped,refused,lost,command_amplitude,"
      "command_flapping_mean,command_frequency,command_deviation_mean,command_rest_angle,"
      "command_abdomen_mean,command_abdomen_amplitude,command_differential_amplitude,"
      "command_differential_flapping,command_differential_deviation,command_differential_rest_"
      "angle,"
      "applied_amplitude,applied_flapping_mean,applied_frequency,applied_deviation_mean,"
      "applied_rest_angle,applied_abdomen_mean,applied_abdomen_amplitude,"
      "applied_differential_amplitude,applied_differential_flapping,applied_differential_deviation,"
      "applied_differential_rest_angle,phi_L,phi_L_dot,phi_L_ddot,psi_L,psi_L_dot,psi_L_ddot,"
      "theta_L,theta_L_dot,theta_L_ddot,rest_angle_L,fx_L,fy_L,fz_L,mx_L,my_L,mz_L,roll,yaw,p,q,"
      "r,p_dot,q_dot,r_dot");
  const double b = step.interface.body.pitch.q, r = step.interface.theta.right.q;
  const double l = step.interface.theta.left.q;
  const std::vector<double> expected = {step.t,  step.interface.body.x[0],
                                        0,       step.interface.body.x[2],
                                        2,       0,
                                        -1,      0.1,
                                        0.2,     0.3,
                                        b,       1,
                                        100,     std::cos(0.5 * b),
                                        0,       std::sin(0.5 * b),
                                        0,       0.4,
                                        0.5,     r,
                                        2,       200,
                                        0.6,     1.25,
                                        2.5,     3.75,
                                        4.125,   5.25,
                                        6.375,   1,
                                        2,       3,
                                        4,       5,
                                        6,       7,
                                        8,       9,
                                        4,       0.875,
                                        41,      42,
                                        51,      52,
                                        61,      62,
                                        0.0625,  -1,
                                        0,       0.5,
                                        -11,     0,
                                        12,      0.1 * 3,
                                        3,       4,
                                        1,       100,
                                        101,     102,
                                        103,     104,
                                        105,     106,
                                        107,     108,
                                        109,     110,
                                        200,     201,
                                        202,     203,
                                        204,     205,
                                        206,     207,
                                        208,     209,
                                        210,     0.45,
                                        43,      44,
                                        0.55,    53,
                                        54,      l,
                                        3,       300,
                                        0.03125, 10.25,
                                        20.5,    30.75,
                                        40.125,  50.25,
                                        60.375,  0,
                                        0,       0,
                                        1,       0,
                                        0,       100,
                                        0};
  const auto row = numbers(rows[2]);
  ASSERT_EQ(row.size(), expected.size());
  for (std::size_t i = 0; i < row.size(); ++i) {
    const bool quaternion = i >= 13 && i < 17;
    EXPECT_NEAR(row[i], expected[i], quaternion ? 1e-15 : 0.0) << "column " << i;
  }
}

TEST_F(RunFiles, QuaternionDoesNotJumpThroughAFullTurn) {
  RunOutputs outputs(smallCase(), out());
  for (std::uint32_t n = 0; n <= 36; ++n) {
    CommittedStep s = stepAt(n);
    s.interface.body = withPitch(s.interface.body, {n * 20.0 * kPi / 180.0, 0, 0});
    outputs.onStep(s);
  }
  outputs.onEnd("");
  const auto rows = lines(read("flight.csv"));
  for (std::size_t i = 2; i < rows.size(); ++i) {
    const auto before = numbers(rows[i - 1]), now = numbers(rows[i]);
    double dot = 0.0;
    for (int k = 13; k < 17; ++k) dot += before[k] * now[k];
    EXPECT_NEAR(dot, std::cos(10.0 * kPi / 180.0), 1e-12);
  }
}

TEST_F(RunFiles, IterationTableHasARowPerSubIteration) {
  RunOutputs outputs(smallCase(), out());
  for (std::uint32_t n = 0; n <= 3; ++n) outputs.onStep(stepAt(n));
  outputs.onEnd("");
  const auto rows = lines(read("iterations.csv"));
  ASSERT_EQ(rows.size(), 1u + 0u + 1u + 1u + 4u);
  EXPECT_EQ(rows[0],
            "step,iteration,t,residual_x,residual_y,residual_z,residual_roll,residual_theta_B,"
            "residual_yaw,residual_theta_R,residual_theta_L,load_residual,relaxation,fluid_wall_s,"
            "attempt");
  EXPECT_EQ(numbers(rows[6]), (std::vector<double>{3, 3, stepAt(3).t, 1e-3, 2e-3, 3e-3, 4e-3, 5e-3,
                                                   6e-3, 7e-3, 8e-3, 9e-3, 0.5, 0.7, 2}));
}

TEST_F(RunFiles, SummaryHasEveryKeyAndTheRightNumbers) {
  RunOutputs outputs(smallCase(), out());
  for (std::uint32_t n = 0; n <= 25; ++n) {
    CommittedStep s = stepAt(n);
    if (n > 20) s.interface.body.x += Eigen::Vector3d(100, 0, 0);  // after the last whole flap
    outputs.onStep(s);
  }
  outputs.onEnd("");
  const auto j = nlohmann::json::parse(read("summary.json"));
  EXPECT_EQ(j.at("status"), "complete");
  EXPECT_EQ(j.at("failure"), "");
  EXPECT_EQ(j.at("case"), "small");
  EXPECT_EQ(j.at("case_sha256"), "0123abcd");
  EXPECT_FALSE(j.at("version").get<std::string>().empty());
  EXPECT_EQ(j.at("steps"), 25);
  EXPECT_NEAR(j.at("flaps").get<double>(), 2.5, 1e-12);
  // steps 3 .. 25 were solved: 12 odd ones with 4, 11 even ones with 3 sub-iterations
  EXPECT_NEAR(j.at("sub_iterations").at("mean").get<double>(), (12 * 4 + 11 * 3) / 23.0, 1e-12);
  EXPECT_EQ(j.at("sub_iterations").at("max"), 4);
  EXPECT_EQ(j.at("retried_steps"), 12);
  EXPECT_NEAR(j.at("fluid_evaluations").at("mean").get<double>(), (22 * 10 + 33) / 23.0, 1e-12);
  EXPECT_EQ(j.at("fluid_evaluations").at("max"), 33);
  EXPECT_NEAR(j.at("added_mass_ratio").at("mean").get<double>(), 1.125 + 1.0 / 25.0, 1e-12);
  EXPECT_EQ(j.at("added_mass_ratio").at("max"), 2.125);
  EXPECT_EQ(j.at("air_work_J").at("fluid"), -0.25 * 23);
  EXPECT_EQ(j.at("air_work_J").at("structure"), -0.375 * 22 - 0.5);
  EXPECT_EQ(j.at("air_work_J").at("largest_error_of_a_step"), 0.25);
  EXPECT_EQ(j.at("air_work_J").at("largest_step"), 0.25);
  EXPECT_NEAR(j.at("climb_angle_deg").get<double>(), std::atan2(1.0, 2.0) * 180 / kPi, 1e-9);
  EXPECT_NEAR(j.at("speed_m_s").get<double>(), std::sqrt(5.0), 1e-12);
  const double degree = 180.0 / kPi;
  EXPECT_NEAR(j.at("theta_B_deg").at("min").get<double>(), 0.1 * degree, 1e-12);
  EXPECT_NEAR(j.at("theta_B_deg").at("mean").get<double>(), 0.225 * degree, 1e-9);
  EXPECT_NEAR(j.at("theta_B_deg").at("max").get<double>(), 0.35 * degree, 1e-9);
  EXPECT_NEAR(j.at("theta_R_deg").at("min").get<double>(), -0.2 * degree, 1e-12);
  EXPECT_NEAR(j.at("theta_R_deg").at("max").get<double>(), 0.3 * degree, 1e-9);
  EXPECT_EQ(j.at("wall_s").at("fluid"), 13.0);
  EXPECT_EQ(j.at("wall_s").at("flight"), 6.5);
  EXPECT_EQ(j.at("wall_s").at("wing"), 3.25);
  EXPECT_EQ(j.at("wall_s").at("exchange"), 1.625);
  EXPECT_EQ(j.at("wall_s").at("coupling"), 0.8125);
  EXPECT_EQ(j.at("wall_s").at("outputs"), 12.5);
  const nlohmann::json& kernels = j.at("fluid_s");
  EXPECT_EQ(kernels.size(), kKernels + 1);
  EXPECT_NEAR(kernels.at("turning").get<double>(), 25 * 0.03125 / 45, 1e-15);
  EXPECT_NEAR(kernels.at("projection").get<double>(), 25 * 0.03125 * 9 / 45, 1e-15);
  EXPECT_NEAR(kernels.at("rest").get<double>(), 13.0 - 25 * 0.03125, 1e-12);
  EXPECT_GE(j.at("wall_s").at("total").get<double>(), 0.0);
  EXPECT_EQ(j.at("cells"), 42);
  ASSERT_EQ(j.at("added_mass").size(), 6u);
  for (int i = 0; i < 6; ++i)
    for (int k = 0; k < 6; ++k) EXPECT_EQ(j.at("added_mass").at(i).at(k), i == k ? 3.0 : 0.0);
  EXPECT_EQ(j.at("state_sha256").get<std::string>().size(), 64u);
  EXPECT_EQ(read("case.yaml"), "name: small\n");
}

TEST_F(RunFiles, FailedRunSaysSoAndKeepsItsTables) {
  RunOutputs outputs(smallCase(), out());
  outputs.onStep(stepAt(0));
  outputs.onStep(stepAt(1));
  outputs.onEnd("wing: no answer in step 2");
  const auto j = nlohmann::json::parse(read("summary.json"));
  EXPECT_EQ(j.at("status"), "failed");
  EXPECT_EQ(j.at("failure"), "wing: no answer in step 2");
  EXPECT_EQ(lines(read("flight.csv")).size(), 3u);
}

TEST(StateHashTest, IsSha256OfTheStatedLayout) {
  StateHash empty(true);  // SHA-256 of nothing
  EXPECT_EQ(empty.hex(), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CommittedStep zero;  // 38 doubles of which only the quaternion's w = 1 is not 0
  StateHash hash(true);
  hash.add(zero);
  // python3 -c "import hashlib, struct; a = [0.0] * 38;
  //     a[10] = 1.0; print(hashlib.sha256(struct.pack('<38d', *a)).hexdigest())"
  EXPECT_EQ(hash.hex(), "499daa9a05c55095ba200e5f0e49493c3cbd8954322084ef0476123b4e7dd809");
}

class StateHashOf : public ::testing::TestWithParam<bool> {};  // mirrored wings?

TEST_P(StateHashOf, SeesEveryStateAndNothingElse) {
  const auto hashOf = [](const CommittedStep& s) {
    StateHash hash(GetParam());
    hash.add(stepAt(0));
    hash.add(s);
    return hash.hex();
  };
  const std::string reference = hashOf(stepAt(1));
  EXPECT_EQ(hashOf(stepAt(1)), reference);
  CommittedStep s = stepAt(1);
  s.wall_s[0] = 99.0;
  s.iterations.clear();
  EXPECT_EQ(hashOf(s), reference);
  const auto changed = [&](auto change) {
    CommittedStep other = stepAt(1);
    change(other);
    return hashOf(other) != reference;
  };
  const auto bump = [](double& v) { v = std::nextafter(v, 1e9); };
  EXPECT_TRUE(changed([&](CommittedStep& o) { bump(o.t); }));
  EXPECT_TRUE(changed([&](CommittedStep& o) { bump(o.interface.body.x.y()); }));
  EXPECT_TRUE(changed([&](CommittedStep& o) { bump(o.interface.body.a.z()); }));
  EXPECT_TRUE(changed([&](CommittedStep& o) { bump(o.interface.body.q_IB.z()); }));
  EXPECT_TRUE(changed([&](CommittedStep& o) { bump(o.interface.body.Omega_dot_B.y()); }));
  EXPECT_TRUE(changed([&](CommittedStep& o) { bump(o.interface.body.pitch.qd); }));
  EXPECT_TRUE(changed([&](CommittedStep& o) { bump(o.interface.theta.right.qdd); }));
  EXPECT_TRUE(changed([&](CommittedStep& o) { bump(o.loads.right.force_friction.x()); }));
  EXPECT_TRUE(changed([&](CommittedStep& o) { bump(o.loads.right.moment_pressure.z()); }));
  const bool both = !GetParam();  // a mirrored left wing is no state of its own
  EXPECT_EQ(changed([&](CommittedStep& o) { bump(o.interface.theta.left.qdd); }), both);
  EXPECT_EQ(changed([&](CommittedStep& o) { bump(o.loads.left.force_friction.x()); }), both);
  EXPECT_EQ(changed([&](CommittedStep& o) { bump(o.loads.left.moment_pressure.z()); }), both);
}

INSTANTIATE_TEST_SUITE_P(MirroredAndIndependent, StateHashOf, ::testing::Bool());

TEST(Progress, PlainLineAfterEveryTenth) {
  std::ostringstream stream;
  ProgressSink sink(stream, false, {0.1, 0.0, 0.01, 25});
  for (std::uint32_t n = 0; n <= 25; ++n) sink.onStep(stepAt(n));
  sink.onEnd("");
  const auto text = lines(stream.str());
  ASSERT_EQ(text.size(), 10u);
  EXPECT_EQ(text[0].substr(0, 70),
            "[###.................]  12 %  flap 0.30/2.5  step 3/25  sub-iterations");
  EXPECT_NE(text[9].find("100 %  flap 2.50/2.5  step 25/25  sub-iterations 4  left 0:00"),
            std::string::npos);
  EXPECT_EQ(stream.str().find('\r'), std::string::npos);
}

/// What came before the first step that it hears of, as a set-up, is not counted.
TEST(Progress, OfARunThatGoesOnCountsFromItsFirstStep) {
  std::ostringstream stream;
  ProgressSink sink(stream, false, {0.1, 0.0, 0.01, 100});
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  for (std::uint32_t n = 41; n <= 50; ++n) sink.onStep(stepAt(n));
  const auto text = lines(stream.str());
  ASSERT_FALSE(text.empty());
  std::istringstream last(text.back().substr(text.back().find("left 0:00") + 9));
  double of_real_time = 0;
  ASSERT_TRUE(last >> of_real_time) << text.back();
  EXPECT_GT(of_real_time, 9 * 0.01 / 0.2);  // it would be less with the 200 ms
}

TEST(Progress, RedrawsOneLineOnATerminal) {
  std::ostringstream stream;
  ProgressSink sink(stream, true, {0.0, 0.0, 0.01, 25});
  for (std::uint32_t n = 0; n <= 25; ++n) sink.onStep(stepAt(n));
  sink.onEnd("");
  const auto text = stream.str();
  EXPECT_EQ(text.find('\n'), text.size() - 1);
  EXPECT_EQ(text.front(), '\r');
  EXPECT_NE(text.find("step 25/25"), std::string::npos);
  EXPECT_EQ(text.find("flap"), std::string::npos);  // a motion without a period
}

}  // namespace
}  // namespace monarch_flight
