#include "monarch_flight/ros_io/loopback.h"

#include <dlfcn.h>
#include <netinet/in.h>
#include <ros/network.h>
#include <ros/ros.h>
#include <sys/socket.h>

#include <atomic>
#include <cstdlib>
#include <cstring>

namespace {

std::atomic<bool> loopback_only{false};

}  // namespace

/// Stands before the C library's function of this name for everything that this library is linked
/// with; passes on what it gets, but for the address while loopback_only is set.
extern "C" int bind(int socket, const sockaddr* address, socklen_t size) {
  using Bind = int (*)(int, const sockaddr*, socklen_t);
  static const Bind next = reinterpret_cast<Bind>(dlsym(RTLD_NEXT, "bind"));
  if (!loopback_only || address->sa_family != AF_INET || size < sizeof(sockaddr_in)) {
    return next(socket, address, size);
  }
  sockaddr_in narrow;
  std::memcpy(&narrow, address, sizeof narrow);
  if (narrow.sin_addr.s_addr == htonl(INADDR_ANY)) narrow.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return next(socket, reinterpret_cast<const sockaddr*>(&narrow), sizeof narrow);
}

namespace monarch_flight {

void preferLoopback() {
  if (std::getenv("ROS_IP") == nullptr && std::getenv("ROS_HOSTNAME") == nullptr) {
    setenv("ROS_HOSTNAME", "localhost", 1);
  }
}

void startOnLoopback() {
  const std::string& host = ros::network::getHost();
  loopback_only = host == "localhost" || host.rfind("127.", 0) == 0;
  ros::start();
  loopback_only = false;
}

}  // namespace monarch_flight
