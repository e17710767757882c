#include <cstdlib>
#include <vector>

#include "drivers/plc/client_table.hpp"
#include "drivers/plc/request_check.hpp"
#include "tests/fuzz/fuzz_target.hpp"

// What a client has sent, cut into requests as the server does it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t header_size = 7;
  std::span<const std::uint8_t> bytes(data, size);
  while (!bytes.empty()) {
    const graspd::Frame frame = graspd::next_frame(bytes);
    if (frame.state != graspd::FrameState::complete) break;
    if (frame.size > bytes.size() || frame.size <= header_size) std::abort();
    // A copy of its own size, so that reading past its end is seen.
    const auto one = bytes.first(frame.size).subspan(header_size);
    const std::vector<std::uint8_t> request(one.begin(), one.end());
    static_cast<void>(graspd::check_request(request));
    bytes = bytes.subspan(frame.size);
  }
  return 0;
}
