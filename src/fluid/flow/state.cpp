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

class Reader {
 public:
  explicit Reader(const std::vector<char>& in) : in_(in) {}
  template <class T>
  void operator()(T& value) {
    bytes(&value, sizeof(T));
  }
  void operator()(Array& a) { bytes(a.data(), a.size() * sizeof(double)); }
  std::size_t left() const { return in_.size() - at_; }
  void skip(std::size_t n) { at_ += n; }

 private:
  void bytes(void* p, std::size_t n) {
    if (n > in_.size() - at_) throw std::invalid_argument("fluid state: too short for this grid");
    std::memcpy(p, in_.data() + at_, n);
    at_ += n;
  }
  const std::vector<char>& in_;
  std::size_t at_ = 0;
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

// The state is a head (number of processes, bytes of each) and the parts of the processes, bottom
// first.
std::vector<char> NavierStokes::save() const {
  std::vector<char> mine;
  Writer w(mine);
  w(layout_.nx), w(layout_.ny), w(layout_.nz), w(layout_.k0), w(layout_.k1);
  w(dt_), w(steps_), w(prepared_), w(report_.divergence);
  exchangeLevel(w, level_n_);
  exchangeLevel(w, level_m_);
  exchangePlace(w, predicted_);
  for (int c = 0; c < 3; ++c) w(vn_.c[c]), w(vm_.c[c]);
  w(p_), w(committed_acceleration_);
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
  Reader r(bytes);
  int ranks = 0;
  r(ranks);
  if (ranks != slab_.ranks()) {
    throw std::invalid_argument("fluid state: made by " + std::to_string(ranks) +
                                " processes, not by " + std::to_string(slab_.ranks()));
  }
  std::size_t mine = 0, total = 0;
  for (int q = 0; q < ranks; ++q) {
    long size = 0;
    r(size);
    if (q < slab_.rank()) mine += size;
    total += size;
  }
  if (r.left() != total) throw std::invalid_argument("fluid state: cut short or too long");
  r.skip(mine);
  int n[5];
  for (int& q : n) r(q);
  if (n[0] != layout_.nx || n[1] != layout_.ny || n[2] != layout_.nz || n[3] != layout_.k0 ||
      n[4] != layout_.k1) {
    throw std::invalid_argument("fluid state: made on another grid");
  }
  r(dt_), r(steps_), r(prepared_), r(report_.divergence);
  exchangeLevel(r, level_n_);
  exchangeLevel(r, level_m_);
  exchangePlace(r, predicted_);
  for (int c = 0; c < 3; ++c) r(vn_.c[c]), r(vm_.c[c]);
  r(p_), r(committed_acceleration_);
  for (Array& a : v_star_.c) std::fill(a.begin(), a.end(), 0.0);
  evaluated_ = false;
  step_ = {};
}

}  // namespace monarch_flight::fluid
