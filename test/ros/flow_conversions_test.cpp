#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "monarch_flight/ros_io/conversions.h"
#include "ros/wire.h"

namespace monarch_flight {
namespace {

std::mt19937_64 generator(20240501);

float anyFloat() {
  while (true) {
    const auto bits = static_cast<std::uint32_t>(generator());
    float value;
    std::memcpy(&value, &bits, sizeof value);
    if (std::isfinite(value)) return value;
  }
}

FlowField smallFlow() {
  FlowField flow;
  flow.x = {0, 1, 2};
  flow.y = {0, 0.1};
  flow.z = {-1, 0, 0.5, 7};
  for (int n = 0; n < 6; ++n) {
    for (int c = 0; c < 3; ++c) {
      flow.velocity.push_back(anyFloat());
      flow.vorticity.push_back(anyFloat());
    }
    flow.pressure.push_back(anyFloat());
    flow.q.push_back(anyFloat());
  }
  flow.wing = {{1, 2, 3, 4, 5, 6, {7, 8}, {9, 10}}, {-1, -2, -3, -4, -5, -6, {-7, -8}, {-9, -10}}};
  return flow;
}

TEST(Conversions, AFlowCrossesBitForBit) {
  const FlowField flow = smallFlow();
  Reply reply;
  reply.flow = std::make_shared<FlowField>(flow);
  const ParticipantReply message = overTheWire(toMessage(reply));
  EXPECT_EQ("", problem(message));
  const Reply back = fromMessage(message);
  ASSERT_NE(nullptr, back.flow);
  EXPECT_EQ(flow.x, back.flow->x);
  EXPECT_EQ(flow.y, back.flow->y);
  EXPECT_EQ(flow.z, back.flow->z);
  EXPECT_EQ(flow.velocity, back.flow->velocity);
  EXPECT_EQ(flow.vorticity, back.flow->vorticity);
  EXPECT_EQ(flow.pressure, back.flow->pressure);
  EXPECT_EQ(flow.q, back.flow->q);
  ASSERT_EQ(2u, back.flow->wing.size());
  EXPECT_EQ(0,
            std::memcmp(flow.wing.data(), back.flow->wing.data(), 2 * sizeof(FlowField::WingFace)));
  EXPECT_EQ(nullptr, fromMessage(toMessage(Reply())).flow);
}

TEST(Conversions, AFlowThatDoesNotFitItsGridIsNamed) {
  Reply reply;
  FlowField flow = smallFlow();
  flow.pressure.pop_back();
  reply.flow = std::make_shared<FlowField>(flow);
  EXPECT_EQ("a flow whose arrays do not fit its 6 cells", problem(toMessage(reply)));
  flow = smallFlow();
  flow.q[1] = std::numeric_limits<float>::quiet_NaN();
  reply.flow = std::make_shared<FlowField>(flow);
  EXPECT_EQ("a flow that is not finite", problem(toMessage(reply)));
  reply.flow = std::make_shared<FlowField>(smallFlow());
  ParticipantReply twice = toMessage(reply);
  EXPECT_EQ("", problem(twice));
  twice.flow.push_back(twice.flow.front());
  EXPECT_EQ("2 flows, at most one fits", problem(twice));
}

}  // namespace
}  // namespace monarch_flight
