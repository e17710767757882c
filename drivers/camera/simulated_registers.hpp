#pragma once

#include <cstdint>
#include <string>

namespace graspd {

/// Where the simulated camera keeps its registers, big-endian. The first ones are those that GigE Vision
/// prescribes, the others are described by simulated_camera_xml().
namespace simulated_register {

inline constexpr std::uint32_t version = 0x0000;
inline constexpr std::uint32_t device_mode = 0x0004;
inline constexpr std::uint32_t mac_address = 0x0008;
inline constexpr std::uint32_t current_address = 0x0024;
inline constexpr std::uint32_t manufacturer_name = 0x0048;
inline constexpr std::uint32_t model_name = 0x0068;
inline constexpr std::uint32_t device_version = 0x0088;
inline constexpr std::uint32_t serial_number = 0x00D8;
inline constexpr std::uint32_t discovery_end = 0x00F8;
inline constexpr std::uint32_t description_url = 0x0200;
inline constexpr std::uint32_t network_interface_count = 0x0600;
inline constexpr std::uint32_t message_channel_count = 0x0900;
inline constexpr std::uint32_t stream_channel_count = 0x0904;
inline constexpr std::uint32_t capability = 0x0934;
inline constexpr std::uint32_t heartbeat_timeout = 0x0938;
inline constexpr std::uint32_t tick_frequency_low = 0x0940;
inline constexpr std::uint32_t control_privilege = 0x0A00;
inline constexpr std::uint32_t message_port = 0x0B00;
inline constexpr std::uint32_t message_address = 0x0B10;
inline constexpr std::uint32_t stream_port = 0x0D00;
inline constexpr std::uint32_t stream_packet_size = 0x0D04;
inline constexpr std::uint32_t stream_address = 0x0D18;
inline constexpr std::uint32_t stream_capability = 0x0D20;
inline constexpr std::uint32_t stream_configuration = 0x0D24;

inline constexpr std::uint32_t width = 0xB000;
inline constexpr std::uint32_t height = 0xB004;
inline constexpr std::uint32_t pixel_format = 0xB008;
inline constexpr std::uint32_t offset_x = 0xB00C;
inline constexpr std::uint32_t offset_y = 0xB010;
inline constexpr std::uint32_t acquisition = 0xB014;
inline constexpr std::uint32_t acquisition_mode = 0xB018;
inline constexpr std::uint32_t trigger_mode = 0xB01C;
inline constexpr std::uint32_t trigger_source = 0xB020;
inline constexpr std::uint32_t trigger_software = 0xB024;
inline constexpr std::uint32_t trigger_selector = 0xB028;
inline constexpr std::uint32_t frame_period = 0xB02C;
inline constexpr std::uint32_t output_mode = 0xB030;
inline constexpr std::uint32_t distance_unit = 0xB034;
inline constexpr std::uint32_t coordinate_selector = 0xB038;
inline constexpr std::uint32_t component_selector = 0xB03C;
inline constexpr std::uint32_t component_enable = 0xB040;  ///< One for each component, 4 bytes apart.
inline constexpr std::uint32_t payload_size = 0xB050;
inline constexpr std::uint32_t invalid_flag = 0xB054;
inline constexpr std::uint32_t exposure_time = 0xB058;  ///< From here on, 8 bytes: a double each.
inline constexpr std::uint32_t invalid_value = 0xB060;
inline constexpr std::uint32_t scale = 0xB068;
inline constexpr std::uint32_t offset = 0xB070;
inline constexpr std::uint32_t focal_length = 0xB078;
inline constexpr std::uint32_t principal_point_u = 0xB080;
inline constexpr std::uint32_t principal_point_v = 0xB088;
inline constexpr std::uint32_t baseline = 0xB090;
inline constexpr std::uint32_t event_selector = 0xB098;  ///< From here on, 4 bytes again.
inline constexpr std::uint32_t event_notification = 0xB09C;
inline constexpr std::uint32_t event_exposure_end = 0xB0A0;
inline constexpr std::uint32_t end = 0x10000;
inline constexpr std::uint32_t description = 0x10000;  ///< The XML itself, read only.

/// Bits of registers.
inline constexpr std::uint32_t capability_resend = 1U << 2U;
inline constexpr std::uint32_t capability_write_memory = 1U << 1U;
inline constexpr std::uint32_t stream_multipart = 1U << 6U;
inline constexpr std::uint32_t fire_test_packet = 1U << 31U;

}  // namespace simulated_register

/// Values of output_mode, and of component_selector.
enum class SimulatedOutputMode : std::uint8_t { calibrated_c = 0, calibrated_abc_grid = 1, disparity_c = 2 };
enum class SimulatedComponent : std::uint8_t { range = 0, confidence = 1, intensity = 2 };

/// Where the register that switches a component on lies.
[[nodiscard]] constexpr std::uint32_t component_enable_register(SimulatedComponent component) {
  return simulated_register::component_enable + 4 * static_cast<std::uint32_t>(component);
}

/// The GenICam description of the simulated camera: standard features (SFNC) over the registers above.
[[nodiscard]] std::string simulated_camera_xml();

}  // namespace graspd
