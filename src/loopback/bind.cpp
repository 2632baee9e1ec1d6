// Part of the node programs, not of a library: others that link this package keep their bind.
#include <dlfcn.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cstring>

#include "monarch_flight/ros_io/loopback.h"

/// Stands before the C library's function of this name; passes on what it gets, but for the address
/// while startOnLoopback opens its ports.
extern "C" int bind(int socket, const sockaddr* address, socklen_t size) {
  using Bind = int (*)(int, const sockaddr*, socklen_t);
  static const Bind next = reinterpret_cast<Bind>(dlsym(RTLD_NEXT, "bind"));
  if (!monarch_flight::loopbackOnly() || address->sa_family != AF_INET ||
      size < sizeof(sockaddr_in)) {
    return next(socket, address, size);
  }
  sockaddr_in narrow;
  std::memcpy(&narrow, address, sizeof narrow);
  if (narrow.sin_addr.s_addr == htonl(INADDR_ANY)) narrow.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return next(socket, reinterpret_cast<const sockaddr*>(&narrow), sizeof narrow);
}
