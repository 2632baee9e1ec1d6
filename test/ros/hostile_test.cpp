// Broken, stale, foreign, repeated and forged messages on every topic of the protocol while the
// real nodes fly: refused, counted, and without a trace in the flight. MONARCH_HOSTILE_MESSAGES is
// the number on each topic (monarch hostile).
#include <diagnostic_msgs/DiagnosticArray.h>

#include <cstdio>
#include <set>

#include "ros/attacker.h"
#include "ros/nodes_fixture.h"

namespace monarch_flight {
namespace {

unsigned messagesPerTopic() {
  const char* given = std::getenv("MONARCH_HOSTILE_MESSAGES");
  return given != nullptr ? static_cast<unsigned>(std::atoi(given)) : 300;
}

/// All four topics of every role.
struct Attackers {
  Attackers(ros::NodeHandle& node, const std::vector<std::string>& roles) {
    unsigned seed = 1;
    const Token token(kTestToken);
    for (const std::string& role : roles) {
      const std::string place = "/monarch_flight/" + role + "/";
      greetings.push_back(make<Hello>(node, place + "coordinator_hello", token, seed));
      greetings.push_back(make<Hello>(node, place + "hello", token, seed));
      requests.push_back(make<ParticipantRequest>(node, place + "request", token, seed));
      replies.push_back(make<ParticipantReply>(node, place + "reply", token, seed));
    }
  }
  template <class Message>
  static std::unique_ptr<Attacker<Message>> make(ros::NodeHandle& node, const std::string& topic,
                                                 const Token& token, unsigned& seed) {
    return std::make_unique<Attacker<Message>>(node, topic, token, seed++);
  }
  template <class Action>
  void each(Action action) {
    for (auto& a : greetings) action(*a);
    for (auto& a : requests) action(*a);
    for (auto& a : replies) action(*a);
  }
  /// Topics where nothing was heard yet, or too few listen; they are sought anew.
  std::string missing() {
    std::string topics;
    each([&topics](auto& a) {
      if (a.ready()) return;
      topics += a.topic() + " ";
      a.listen();
    });
    return topics;
  }
  bool ready() {
    bool all = true;
    each([&all](const auto& a) { all = all && a.ready(); });
    return all;
  }
  std::vector<std::unique_ptr<Attacker<Hello>>> greetings;
  std::vector<std::unique_ptr<Attacker<ParticipantRequest>>> requests;
  std::vector<std::unique_ptr<Attacker<ParticipantReply>>> replies;
};

/// What the coordinator says on /diagnostics that all nodes have refused so far.
class Refused {
 public:
  explicit Refused(ros::NodeHandle& node)
      : subscriber_(node.subscribe("/diagnostics", 10, &Refused::onDiagnostics, this)) {}
  double strange = 0.0;  ///< forged, foreign and malformed ones
  double old = 0.0;      ///< late and repeated ones

