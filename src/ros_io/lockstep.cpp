#include "monarch_flight/ros_io/lockstep.h"

#include "monarch_flight/ros_io/conversions.h"

namespace monarch_flight {

LockstepLimits limitsFor(double watchdog_s) {
  LockstepLimits limits;
  limits.connect_s = std::max(30.0, watchdog_s);
  limits.exchange_s = watchdog_s;
  limits.start_s = 10.0 * watchdog_s;
  limits.silence_s = 3.0 * watchdog_s;
  return limits;
}

std::string inSeconds(double s) {
  const std::string text = std::to_string(s);
  return text.substr(0, text.find('.') + 2) + " s";
}

Hello makeHello(const LockstepIdentity& identity, std::uint64_t run, const std::string& refusal) {
  Hello hello;
  hello.protocol = kProtocolVersion;
  hello.run = run;
  hello.role = roleName(identity.role);
  hello.node = ros::this_node::getName();
  hello.case_name = identity.case_name;
  hello.case_sha256 = identity.case_sha256;
  hello.refusal = refusal;
  return hello;
}

std::string disagreement(const LockstepIdentity& own, const Hello& other) {
  std::string why;
  const auto add = [&why](const std::string& what) { why += (why.empty() ? "" : "; ") + what; };
  if (other.protocol != kProtocolVersion) {
    add("protocol version " + std::to_string(kProtocolVersion) + " here, " +
        std::to_string(other.protocol) + " in " + other.node + " (rebuild both)");
  }
  if (other.role != roleName(own.role)) {
    add(std::string("role ") + roleName(own.role) + " here, " + other.role + " in " + other.node);
  }
  if (other.case_sha256 != own.case_sha256) {
    add("case " + own.case_name + " (sha256 " + own.case_sha256.substr(0, 12) + ") here, " +
        other.case_name + " (sha256 " + other.case_sha256.substr(0, 12) + ") in " + other.node +
        " (start all nodes with the same case and keys)");
  }
  return why;
}

}  // namespace monarch_flight
