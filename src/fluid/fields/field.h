#pragma once
#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <new>
#include <vector>

#include "fluid/fields/slab.h"
#include "monarch_flight/fluid/grid.h"

namespace monarch_flight::fluid {

/// Allocator for vectors whose first element lies on a 64-byte boundary. Large ones are given huge
/// pages where the system has them: lines along z touch another page with every point.
template <class T>
struct Aligned64 {
  using value_type = T;
  Aligned64() = default;
  template <class U>
  Aligned64(const Aligned64<U>&) {}
  T* allocate(std::size_t n) {
    constexpr std::size_t kHugePage = 2 << 20;
    const std::size_t alignment = n * sizeof(T) < kHugePage ? 64 : kHugePage;
    void* p = nullptr;
    if (posix_memalign(&p, alignment, n * sizeof(T)) != 0) throw std::bad_alloc();
    if (alignment == kHugePage) madvise(p, n * sizeof(T), MADV_HUGEPAGE);  // only advice
    return static_cast<T*>(p);
  }
  void deallocate(T* p, std::size_t) { std::free(p); }
  bool operator==(const Aligned64&) const { return true; }
  bool operator!=(const Aligned64&) const { return false; }
};
using Array = std::vector<double, Aligned64<double>>;

/// Common storage layout of all staggered fields: x fastest, one layer of ghosts, rows padded so
/// that i = 0 is aligned. The face (i, j, k) of a component is the lower face of the cell (i, j,
/// k). Indices are those of the whole grid; a process stores the planes [k0 - 1, k1 + 1] of its
/// slab.
struct Layout {
  int nx, ny, nz;         ///< cells of the whole grid
  int k0, k1;             ///< planes of cells owned: [k0, k1)
  std::ptrdiff_t sy, sz;  ///< strides of j and k
  Layout(const Grid& g, const Slab& slab)
      : nx(g.x.n()),
        ny(g.y.n()),
        nz(g.z.n()),
        k0(slab.k0()),
        k1(slab.k1()),
        sy((nx + 9 + 7) / 8 * 8),
        sz(sy * (ny + 3)) {}
  std::ptrdiff_t at(int i, int j, int k) const { return (k - k0 + 1) * sz + (j + 1) * sy + i + 8; }
  std::ptrdiff_t plane(int k) const { return (k - k0 + 1) * sz; }  ///< its first element
  std::size_t size() const { return static_cast<std::size_t>(sz) * (k1 - k0 + 3); }
  std::ptrdiff_t stride(int direction) const {
    return direction == 0 ? 1 : direction == 1 ? sy : sz;
  }
  int n(int direction) const { return direction == 0 ? nx : direction == 1 ? ny : nz; }
};

/// A staggered velocity: component c lives on the faces normal to direction c.
struct Velocity {
  Array c[3];
  explicit Velocity(const Layout& l) {
    for (auto& a : c) a.assign(l.size(), 0.0);
  }
};

/// Fills the neighbouring planes of a field from the processes above and below.
inline void fillHalo(const Layout& l, const Slab& slab, Array& a) {
  slab.fillHalo([&](int k) { return a.data() + l.plane(k); }, static_cast<int>(l.sz));
}
inline void fillHalo(const Layout& l, const Slab& slab, Velocity& v) {
  for (auto& a : v.c) fillHalo(l, slab, a);
}

/// A function of the wing's plane that is affine in x and y: the velocity of the wall, for every
/// level.
struct WallVelocity {
  double c0[3] = {0, 0, 0}, cx[3] = {0, 0, 0}, cy[3] = {0, 0, 0};
  double at(int component, double x, double y) const {
    return c0[component] + cx[component] * x + cy[component] * y;
  }
};

}  // namespace monarch_flight::fluid
