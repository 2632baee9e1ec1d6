#pragma once
#include <pthread.h>

#include <csignal>
#include <thread>
#include <utility>

namespace monarch_flight::fluid::processes {

/// A thread that is sent no signals: these are for the main thread.
template <class Body>
std::thread quietThread(Body body) {
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread thread(std::move(body));
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return thread;
}

}  // namespace monarch_flight::fluid::processes