 private:
  void onDiagnostics(const diagnostic_msgs::DiagnosticArrayConstPtr& all) {
    for (const auto& status : all->status) {
      if (status.name.find("coordinator: messages") == std::string::npos) continue;
      strange = old = 0.0;
      for (const auto& entry : status.values) {
        const bool is_old = entry.key == "late" || entry.key == "repeated";
        (is_old ? old : strange) += std::stod(entry.value);
      }
    }
  }
  ros::Subscriber subscriber_;
};

/// Spins until `done`, or the limit.
template <class Condition>
bool spinUntil(Condition done, double limit_s) {
  const ros::SteadyTime end = ros::SteadyTime::now() + ros::WallDuration(limit_s);
  while (!done() && ros::SteadyTime::now() < end) {
    ros::spinOnce();
    ros::WallDuration(0.01).sleep();
  }
  return done();
}

/// An attack on a flight of some roles.
class HostileMessages : public Nodes {
 protected:
  void attack(Sent& sent, const std::vector<std::string>& roles) {
    ros::NodeHandle node;
    Attackers attackers(node, roles);
    Refused refused(node);
    std::string missing;
    for (int attempt = 0; attempt < 4 && !attackers.ready(); ++attempt) {
      if (!spinUntil([&] { return attackers.ready(); }, 5.0)) missing = attackers.missing();
    }
    ASSERT_TRUE(attackers.ready()) << missing << "\n" << coordinator->output();
    for (unsigned i = 0; i < messages_; ++i) {
      attackers.each([&sent](auto& a) { a.send(sent); });
      ros::spinOnce();
      ros::WallDuration(0.002).sleep();
    }
    const double strange = static_cast<double>(sent.forged + sent.foreign + sent.malformed);
    const double old = static_cast<double>(sent.replayed + sent.early);
    const auto all_counted = [&] { return refused.strange >= strange && refused.old >= old; };
    EXPECT_TRUE(spinUntil(all_counted, 30.0 + 0.03 * messages_))
        << refused.strange << " of " << strange << ", " << refused.old << " of " << old;
    ASSERT_TRUE(coordinator->running()) << "the flight was over before the attack\n"
                                        << coordinator->output();
  }
  /// The flight lasts as long as the attack, and is then stopped by hand; one alone must equal it.
  void leaveNoTrace(const std::vector<std::string>& roles, const std::string& wings) {
    ros::param::set("/monarch_flight/wings", wings);
    ros::param::set("/monarch_flight/flaps", 200.0 + 0.05 * messages_);
    ros::param::set("/monarch_flight/record", false);
    startRoles(roles);
    Sent sent;
    ASSERT_NO_FATAL_FAILURE(attack(sent, roles));
    coordinator->send(SIGINT);
    EXPECT_EQ(130, coordinator->wait(30.0)) << coordinator->output();
    endWell();
    compareWithOneAlone(sent, roles, wings);
  }
  void startRoles(const std::vector<std::string>& roles) {
    startAll();
    for (const std::string& role : roles) {
      if (role == "fluid_left") fluid_left = start("fluid", role, {"__name:=fluid_left"});
      if (role == "guidance") guidance = start("own_guidance_node");
    }
  }
  void endWell() {
    for (Process* node :
         {fluid.get(), fluid_left.get(), flight.get(), wing.get(), guidance.get()}) {
      if (node != nullptr) {
        EXPECT_EQ(0, node->wait(5.0)) << node->output();
      }
    }
  }
  /// As many steps without an attack: in one process, or over nodes where a node leads.
  nlohmann::json undisturbed(int steps, const std::vector<std::string>& roles,
                             const std::string& wings) {
    const std::string flaps = std::to_string(steps / 500.0), out = folder / "alone";
    const double limit = 60.0 + 0.05 * messages_;
    if (roles.back() == "guidance") {
      ros::param::set("/monarch_flight/flaps", flaps);
      ros::param::set("/monarch_flight/out", out);
      startRoles(roles);
      EXPECT_EQ(0, coordinator->wait(limit)) << coordinator->output();
      endWell();
    } else {
      Process alone(std::string(NODE_DIR) + "/fly_in_process",
                    {"case:=climb_printed", "fluid:=quasi_steady", "record:=false",
                     "wings:=" + wings, "flaps:=" + flaps, "out:=" + out},
                    folder / "alone.log");
      EXPECT_EQ(0, alone.wait(limit)) << alone.output();
    }
    return summary("alone");
  }
  void compareWithOneAlone(const Sent& sent, const std::vector<std::string>& roles,
                           const std::string& wings) {
    const nlohmann::json attacked = summary();
    const int steps = attacked["steps"];
    const nlohmann::json alone = undisturbed(steps, roles, wings),
                         &ignored = attacked["ignored_messages"];
    std::printf(
        "steps: %d; sent: %lu forged, %lu foreign, %lu malformed, %lu old, %lu early\nignored: "
        "%s\n",
        steps, sent.forged, sent.foreign, sent.malformed, sent.replayed, sent.early,
        ignored.dump().c_str());
    EXPECT_EQ(steps, alone["steps"]);
    EXPECT_EQ(alone["state_sha256"], attacked["state_sha256"]);
    EXPECT_EQ(4u * roles.size() * messages_, sent.all());
    EXPECT_EQ(sent.forged, ignored["forged"]);
    EXPECT_EQ(sent.foreign, ignored["foreign"]);
    EXPECT_EQ(sent.malformed, ignored["malformed"]);
    EXPECT_GE(ignored["late"].get<std::uint64_t>() + ignored["repeated"].get<std::uint64_t>(),
              sent.replayed + sent.early);
  }

