#include "drivers/plc/modbus_client.hpp"

#include <modbus.h>

#include <array>
#include <cerrno>
#include <thread>

#include "drivers/plc/pick_list.hpp"
#include "drivers/plc/register_map.hpp"

namespace graspd {
namespace {

constexpr std::uint32_t response_timeout_s = 2;
constexpr std::chrono::milliseconds poll_period{2};

}  // namespace

void ModbusClient::FreeContext::operator()(_modbus* context) const {
  modbus_close(context);
  modbus_free(context);
}

Status ModbusClient::outcome(int returned, const char* what) {
  if (returned >= 0) return {};
  const bool is_exception = errno > MODBUS_ENOBASE && errno < EMBBADCRC;
  return Status::format(is_exception ? StatusCode::bad_request : StatusCode::internal, "Modbus client: %s: %s", what,
                        modbus_strerror(errno));
}

Result<ModbusClient> ModbusClient::connect(const std::string& address, std::uint16_t port, const BlockFormat& format) {
  ModbusClient client(modbus_new_tcp(address.c_str(), port), format);
  if (client.context_ == nullptr) {
    return Status::format(StatusCode::bad_configuration, "Modbus client: '%s' is no IPv4 address", address.c_str());
  }
  modbus_t* context = client.context_.get();
  modbus_set_response_timeout(context, response_timeout_s, 0);
  if (Status status = outcome(modbus_connect(context), "cannot connect"); !status.ok()) return status;
  return client;
}

Status ModbusClient::write_coil(std::uint16_t address, bool value) {
  return outcome(modbus_write_bit(context_.get(), address, value ? 1 : 0), "cannot write a coil");
}

Status ModbusClient::pulse(std::uint16_t address) {
  if (Status status = write_coil(address, true); !status.ok()) return status;
  return write_coil(address, false);
}

Status ModbusClient::write_request(const ClientRequest& request) {
  const std::array<std::uint16_t, 4> words{request.request_id, request.part, request.minimum_score,
                                           request.pose_convention};
  if (Status status =
          outcome(modbus_write_registers(context_.get(), request_register::request_id, words.size(), words.data()),
                  "cannot write the request");
      !status.ok()) {
    return status;
  }
  const std::array<std::uint16_t, 3> more{request.options, request.results_wanted, request.region};
  if (Status status =
          outcome(modbus_write_registers(context_.get(), request_register::options, more.size(), more.data()),
                  "cannot write the request");
      !status.ok()) {
    return status;
  }
  return outcome(modbus_write_register(context_.get(), request_register::tool, request.tool),
                 "cannot write the request");
}

Status ModbusClient::write_heartbeat(std::uint16_t value) {
  return outcome(modbus_write_register(context_.get(), request_register::plc_heartbeat, value),
                 "cannot write the heartbeat");
}

Result<HandshakeOutputs> ModbusClient::read_outputs() {
  std::array<std::uint8_t, discrete_input::count> bits{};
  const int read = modbus_read_input_bits(context_.get(), 0, discrete_input::count, bits.data());
  if (Status status = outcome(read, "cannot read the discrete inputs"); !status.ok()) return status;
  HandshakeOutputs out;
  out.ready = bits[discrete_input::ready] != 0;
  out.busy = bits[discrete_input::busy] != 0;
  out.capture_done = bits[discrete_input::capture_done] != 0;
  out.done = bits[discrete_input::done] != 0;
  out.error = bits[discrete_input::error] != 0;
  out.result_valid = bits[discrete_input::result_valid] != 0;
  out.camera_ok = bits[discrete_input::camera_ok] != 0;
  out.model_loaded = bits[discrete_input::model_loaded] != 0;
  out.plc_alive = bits[discrete_input::plc_alive] != 0;
  return out;
}

Result<std::uint16_t> ModbusClient::read_live(std::uint16_t address) {
  std::uint16_t value = 0;
  const int read = modbus_read_input_registers(context_.get(), address, 1, &value);
  if (Status status = outcome(read, "cannot read an input register"); !status.ok()) return status;
  return value;
}

Result<ResultBlock> ModbusClient::read_block() {
  std::array<std::uint16_t, block::count> words{};
  const int read = modbus_read_input_registers(context_.get(), 0, block::count, words.data());
  if (Status status = outcome(read, "cannot read the result block"); !status.ok()) return status;
  return decode(words, format_);
}

Result<ResultBlock> ModbusClient::read_list(NumberKind kind) {
  std::array<std::uint16_t, pick_list::count> words{};
  const int first = kind == NumberKind::scaled ? pick_list::scaled_first : pick_list::floats_first;
  const int read = modbus_read_input_registers(context_.get(), first, pick_list::count, words.data());
  if (Status status = outcome(read, "cannot read the list of picks"); !status.ok()) return status;
  return decode_list(words, kind, format_);
}

Status ModbusClient::trigger(const ClientRequest& request) {
  if (Status status = write_request(request); !status.ok()) return status;
  return write_coil(coil::trigger, true);
}

Result<HandshakeOutputs> ModbusClient::wait_done(std::chrono::milliseconds timeout) {
  const auto end = std::chrono::steady_clock::now() + timeout;
  for (;;) {
    Result<HandshakeOutputs> out = read_outputs();
    if (!out.ok() || out.value().done) return out;
    if (std::chrono::steady_clock::now() >= end) {
      return Status::format(StatusCode::deadline, "Modbus client: no answer within %lld ms",
                            static_cast<long long>(timeout.count()));
    }
    std::this_thread::sleep_for(poll_period);
  }
}

Status ModbusClient::acknowledge() {
  if (Status status = write_coil(coil::trigger, false); !status.ok()) return status;
  return pulse(coil::acknowledge);
}

Result<ResultBlock> ModbusClient::request_pick(const ClientRequest& request, std::chrono::milliseconds timeout) {
  if (Status status = trigger(request); !status.ok()) return status;
  Result<HandshakeOutputs> out = wait_done(timeout);
  if (!out.ok()) return out.status();
  Result<ResultBlock> result = read_block();
  if (result.ok()) result.value().verified = out.value().result_valid;
  if (Status status = acknowledge(); !status.ok()) return status;
  return result;
}

}  // namespace graspd
