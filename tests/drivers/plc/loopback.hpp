#pragma once

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "drivers/plc/modbus_client.hpp"
#include "drivers/plc/modbus_server.hpp"
#include "tests/drivers/plc/loopback_listener.hpp"

namespace graspd {

using namespace std::chrono_literals;

/// How long a test waits for what must come: a busy machine takes its time.
constexpr std::chrono::milliseconds patience = 10s;
constexpr std::int64_t patience_ns = std::chrono::nanoseconds(patience).count();

using Bytes = std::vector<std::uint8_t>;

/// A request for one input register; its answer has 11 bytes.
inline const Bytes read_one_input{0, 9, 0, 0, 0, 6, 1, 4, 0, 0, 0, 1};

/// A server on a free port of the loopback interface.
inline std::unique_ptr<ModbusServer> start_server(ServerOptions options = {}) {
  options.bind_address = "127.0.0.1";
  options.port = 0;
  Result<std::unique_ptr<ModbusServer>> server = ModbusServer::start(options);
  EXPECT_TRUE(server.ok()) << server.status().message();
  return std::move(server).value();
}

inline ModbusClient connect_to(const ModbusServer& server, const BlockFormat& format = {}) {
  Result<ModbusClient> client = ModbusClient::connect("127.0.0.1", server.port(), format);
  EXPECT_TRUE(client.ok()) << client.status().message();
  return std::move(client).value();
}

/// A pick whose numbers all follow from `sequence`, so that a torn block would show.
inline ResultBlock pick_for(const PlcRequest& request) {
  const auto n = static_cast<float>(request.sequence);
  ResultBlock result;
  result.sequence = request.sequence;
  result.request_id = request.request_id;
  result.code = ResultCode::ok;
  result.part = request.part;
  result.tool = request.tool;
  result.score = 0.9F;
  result.opening = n / 1000.0F;
  result.pick.translation = {n / 1000.0F, 0, 0.5F};
  result.approach.translation = {n / 1000.0F, 1, 0.4F};
  result.part_pose.translation = {n / 1000.0F, 2, 0.6F};
  result.verified = true;
  return result;
}

/// Answers requests until it is destroyed.
class Worker {
 public:
  using Answer = std::function<ResultBlock(const PlcRequest&)>;
  Worker(PlcLink& server, Answer answer) : server_(server) {
    server_.set_camera_ok(true);
    server_.set_model_loaded(true);
    thread_ = std::thread([this, answer = std::move(answer)] {
      while (!stop_.load()) {
        PlcRequest request;
        if (!server_.wait_for_request(request, 20ms)) continue;
        requests.fetch_add(1);
        server_.capture_done(request.sequence);
        server_.commit(answer(request));
      }
    });
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  ~Worker() {
    stop_.store(true);
    thread_.join();
  }
  std::atomic<int> requests{0};

 private:
  PlcLink& server_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

/// A plain connection, for bytes that no Modbus library would send.
class RawClient {
 public:
  explicit RawClient(const ModbusServer& server) : descriptor_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    const sockaddr_in address = loopback_address(server.port());
    EXPECT_EQ(connect(descriptor_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  }
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;
  ~RawClient() { close(descriptor_); }

  void send_bytes(const Bytes& bytes) const {
    EXPECT_EQ(send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL), static_cast<ssize_t>(bytes.size()));
  }
  /// What arrives within `time`; empty when nothing does or the server hung up.
  [[nodiscard]] Bytes receive_bytes(std::chrono::milliseconds time = patience) const {
    pollfd waiting{descriptor_, POLLIN, 0};
    Bytes bytes(512);
    if (poll(&waiting, 1, static_cast<int>(time.count())) != 1) return {};
    const ssize_t size = recv(descriptor_, bytes.data(), bytes.size(), 0);
    bytes.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return bytes;
  }
  /// True when the server hung up within `time`.
  [[nodiscard]] bool is_closed(std::chrono::milliseconds time = patience) const {
    pollfd waiting{descriptor_, POLLIN, 0};
    std::array<std::uint8_t, 1> byte{};
    return poll(&waiting, 1, static_cast<int>(time.count())) == 1 && recv(descriptor_, byte.data(), 1, 0) <= 0;
  }

 private:
  int descriptor_;
};

}  // namespace graspd
