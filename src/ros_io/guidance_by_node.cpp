#include "monarch_flight/ros_io/guidance_by_node.h"

namespace monarch_flight {

Reply GuidanceByNode::exchange(const Request& request) {
  const Reply wanted = node_.exchange(request);
  if (!wanted.error.empty()) return wanted;
  if (wanted.command && request.key.phase == Phase::kIterate) inbox_->post(*wanted.command, true);
  Reply reply = own_.exchange(request);
  reply.wall_s += wanted.wall_s;
  reply.guidance.lost = wanted.guidance.lost;
  if (!reply.prescribed || !wanted.prescribed) return reply;
  reply.prescribed->angles = wanted.prescribed->angles;
  reply.prescribed->rest_angle = wanted.prescribed->rest_angle;
  return reply;
}

}  // namespace monarch_flight
