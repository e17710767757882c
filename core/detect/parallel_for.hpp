#pragma once

namespace graspd {

/// Calls `body(i)` for each i below `count`, on up to `threads` threads that take `grain` indices at a time. A single
/// thread does without a parallel region: libgomp allocates a team for every region of one thread, while it keeps
/// that of several for the next region of as many.
template <class Index, class Body>
void parallel_for(Index count, int threads, int grain, const Body& body) {
  if (threads <= 1) {
    for (Index i = 0; i < count; ++i) body(i);
    return;
  }
#pragma omp parallel for num_threads(threads) schedule(dynamic, grain)
  for (Index i = 0; i < count; ++i) body(i);
}

}  // namespace graspd
