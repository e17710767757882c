#pragma once

namespace graspd {

/// Asks the kernel to let the calling thread, and those that it starts, go on as soon as they wake up, before others of
/// the same rank have used up their time: without it they wait for the next tick, up to 4 ms. Their share of the
/// processors stays as it is. Linux 6.12 and later; without effect on older ones, on threads of a real-time policy, and
/// where the call is not allowed.
void make_thread_prompt();

}  // namespace graspd
