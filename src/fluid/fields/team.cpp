#include "fluid/fields/team.h"

#include <omp.h>

namespace monarch_flight::fluid {

void Team::run(int begin, int end, void (*work)(void*, int, int), void* context) const {
  if (threads_ == 1) {
    for (int index = begin; index < end; ++index) work(context, index, 0);
    return;
  }
#pragma omp parallel for schedule(dynamic) num_threads(threads_)
  for (int index = begin; index < end; ++index) work(context, index, omp_get_thread_num());
}

}  // namespace monarch_flight::fluid
