#include "fluid/processes/shared_flow.h"

#include <algorithm>
#include <iostream>
#include <stdexcept>
#include <string>
#include <typeinfo>
#include <utility>

#include "fluid/pressure/blas.h"
#include "fluid/processes/peer_watch.h"
#include "monarch_flight/math/errors.h"

namespace monarch_flight::fluid::processes {
namespace {

enum class Order : int {
  kMake,
  kStart,
  kEvaluate,
  kCommit,
  kSave,
  kRestore,
  kSurface,
  kPicture,
  kField,
  kLeave
};

// Of the watchdog: a process that hangs is named before the coordinator gives up the whole node.
constexpr double kWaitByWatchdog = 0.8;

int rankIn(MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  return rank;
}

/// Whom a process waits for when process 0 tells something.
int sender(MPI_Comm comm) { return rankIn(comm) == 0 ? WatchSlot::kEverybody : 0; }

/// Times that limit in which a wait may end within the call, as the coordinator waits for it.
int patience(Order order) {
  const bool once = order == Order::kMake || order == Order::kStart || order == Order::kSave ||
                    order == Order::kRestore || order == Order::kField;
  return once ? 10 : 1;
}

/// Values of process 0 to all. Motions are plain numbers and travel as bytes.
template <class T>
void share(MPI_Comm comm, T& value) {
  const PeerWait wait(sender(comm));
  MPI_Bcast(&value, sizeof(T), MPI_BYTE, 0, comm);
}

template <class T, class A>
void share(MPI_Comm comm, std::vector<T, A>& values) {
  long n = static_cast<long>(values.size());
  share(comm, n);
  values.resize(n);
  const long chunk = 1L << 28;  // bytes: MPI counts are int
  char* bytes = reinterpret_cast<char*>(values.data());
  for (long at = 0, end = n * static_cast<long>(sizeof(T)); at < end; at += chunk) {
    const PeerWait wait(sender(comm));
    MPI_Bcast(bytes + at, static_cast<int>(std::min(chunk, end - at)), MPI_BYTE, 0, comm);
  }
}

/// A process has failed alone: the others wait for it for ever, and only the end of them all helps.
bool lost = false;

/// Whether all processes fail like this together, so that they are still in step.
bool alike(const std::exception& e) {
  return dynamic_cast<const InputError*>(&e) != nullptr ||
         dynamic_cast<const NumericalError*>(&e) != nullptr ||
         dynamic_cast<const std::invalid_argument*>(&e) != nullptr ||
         typeid(e) == typeid(std::logic_error);
}

void give(MPI_Comm comm, Order order) {
  if (lost) throw std::runtime_error("the flow's processes are out of step after a failure of one");
  PeerWatch::call(patience(order));
  share(comm, order);
}

/// The next call of process 0, however long that takes.
Order taken(MPI_Comm comm) {
  Order order = Order::kLeave;
  {
    const PeerWait wait(WatchSlot::kCall);
    MPI_Bcast(&order, sizeof order, MPI_BYTE, 0, comm);
  }
  PeerWatch::call(patience(order));
  return order;
}

/// Process 0's part of a call.
template <class Call>
auto here(Call call) {
  try {
    return call();
  } catch (const std::exception& e) {
    lost = !alike(e);
    throw;
  }
}

/// Ends all processes with the reason.
void endAll(MPI_Comm comm, const std::string& why) {
  const int rank = rankIn(comm);
  // In one piece, so that no other process writes into it.
  std::cerr << "process " + std::to_string(rank) + " of the flow failed alone: " + why + "\n"
            << std::flush;
  MPI_Abort(comm, 1);
}

std::unique_ptr<NavierStokes> make(MPI_Comm comm, double watchdog_s, Grid grid, Air air,
                                   double length, double limit, int threads) {
  share(comm, threads);
  pressure::takeBlasBuffers(threads);  // before the grid is there
  share(comm, watchdog_s);
  PeerWatch::limit(kWaitByWatchdog * watchdog_s);
  share(comm, grid.x.face);
  share(comm, grid.y.face);
  share(comm, grid.z.face);
  share(comm, grid.wing);
  share(comm, grid.k_wing);
  share(comm, grid.open);
  share(comm, air);
  share(comm, length);
  share(comm, limit);
  Grid whole = makeGrid(Axis::fromFaces(grid.x.face), Axis::fromFaces(grid.y.face),
                        Axis::fromFaces(grid.z.face), grid.k_wing, grid.open, grid.wing);
  return std::make_unique<NavierStokes>(std::move(whole), air, length, limit, comm, threads);
}

}  // namespace

SharedFlow::SharedFlow(const Grid& grid, const Air& air, double reference_length,
                       double courant_limit, MPI_Comm comm, double watchdog_s, int threads)
    : comm_(comm) {
  give(comm_, Order::kMake);
  flow_ = here(
      [&] { return make(comm_, watchdog_s, grid, air, reference_length, courant_limit, threads); });
}

void SharedFlow::start(const WingMotion& motion, double dt) {
  give(comm_, Order::kStart);
  WingMotion m = motion;
  share(comm_, m);
  share(comm_, dt);
  here([&] { flow_->start(m, dt); });
}

Loads SharedFlow::evaluate(const WingMotion& next) {
  give(comm_, Order::kEvaluate);
  WingMotion m = next;
  share(comm_, m);
  return here([&] { return flow_->evaluate(m); });
}

void SharedFlow::commit() {
  give(comm_, Order::kCommit);
  here([&] { flow_->commit(); });
}

std::vector<char> SharedFlow::save() const {
  give(comm_, Order::kSave);
  return here([&] { return flow_->save(); });
}

void SharedFlow::restore(const std::vector<char>& bytes) {
  give(comm_, Order::kRestore);
  here([&] {
    std::vector<char> all = bytes;
    share(comm_, all);
    flow_->restore(all);
  });
}

SurfacePressure SharedFlow::surfacePressure() const {
  give(comm_, Order::kSurface);
  return here([&] { return flow_->surfacePressure(); });
}

FlowPicture SharedFlow::flowPicture(std::size_t limit) const {
  give(comm_, Order::kPicture);
  share(comm_, limit);
  return here([&] { return flow_->flowPicture(limit); });
}

std::shared_ptr<const FlowField> SharedFlow::flowField() const {
  give(comm_, Order::kField);
  return here([&] { return flow_->flowField(); });
}

void SharedFlow::dismiss(MPI_Comm comm) {
  if (lost) endAll(comm, "the reason is above");
  give(comm, Order::kLeave);
}

void SharedFlow::serve(MPI_Comm comm) {
  std::unique_ptr<NavierStokes> flow;
  WingMotion motion;
  std::vector<char> bytes;
  double number = 0;
  std::size_t points = 0;
  while (true) {
    try {
      switch (taken(comm)) {
        case Order::kMake:
          flow.reset();  // never two of them
          flow = make(comm, 0, Grid(), Air(), 0, 0, 1);
          break;
        case Order::kStart:
          share(comm, motion), share(comm, number), flow->start(motion, number);
          break;
        case Order::kEvaluate:
          share(comm, motion), flow->evaluate(motion);
          break;
        case Order::kCommit:
          flow->commit();
          break;
        case Order::kSave:
          flow->save();
          break;
        case Order::kRestore:
          share(comm, bytes), flow->restore(bytes);
          break;
        case Order::kSurface:
          flow->surfacePressure();
          break;
        case Order::kPicture:
          share(comm, points), flow->flowPicture(points);
          break;
        case Order::kField:
          flow->flowField();
          break;
        case Order::kLeave:
          return;
      }
    } catch (const std::exception& e) {
      if (!alike(e)) endAll(comm, e.what());
      // else the same happens on process 0, which tells it and decides
    }
  }
}

}  // namespace monarch_flight::fluid::processes
