// Who may fly with whom: the handshake of the lockstep protocol, over a real master.
#include "ros/lockstep_fixture.h"

namespace monarch_flight {
namespace {

TEST_F(Lockstep, DifferentCasesAreRefusedOnBothSides) {
  LockstepIdentity other = fluid;
  other.case_name = "hinge";
  other.case_sha256 = std::string(64, 'b');
  startServer(other);
  client = std::make_unique<RosParticipant>(node, fluid, run);
  try {
    client->connect();
    FAIL() << "the client agreed";
  } catch (const ExchangeError& e) {
    const std::string what = e.what();
    EXPECT_NE(std::string::npos, what.find("the fluid node")) << what;
    EXPECT_NE(std::string::npos, what.find("hinge (sha256 bbbbbbbbbbbb)")) << what;
    EXPECT_NE(std::string::npos, what.find("climb (sha256 aaaaaaaaaaaa)")) << what;
  }
  joinServer();
  EXPECT_NE(std::string::npos, server_end.find("handshake refused")) << server_end;
  EXPECT_NE(std::string::npos, server_end.find("climb (sha256 aaaaaaaaaaaa)")) << server_end;
  EXPECT_EQ(0, solver.computed);
}

TEST_F(Lockstep, AnotherProtocolVersionIsRefused) {
  client = std::make_unique<RosParticipant>(node, fluid, run);
  Hello hello = makeHello(fluid, run.id);
  hello.protocol = 99;
  ros::Publisher raw = node.advertise<Hello>("fluid/hello", 8, true);
  raw.publish(sealed("hello", hello));
  try {
    client->connect();
    FAIL() << "the client agreed";
  } catch (const ExchangeError& e) {
    EXPECT_NE(std::string::npos,
              std::string(e.what()).find("protocol version " + std::to_string(kProtocolVersion) +
                                         " here, 99 in"));
  }
  Hello old = makeHello(fluid, 1);
  old.role = "wing";
  EXPECT_NE(std::string::npos, disagreement(fluid, old).find("role fluid here, wing in"));
  EXPECT_EQ("", disagreement(fluid, makeHello(fluid, 1)));
}

TEST_F(Lockstep, AnotherTokenIsNoHandshake) {
  LockstepIdentity stranger = fluid;
  stranger.token = Token("guessed");
  run.limits.connect_s = server_limits.connect_s = 0.7;
  startServer(stranger);
  client = std::make_unique<RosParticipant>(node, fluid, run);
  try {
    client->connect();
    FAIL() << "the client agreed";
  } catch (const ExchangeError& e) {
    const std::string what = e.what();
    EXPECT_NE(std::string::npos, what.find("did not answer the handshake within 0.7 s")) << what;
  }
  joinServer();
  EXPECT_NE(std::string::npos, server_end.find("with the same token? (1 messages")) << server_end;
  EXPECT_EQ(1u, server->counters().forged);
  EXPECT_EQ(0, solver.computed);
}

TEST_F(Lockstep, ASealIsGoodForItsTopicAndMessageOnly) {
  const Token token("secret");
  Hello hello = makeHello(fluid, 42);
  token.seal("/a/hello", hello);
  const auto bytesOf = [](const Hello& message) {
    std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(message));
    ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
    ros::serialization::serialize(stream, message);
    return bytes;
  };
  EXPECT_TRUE(token.sealed("/a/hello", bytesOf(hello)));
  EXPECT_FALSE(token.sealed("/b/hello", bytesOf(hello)));
  EXPECT_FALSE(Token("other").sealed("/a/hello", bytesOf(hello)));
  EXPECT_FALSE(Token().sealed("/a/hello", bytesOf(hello)));
  for (std::size_t i = 0; i < bytesOf(hello).size(); ++i) {
    std::vector<std::uint8_t> bytes = bytesOf(hello);
    bytes[i] ^= 4;
    EXPECT_FALSE(token.sealed("/a/hello", bytes)) << i;
  }
  EXPECT_FALSE(token.sealed("/a/hello", {}));
  EXPECT_FALSE(token.sealed("/a/hello", std::vector<std::uint8_t>(32, 0)));
}

TEST_F(Lockstep, AnAnswerToAnotherRunIsNoHandshake) {
  run.limits.connect_s = 0.5;
  client = std::make_unique<RosParticipant>(node, fluid, run);
  ros::Publisher raw = node.advertise<Hello>("fluid/hello", 8, true);
  raw.publish(sealed("hello", makeHello(fluid, run.id + 1)));
  EXPECT_THROW(client->connect(), ExchangeError);
  EXPECT_EQ(1u, client->counters().foreign);
}

TEST_F(Lockstep, AMissingParticipantIsNamed) {
  run.limits.connect_s = 0.5;
  client = std::make_unique<RosParticipant>(node, fluid, run);
  try {
    client->connect();
    FAIL() << "connected to nobody";
  } catch (const ExchangeError& e) {
    EXPECT_NE(std::string::npos, std::string(e.what()).find(
                                     "the fluid node did not answer the handshake within 0.5 s"));
  }
}

TEST_F(Lockstep, AMissingCoordinatorIsNoticed) {
  server_limits.connect_s = 0.5;
  startServer(fluid);
  joinServer();
  EXPECT_NE(std::string::npos, server_end.find("no coordinator appeared within 0.5 s"));
}

TEST(Limits, FollowFromTheWatchdog) {
  const LockstepLimits limits = limitsFor(60.0);
  EXPECT_EQ(60.0, limits.exchange_s);
  EXPECT_EQ(60.0, limits.connect_s);
  EXPECT_EQ(600.0, limits.start_s);  // CHECKPOINT and RESTORE too: lockstep_test
  EXPECT_EQ(180.0, limits.silence_s);
  EXPECT_EQ(30.0, limitsFor(2.0).connect_s);
}

// Both ends subscribe anew to what is missing; who comes meanwhile is found as if nothing had been.
TEST_F(Lockstep, WhoComesAfterTheOtherHasSubscribedAnewIsFound) {
  const ros::WallDuration late = kRenewal + ros::WallDuration(0.5);
  run.limits.connect_s = server_limits.connect_s = 30.0;
  client = std::make_unique<RosParticipant>(node, fluid, run);
  std::thread solver_comes([&] {
    late.sleep();
    startServer(fluid);
  });
  EXPECT_NO_THROW(client->connect());
  solver_comes.join();
  EXPECT_EQ("", client->exchange(request(0, 0, Phase::kStart)).error);
  client->exchange(request(0, 0, Phase::kAbort));
  client.reset();
  joinServer();
  EXPECT_EQ("ended", server_end);

  startServer(fluid);
  late.sleep();
  client = std::make_unique<RosParticipant>(node, fluid, run);
  EXPECT_NO_THROW(client->connect());
  EXPECT_EQ("", client->exchange(request(0, 0, Phase::kStart)).error);
  EXPECT_EQ(0u, client->ignored().total());
}

}  // namespace
}  // namespace monarch_flight
