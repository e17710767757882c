#pragma once

#include <netinet/in.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "core/status.hpp"
#include "drivers/camera/depth_encoding.hpp"
#include "drivers/camera/simulated_registers.hpp"
#include "drivers/camera/stream_packets.hpp"
#include "drivers/files/file_descriptor.hpp"
#include "drivers/files/loaded_frame.hpp"

namespace graspd {

/// A simulated camera, as it is switched on.
struct SimulatedCameraOptions {
  std::string address = "127.0.0.1";  ///< An IPv4 address of this machine.
  std::string serial = "SIM0001";     ///< Up to 15 characters.
  DepthEncoding encoding;
  float sure_up_to = 1000.0F;           ///< Metres; confidences are 0 beyond.
  double lost_packets = 0.0;            ///< Share of the stream's packets that are not sent.
  bool answers_resend = true;           ///< Sends packets again when the client asks.
  std::int64_t exposure_ns = 0;         ///< From the trigger to the end of the exposure, which is told as an event.
  std::int64_t readout_ns = 0;          ///< From there to the first packet.
  bool always_sends_intensity = false;  ///< The component Intensity cannot be switched off.
};

/// A GigE Vision 3D camera on the network that plays frames: it answers discovery, gives its own GenICam
/// description with Scan3d nodes, obeys one client at a time, and streams depth in any of the formats that
/// DepthEncoding knows, with confidences and intensities as further parts. Every trigger takes the next frame.
/// Aravis' fake camera could play frames too, but sends no multipart, sends lost packets never again, and
/// looks for triggers at ticks of its clock only.
class SimulatedCamera {
 public:
  /// Starts it on a thread. All frames must have the camera of the first, with square pixels. Fails with
  /// address_in_use when there is a camera at the address already, with bad_frame and bad_request.
  [[nodiscard]] static Result<std::unique_ptr<SimulatedCamera>> start(const SimulatedCameraOptions& options,
                                                                      std::vector<LoadedFrame> frames);
  ~SimulatedCamera();
  SimulatedCamera(const SimulatedCamera&) = delete;
  SimulatedCamera& operator=(const SimulatedCamera&) = delete;

  /// A signal on Line0.
  void signal_line() { line_ = true; }
  /// From now on triggers are not answered, or again.
  void set_deaf(bool deaf) { deaf_ = deaf; }
  /// From now on frames lack their second half, or are whole again.
  void set_truncated(bool truncated) { truncated_ = truncated; }
  /// From now on stored values mean something else, as if somebody had changed the output mode.
  void set_output_mode(SimulatedOutputMode mode) { new_mode_ = static_cast<int>(mode); }
  /// The next reading of the output mode is not answered, as when a packet is lost on the way.
  void lose_mode_answer() { loses_mode_answer_ = true; }
  /// From now on frames are these pixels alone, as if somebody had changed the region.
  void set_region(const SensorRegion& region);

  [[nodiscard]] std::uint64_t frames_sent() const { return frames_sent_; }
  [[nodiscard]] std::uint64_t packets_lost() const { return packets_lost_; }
  [[nodiscard]] std::uint64_t packets_resent() const { return packets_resent_; }

 private:
  struct Sockets {
    FileDescriptor control;    ///< Commands to the camera's own address.
    FileDescriptor broadcast;  ///< Discovery by clients that do not know it.
    FileDescriptor stream;
  };
  SimulatedCamera(const SimulatedCameraOptions& options, std::vector<LoadedFrame> frames, Sockets sockets);
  [[nodiscard]] static Result<Sockets> open_sockets(const std::string& address);
  void set_up_registers();
  void refresh();
  void work();

  void answer_controls(int timeout_ms);
  void receive(int socket);
  void answer(int socket, const sockaddr_in& client, std::span<const std::byte> message);
  [[nodiscard]] std::uint16_t write_register(const sockaddr_in& client, std::uint32_t address, std::uint32_t value);
  void resend(std::span<const std::byte> message, bool extended);
  void release_control();
  [[nodiscard]] bool may_write(const sockaddr_in& client) const;
  void read_memory(std::uint32_t address, std::span<std::byte> out) const;

  [[nodiscard]] bool frame_is_due();
  void tell_exposure_over();
  void spend(std::int64_t duration_ns);
  void send_frame();
  void send_packet(std::uint32_t index);
  void send_test_packet();
  [[nodiscard]] sockaddr_in stream_target() const;
  [[nodiscard]] DepthEncoding encoding() const;
  [[nodiscard]] SensorRegion region() const;
  [[nodiscard]] bool sends(SimulatedComponent component) const;
  [[nodiscard]] std::vector<StreamPart> parts_of(DepthFrame frame) const;

  [[nodiscard]] std::uint32_t get(std::uint32_t address) const;
  void put(std::uint32_t address, std::uint32_t value);
  void put_real(std::uint32_t address, double value);
  void put_text(std::uint32_t address, std::size_t size, std::string_view text);

  const SimulatedCameraOptions options_;
  std::vector<LoadedFrame> frames_;
  std::string description_;
  std::vector<std::byte> registers_;
  Sockets sockets_;

  std::optional<sockaddr_in> controller_;
  std::int64_t heard_ns_ = 0;
  bool triggered_ = false;
  std::int64_t next_frame_ns_ = 0;
  std::size_t next_frame_ = 0;
  std::uint16_t frame_id_ = 0;
  std::uint16_t event_count_ = 0;
  std::optional<StreamFrame> frame_;
  std::vector<std::byte> packet_;
  std::minstd_rand random_;

  std::atomic<bool> stop_{false};
  std::atomic<bool> line_{false};
  std::atomic<bool> deaf_{false};
  std::atomic<bool> truncated_{false};
  std::atomic<bool> loses_mode_answer_{false};
  std::atomic<std::uint64_t> region_{0};
  std::atomic<int> new_mode_{-1};
  std::atomic<std::uint64_t> frames_sent_{0};
  std::atomic<std::uint64_t> packets_lost_{0};
  std::atomic<std::uint64_t> packets_resent_{0};
  std::thread thread_;
};

}  // namespace graspd
