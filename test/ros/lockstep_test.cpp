// The lockstep protocol over a real master: both ends, and messages that should not be there.
#include "ros/lockstep_fixture.h"

namespace monarch_flight {
namespace {

TEST_F(Lockstep, EveryExchangeIsAnsweredOnce) {
  connect();
  const Reply start = client->exchange(request(0, 0, Phase::kStart));
  EXPECT_EQ((ExchangeKey{42, 0, 0, Phase::kStart}), start.key);
  for (std::uint32_t step = 1; step <= 20; ++step) {
    for (std::uint32_t k = 0; k < 5; ++k) {
      const Reply reply = client->exchange(request(step, k, Phase::kIterate));
      EXPECT_EQ((ExchangeKey{42, step, k, Phase::kIterate}), reply.key);
      EXPECT_EQ(Eigen::Vector2d(step, k), reply.loads.force_pressure.head<2>());
    }
    client->exchange(request(step, 4, Phase::kCommit));
  }
  EXPECT_EQ(1 + 20 * 6, solver.computed);
  EXPECT_EQ(0u, client->counters().total());
  client->exchange(request(20, 0, Phase::kAbort));
  client.reset();
  joinServer();
  EXPECT_EQ("ended", server_end);
  EXPECT_EQ(0u, server->counters().total());
}

TEST_F(Lockstep, ARepeatedRequestIsAnsweredFromTheCache) {
  connect();
  client->exchange(request(0, 0, Phase::kStart));
  const Reply first = client->exchange(request(1, 0, Phase::kIterate));
  const Reply again = client->exchange(request(1, 0, Phase::kIterate));
  EXPECT_EQ(first.loads.force_pressure, again.loads.force_pressure);
  EXPECT_EQ(2, solver.computed);
  EXPECT_EQ(1u, server->counters().repeated);
}

TEST_F(Lockstep, TheServerIgnoresLateForeignAndMalformedRequests) {
  connect();
  client->exchange(request(0, 0, Phase::kStart));
  client->exchange(request(1, 0, Phase::kIterate));
  client->exchange(request(1, 0, Phase::kCommit));
  const ros::Publisher raw = injector<ParticipantRequest>("request");
  raw.publish(sealed("request", toMessage(request(1, 0, Phase::kIterate))));
  ParticipantRequest foreign = toMessage(request(2, 0, Phase::kIterate));
  foreign.key.run = 43;
  raw.publish(sealed("request", foreign));
  ParticipantRequest malformed = toMessage(request(2, 0, Phase::kIterate));
  malformed.key.phase = 9;
  raw.publish(sealed("request", malformed));
  malformed = toMessage(request(2, 0, Phase::kIterate));
  malformed.protocol = 99;
  raw.publish(sealed("request", malformed));
  foreign.key.phase = CouplingKey::ABORT;
  raw.publish(sealed("request", foreign));  // may not end this run either
  int asked = 0;
  EXPECT_TRUE(eventually([&] {  // its counts come with its answers
    const Reply next = client->exchange(request(2, asked, Phase::kIterate));
    EXPECT_EQ(2.0, next.loads.force_pressure.x());
    EXPECT_EQ(3 + ++asked, solver.computed);
    const IgnoredMessages c = client->ignored();
    return c.late == 1 && c.foreign == 2 && c.malformed == 2;
  })) << client->ignored().describe();
}

TEST_F(Lockstep, TheClientIgnoresLateRepeatedForeignAndMalformedReplies) {
  connect();
  client->exchange(request(0, 0, Phase::kStart));
  client->exchange(request(1, 0, Phase::kIterate));
  const ros::Publisher raw = injector<ParticipantReply>("reply");
  Reply wrong;
  wrong.loads.force_pressure.setConstant(1e9);
  wrong.key = {42, 1, 0, Phase::kIterate};
  raw.publish(sealed("reply", toMessage(wrong)));  // repeated: this exchange has its answer
  wrong.key = {42, 0, 0, Phase::kStart};
  raw.publish(sealed("reply", toMessage(wrong)));  // late
  wrong.key = {43, 1, 1, Phase::kIterate};
  raw.publish(sealed("reply", toMessage(wrong)));  // foreign, with the key of the next exchange
  ParticipantReply malformed = toMessage(wrong);
  malformed.protocol = 99;
  raw.publish(sealed("reply", malformed));
  ros::WallDuration(0.2).sleep();
  const Reply reply = client->exchange(request(1, 1, Phase::kIterate));
  EXPECT_EQ(Eigen::Vector3d(1, 1, 3), reply.loads.force_pressure);
  const IgnoredMessages& c = client->counters();
  EXPECT_EQ(1u, c.foreign);
  EXPECT_EQ(1u, c.malformed);
  EXPECT_EQ(2u, c.late + c.repeated);
}

TEST_F(Lockstep, AMissingReplyEndsInTheWatchdogWithItsName) {
  solver.slow_phase = Phase::kIterate;
  solver.dawdle_s = 2.0;
  connect();
  client->exchange(request(0, 0, Phase::kStart));
  const ros::WallTime begin = ros::WallTime::now();
  const std::string failure = failureOf(*client, request(7, 3, Phase::kIterate));
  const double waited = (ros::WallTime::now() - begin).toSec();
  EXPECT_NE(std::string::npos, failure.find("the fluid node")) << failure;
  EXPECT_NE(std::string::npos, failure.find("step 7, sub-iteration 3, ITERATE within 1.0 s"));
  EXPECT_GE(waited, 1.0);
  EXPECT_LT(waited, 1.5);
}

// One solver writes or reads a large flow; those that wait do not take it for silence.
TEST_F(Lockstep, ACheckpointMayTakeAsLongAsAStart) {
  run.limits.start_s = 10.0;
  server_limits.silence_s = 1.0;
  solver.dawdle_s = 2.0;
  ScriptedSolver other_solver;
  LockstepIdentity wing = fluid;
  wing.role = Role::kWing;
  LockstepServer other(node, wing, other_solver, server_limits, server_stop);
  std::string other_end = "ended";
  std::thread other_thread([&] {
    try {
      other.serve();
    } catch (const std::exception& e) {
      other_end = e.what();
    }
  });
  RosParticipant waiting(node, wing, run);
  connect();
  waiting.connect();
  client->exchange(request(0, 0, Phase::kStart));
  waiting.exchange(request(0, 0, Phase::kStart));
  solver.slow_phase = Phase::kRestore;
  EXPECT_EQ("", failureOf(*client, request(1, 0, Phase::kRestore)));
  client->exchange(request(2, 0, Phase::kIterate));
  waiting.exchange(request(2, 0, Phase::kIterate));
  solver.slow_phase = Phase::kCheckpoint;
  EXPECT_EQ("", failureOf(*client, request(1, 0, Phase::kCheckpoint)));
  EXPECT_EQ("", failureOf(waiting, request(2, 0, Phase::kCommit)));
  client->exchange(request(2, 0, Phase::kAbort));
  waiting.exchange(request(2, 0, Phase::kAbort));
  server_stop = true;
  other_thread.join();
  EXPECT_TRUE(other_end.find("silent") == std::string::npos) << other_end;
}

TEST_F(Lockstep, AnAnswerThatComesTooLateIsNotTakenForTheNext) {
  solver.slow_phase = Phase::kIterate;
  solver.dawdle_s = 1.3;
  connect();
  client->exchange(request(0, 0, Phase::kStart));
  failureOf(*client, request(1, 0, Phase::kIterate));
  ros::WallDuration(0.6).sleep();
  const Reply reply = client->exchange(request(1, 0, Phase::kCommit));
  EXPECT_EQ(Phase::kCommit, reply.key.phase);
  EXPECT_EQ(3, solver.computed);  // the requests sent again came from the cache
  EXPECT_EQ(3u, server->counters().repeated);
  EXPECT_EQ(4u, client->counters().late + client->counters().repeated);
  EXPECT_EQ(3u + 4u, client->ignored().total());
}

TEST_F(Lockstep, ALostRequestIsAskedAgain) {
  // A participant by hand that overhears the first request of the exchange.
  ros::CallbackQueue queue;
  ros::NodeHandle hand(node, "fluid");
  hand.setCallbackQueue(&queue);
  int heard = 0;
  ros::Publisher replies = hand.advertise<ParticipantReply>("reply", 8);
  ros::Publisher hello = hand.advertise<Hello>("hello", 8, true);
  ros::Subscriber requests = hand.subscribe<ParticipantRequest>(
      "request", 8, [&](const ParticipantRequestConstPtr& request) {
        if (++heard == 1) return;
        Reply reply;
        reply.key = fromMessage(request->key);
        replies.publish(sealed("reply", toMessage(reply)));
      });
  ros::Subscriber greeting = hand.subscribe<Hello>(
      "coordinator_hello", 8,
      [&](const HelloConstPtr& h) { hello.publish(sealed("hello", makeHello(fluid, h->run))); });
  ros::AsyncSpinner spinner(1, &queue);
  spinner.start();
  client = std::make_unique<RosParticipant>(node, fluid, run);
  client->connect();
  const Reply reply = client->exchange(request(1, 0, Phase::kIterate));
  EXPECT_EQ((ExchangeKey{42, 1, 0, Phase::kIterate}), reply.key);
  EXPECT_EQ(2, heard);
  spinner.stop();
}

TEST_F(Lockstep, ANumberThatIsNotFiniteIsAnErrorAtTheBoundary) {
  connect();
  client->exchange(request(0, 0, Phase::kStart));
  solver.broken = true;
  const Reply reply = client->exchange(request(1, 0, Phase::kIterate));
  EXPECT_NE(std::string::npos, reply.error.find("not finite at step 1, sub-iteration 0, ITERATE"));
}

TEST_F(Lockstep, ALostCoordinatorIsNoticed) {
  connect();
  client->exchange(request(0, 0, Phase::kStart));
  client.reset();
  const ros::WallTime begin = ros::WallTime::now();
  joinServer();
  EXPECT_NE(std::string::npos, server_end.find("is lost")) << server_end;
  EXPECT_LT((ros::WallTime::now() - begin).toSec(), 1.0);
}

TEST_F(Lockstep, ASilentCoordinatorIsNoticed) {
  server_limits.silence_s = 0.5;
  connect();
  client->exchange(request(0, 0, Phase::kStart));
  client->exchange(request(1, 0, Phase::kIterate));
  joinServer();
  EXPECT_NE(std::string::npos, server_end.find("has been silent for 0.5 s")) << server_end;
}

TEST_F(Lockstep, ALostParticipantIsNoticedAtOnce) {
  connect();
  client->exchange(request(0, 0, Phase::kStart));
  endServer();
  server.reset();
  const ros::WallTime begin = ros::WallTime::now();
  const std::string failure = failureOf(*client, request(1, 0, Phase::kIterate));
  EXPECT_NE(std::string::npos, failure.find("the fluid node (")) << failure;
  EXPECT_NE(std::string::npos, failure.find("is lost")) << failure;
  EXPECT_NE(std::string::npos, failure.find("step 1, sub-iteration 0, ITERATE")) << failure;
  EXPECT_LT((ros::WallTime::now() - begin).toSec(), 0.5);
}

TEST_F(Lockstep, AnInterruptEndsAWait) {
  solver.slow_phase = Phase::kIterate;
  solver.dawdle_s = 0.9;
  run.limits.grace_s = 0.1;
  connect();
  client->exchange(request(0, 0, Phase::kStart));
  std::thread interrupt([this] {
    ros::WallDuration(0.2).sleep();
    stop = true;
  });
  const ros::WallTime begin = ros::WallTime::now();
  const std::string failure = failureOf(*client, request(1, 0, Phase::kIterate));
  interrupt.join();
  EXPECT_NE(std::string::npos, failure.find("interrupted while waiting for the fluid node"));
  EXPECT_LT((ros::WallTime::now() - begin).toSec(), 0.5);
}

}  // namespace
}  // namespace monarch_flight
