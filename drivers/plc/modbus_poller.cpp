#include "drivers/plc/modbus_poller.hpp"

#include <utility>

#include "drivers/plc/poller_loop.hpp"
#include "drivers/plc/register_map.hpp"

namespace graspd {
namespace {

[[nodiscard]] Status check_options(const PollerOptions& options) {
  using std::chrono::milliseconds;
  if (options.poll_period < milliseconds(1) || options.response_timeout < milliseconds(10) ||
      options.response_timeout > longest_response_timeout) {
    return {StatusCode::bad_configuration,
            "Modbus client: the poll period must be at least 1 ms, the response timeout 10 ms to 10 s"};
  }
  if (!is_unit(options.unit)) {
    return Status::format(StatusCode::bad_configuration, "Modbus client: %u is no unit id, but 0 to 247 and 255 are",
                          unsigned{options.unit});
  }
  constexpr unsigned addresses = 65536;
  if (options.coil_address + unsigned{coil::count} > addresses ||
      options.request_address + unsigned{request_register::count} > addresses ||
      options.result_address + unsigned{input_register_space} > addresses) {
    return Status::format(StatusCode::bad_configuration,
                          "Modbus client: %u coils, %u request registers and %u result registers must end before 65536",
                          unsigned{coil::count}, unsigned{request_register::count}, unsigned{input_register_space});
  }
  if (areas_overlap(options)) {
    return {StatusCode::bad_configuration, "Modbus client: request and result registers of the PLC overlap"};
  }
  return {};
}

}  // namespace

bool areas_overlap(const PollerOptions& options) {
  const unsigned request_end = options.request_address + unsigned{request_register::count};
  const unsigned result_end = options.result_address + unsigned{input_register_space};
  return options.request_address < result_end && options.result_address < request_end;
}

Result<std::unique_ptr<ModbusPoller>> ModbusPoller::start(const PollerOptions& options) {
  if (Status sound = check_options(options); !sound.ok()) return sound;
  const Result<SocketAddress> address = parse_address(options.address, options.port);
  if (!address.ok()) return address.status();
  auto loop = std::make_unique<Loop>(options, address.value());
  if (!loop->is_usable()) {
    return Status(StatusCode::internal, "Modbus client: no memory or no descriptor left to start with");
  }
  loop->start();
  return std::unique_ptr<ModbusPoller>(new ModbusPoller(std::move(loop)));
}

ModbusPoller::ModbusPoller(std::unique_ptr<Loop> loop) : loop_(std::move(loop)) {}
ModbusPoller::~ModbusPoller() = default;

bool ModbusPoller::wait_for_request(PlcRequest& request, std::chrono::milliseconds timeout) {
  return loop_->mailbox().wait(request, timeout);
}
bool ModbusPoller::is_wanted(std::uint16_t sequence) const { return loop_->mailbox().is_wanted(sequence); }
void ModbusPoller::capture_done(std::uint16_t sequence) { loop_->mailbox().capture_done(sequence); }
void ModbusPoller::commit(const ResultBlock& result) { loop_->mailbox().answer(result); }
void ModbusPoller::set_camera_ok(bool ok) { loop_->mailbox().set_camera_ok(ok); }
void ModbusPoller::set_model_loaded(bool loaded) { loop_->mailbox().set_model_loaded(loaded); }
std::uint64_t ModbusPoller::progress_count() const { return loop_->progress(); }
void ModbusPoller::stop() { loop_->stop(); }

}  // namespace graspd
