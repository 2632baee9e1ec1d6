// Exact state of the flow as bytes.
#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

#include "fluid/flow/flow.h"

namespace monarch_flight::fluid {
namespace {

class Writer {
 public:
  explicit Writer(std::vector<char>& out) : out_(out) {}
  template <class T>
  void operator()(const T& value) {
    bytes(&value, sizeof(T));
  }
  void operator()(const Array& a) { bytes(a.data(), a.size() * sizeof(double)); }

 private:
  void bytes(const void* p, std::size_t n) {
    const char* c = static_cast<const char*>(p);
    out_.insert(out_.end(), c, c + n);
  }
  std::vector<char>& out_;
};

class Counter {
 public:
  template <class T>
  void operator()(const T&) {
    size += sizeof(T);
  }
  void operator()(const Array& a) { size += a.size() * sizeof(double); }
  std::size_t size = 0;
};

/// Of the bytes [begin, end).
class Reader {
 public:
  Reader(const std::vector<char>& in, std::size_t begin, std::size_t end)
      : in_(in), at_(begin), end_(end) {}
  template <class T>
  void operator()(T& value) {
    bytes(&value, sizeof(T));
  }
  void operator()(Array& a) { bytes(a.data(), a.size() * sizeof(double)); }
  std::size_t at() const { return at_; }
  std::size_t left() const { return end_ - at_; }

 private:
  void bytes(void* p, std::size_t n) {
    if (n > left()) throw std::invalid_argument("fluid state: cut short");
    std::memcpy(p, in_.data() + at_, n);
    at_ += n;
  }
  const std::vector<char>& in_;
  std::size_t at_, end_;
};

template <class Stream, class Place>
void exchangePlace(Stream& s, Place& place) {
  for (int i = 0; i < 16; ++i) s(place.matrix().data()[i]);
}

template <class Stream, class L>
void exchangeLevel(Stream& s, L& level) {
  for (int i = 0; i < 9; ++i) s(level.axes.data()[i]);
  exchangePlace(s, level.place);
  for (int i = 0; i < 3; ++i) s(level.grid.V[i]);
  for (int i = 0; i < 3; ++i) s(level.grid.omega[i]);
  s(level.wall);
}

}  // namespace

/// All of it behind the sizes of the grid, of a flow that is written (const) or read.
template <class Stream, class Flow>
void NavierStokes::exchange(Stream& s, Flow& flow) {
  s(flow.dt_), s(flow.length_), s(flow.length_before_), s(flow.steps_), s(flow.prepared_);
  s(flow.report_.divergence);
  exchangeLevel(s, flow.level_n_);
  exchangeLevel(s, flow.level_m_);
  exchangePlace(s, flow.predicted_);
  for (int c = 0; c < 3; ++c) s(flow.vn_.c[c]), s(flow.vm_.c[c]);
  s(flow.p_), s(flow.committed_acceleration_);
}

// The state is a head (number of processes, bytes of each) and the parts of the processes, bottom
// first.
std::vector<char> NavierStokes::save() const {
  std::vector<char> mine;
  Writer w(mine);
  for (const int n : {layout_.nx, layout_.ny, layout_.nz, layout_.k0, layout_.k1}) w(n);
  exchange(w, *this);
  const long size = static_cast<long>(mine.size());
  std::vector<char> sizes, head, all = slab_.gather(mine);
  Writer{sizes}(size);
  sizes = slab_.gather(sizes);
  if (slab_.rank() != 0) return {};
  Writer{head}(slab_.ranks());
  head.insert(head.end(), sizes.begin(), sizes.end());
  head.insert(head.end(), all.begin(), all.end());
  return head;
}

void NavierStokes::restore(const std::vector<char>& bytes) {
  Reader head(bytes, 0, bytes.size());
  int ranks = 0;
  head(ranks);
  if (ranks != slab_.ranks()) {
    throw std::invalid_argument("fluid state: made by " + std::to_string(ranks) +
                                " processes, not by " + std::to_string(slab_.ranks()));
  }
  std::size_t before = 0, mine = 0, total = 0;
  for (int q = 0; q < ranks; ++q) {
    long size = 0;
    head(size);
    if (q < slab_.rank()) before += size;
    if (q == slab_.rank()) mine = size;
    total += size;
  }
  if (head.left() != total) throw std::invalid_argument("fluid state: cut short or too long");
  Reader r(bytes, head.at() + before, head.at() + before + mine);
  for (const int n : {layout_.nx, layout_.ny, layout_.nz, layout_.k0, layout_.k1}) {
    int stored = 0;
    r(stored);
    if (stored != n) throw std::invalid_argument("fluid state: made on another grid");
  }
  Counter expected;
  exchange(expected, *this);
  if (r.left() != expected.size)
    throw std::invalid_argument("fluid state: made by another version of the flow");
  exchange(r, *this);
  for (Array& a : v_star_.c) std::fill(a.begin(), a.end(), 0.0);
  evaluated_ = false;
  step_ = {};
}

}  // namespace monarch_flight::fluid