  const unsigned messages_ = messagesPerTopic();
};

TEST_F(HostileMessages, LeaveNoTraceInTheFlight) {
  leaveNoTrace({"fluid", "flight", "wing"}, "mirrored");
}

TEST_F(HostileMessages, LeaveNoTraceInAFlightOfTwoFluids) {
  leaveNoTrace({"fluid", "fluid_left", "flight", "wing"}, "independent");
}

TEST_F(HostileMessages, LeaveNoTraceInAFlightOfFiveRoles) {
  ros::param::set("/monarch_flight/guidance", "node");
  leaveNoTrace({"fluid", "fluid_left", "flight", "wing", "guidance"}, "independent");
}

TEST_F(Nodes, AStrangerCannotPlayTheCoordinator) {
  ros::NodeHandle node;
  Hello stranger;
  stranger.protocol = ParticipantRequest::PROTOCOL;
  stranger.run = 77;
  stranger.role = "wing";
  stranger.node = "/stranger";
  Token("guessed").seal("/monarch_flight/wing/coordinator_hello", stranger);
  const ros::Publisher hello =
      node.advertise<Hello>("/monarch_flight/wing/coordinator_hello", 1, true);
  hello.publish(stranger);
  wing = start("wing");
  for (int i = 0; i < 300 && hello.getNumSubscribers() == 0; ++i) ros::WallDuration(0.02).sleep();
  ros::WallDuration(0.5).sleep();
  EXPECT_TRUE(wing->running()) << wing->output();  // it would have refused such a coordinator
  coordinator = start("coordinator");
  fluid = start("fluid");
  flight = start("flight");
  EXPECT_EQ(0, coordinator->wait(40.0)) << coordinator->output();
  // More than once where a slow node has subscribed anew: the stranger's hello is latched.
  EXPECT_GE(summary()["ignored_messages"]["forged"], 1u);
}

TEST_F(Nodes, WithoutATokenAPersonIsWarned) {
  ros::param::del("/monarch_flight/token_file");
  startAll();
  EXPECT_EQ(0, coordinator->wait(40.0)) << coordinator->output();
  EXPECT_TRUE(contains(coordinator->output(), "/monarch_flight/token_file is not set"));
}

/// What a process has open, as "socket:[inode]".
std::set<std::string> openFiles(pid_t pid) {
  std::set<std::string> open;
  const std::string folder = "/proc/" + std::to_string(pid) + "/fd/";
  for (int fd = 0; fd < 100; ++fd) {
    char target[100] = {};
    if (readlink((folder + std::to_string(fd)).c_str(), target, sizeof target - 1) > 0) {
      open.emplace(target);
    }
  }
  return open;
}

/// Addresses at which a child listens, as /proc/net/tcp writes them (hexadecimal), without the
/// sockets that it has inherited from this process.
std::vector<std::string> listeningAddresses(pid_t pid) {
  const std::set<std::string> its = openFiles(pid), mine = openFiles(getpid());
  std::vector<std::string> addresses;
  std::ifstream table("/proc/net/tcp");
  std::string line;
  std::getline(table, line);
  while (std::getline(table, line)) {
    std::istringstream words(line);
    std::string number, local, remote, state, skip, inode;
    words >> number >> local >> remote >> state >> skip >> skip >> skip >> skip >> skip >> inode;
    const std::string socket = "socket:[" + inode + "]";
    const bool own = its.count(socket) > 0 && mine.count(socket) == 0;
    if (state == "0A" && own) addresses.push_back(local.substr(0, 8));
  }
  return addresses;
}

TEST_F(Nodes, ListenOnTheLoopbackAddressOnly) {
  unsetenv("ROS_HOSTNAME");  // with_master.py has set it
  unsetenv("ROS_IP");
  wing = start("wing");
  setenv("ROS_HOSTNAME", "localhost", 1);
  std::vector<std::string> addresses;  // messages and XML-RPC
  for (int i = 0; i < 300 && addresses.size() < 2; ++i) {
    ros::WallDuration(0.1).sleep();
    addresses = listeningAddresses(wing->pid());
  }
  ASSERT_TRUE(wing->running()) << wing->output();
  EXPECT_GE(addresses.size(), 2u);
  for (const std::string& address : addresses) EXPECT_EQ("0100007F", address);
}

}  // namespace
}  // namespace monarch_flight
