#include "monarch_flight/run/kept_participant.h"

#include <chrono>

#include "monarch_flight/math/seconds_since.h"

namespace monarch_flight {

Reply KeptParticipant::exchange(const Request& request) {
  const ExchangeKey& key = request.key;
  if (key.phase != Phase::kCheckpoint && key.phase != Phase::kRestore)
    return solver_->exchange(request);
  const auto begin = std::chrono::steady_clock::now();
  Reply reply;
  reply.key = key;
  reply.interface = request.interface;
  try {
    if (key.phase == Phase::kCheckpoint) {
      StateRecord record;
      StateWriter writer(record);
      solver_->checkpoint(key, writer);
      files_.write(key.step, part_, record);
    } else {
      const StateRecord record = files_.read(key.step, part_);
      StateReader reader(record, files_.path(key.step) + "/" + part_ + ".h5");
      solver_->restore(key, reader);
    }
  } catch (const std::exception& e) {
    reply.error = part_ + ", step " + std::to_string(key.step) + ", " + phaseName(key.phase) +
                  ": " + e.what();
  }
  reply.wall_s = secondsSince(begin);
  return reply;
}

}  // namespace monarch_flight
