// Lines along z that are cut by slabs: planes pass from process to process towards the wing and
// back.
#include "fluid/momentum/momentum.h"

namespace monarch_flight::fluid::momentum {

void Momentum::finishSlabs(const Lines& lines, const WallVelocity& wall_change) {
  const int k0 = layout_.k0, k1 = layout_.k1, kw = metrics_.grid.k_wing;
  const int n = static_cast<int>(layout_.sz);
  auto reduced = [&](int k) { return lines.reduced + layout_.plane(k); };
  auto gamma = [&](int k) { return gamma_field_.data() + layout_.plane(k); };
  auto eachBlock = [&](auto work) {
    team_.each(0, blocks(lines.component), [&](int b, int) { work(block(lines.component, b)); });
  };
  auto eliminate = [&](int half) {
    eachBlock([&](const LineRange& range) {
      lines.eliminate(range, half, lines.outermost(half), lines.innermost(half), wall_change);
    });
  };
  auto substitute = [&](int half) {
    eachBlock([&](const LineRange& range) { lines.substitute(range, half); });
  };

  if (k0 < kw) {
    if (!slab_.atBottom()) {
      for (double* p : {reduced(k0 - 1), gamma(k0 - 1)}) slab_.receiveFromBelow(p, n);
    }
    eliminate(0);
    if (k1 < kw) {
      for (double* p : {reduced(k1 - 1), gamma(k1 - 1)}) slab_.sendUp(p, n);
    }
  }
  if (k1 > kw) {
    if (!slab_.atTop()) {
      for (double* p : {reduced(k1), gamma(k1)}) slab_.receiveFromAbove(p, n);
    }
    eliminate(1);
    if (k0 > kw) {
      for (double* p : {reduced(k0), gamma(k0)}) slab_.sendDown(p, n);
    }
  }
  if (k0 <= kw && k1 >= kw) {  // two processes that meet there first exchange their points
    if (k1 == kw) {
      slab_.exchangeAbove(reduced(kw - 1), reduced(kw), n);
      slab_.exchangeAbove(gamma(kw - 1), gamma(kw), n);
    }
    if (k0 == kw) {
      slab_.exchangeBelow(reduced(kw), reduced(kw - 1), n);
      slab_.exchangeBelow(gamma(kw), gamma(kw - 1), n);
    }
    eachBlock([&](const LineRange& range) { lines.join(range); });
  }
  if (k0 < kw) {
    if (k1 < kw) slab_.receiveFromAbove(lines.solved[0], n);
    substitute(0);
    if (!slab_.atBottom()) slab_.sendDown(lines.solved[0], n);
  }
  if (k1 > kw) {
    if (k0 > kw) slab_.receiveFromBelow(lines.solved[1], n);
    substitute(1);
    if (!slab_.atTop()) slab_.sendUp(lines.solved[1], n);
  }
}

}  // namespace monarch_flight::fluid::momentum
