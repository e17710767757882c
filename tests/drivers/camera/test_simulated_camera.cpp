#include <arv.h>
#include <gtest/gtest.h>

#include "tests/drivers/camera/camera_on_the_wire.hpp"

namespace graspd {
namespace {

/// Ends the reference that it is given.
template <class Object>
struct Unreference {
  void operator()(Object* object) const { g_object_unref(object); }
};
template <class Object>
using Owned = std::unique_ptr<Object, Unreference<Object>>;

class SimulatedCameraOnTheWire : public CameraOnTheWire {};

/// Aravis as any program would use it, with none of graspd's own client.
TEST_F(SimulatedCameraOnTheWire, StreamsToAPlainGenicamClient) {
  switch_on();
  const Owned<ArvCamera> client(arv_camera_new("127.0.0.1", nullptr));
  ASSERT_NE(client, nullptr);
  arv_camera_set_acquisition_mode(client.get(), ARV_ACQUISITION_MODE_CONTINUOUS, nullptr);
  const Owned<ArvStream> stream(arv_camera_create_stream(client.get(), nullptr, nullptr, nullptr));
  ASSERT_NE(stream, nullptr);
  const std::size_t payload = arv_camera_get_payload(client.get(), nullptr);
  EXPECT_EQ(payload, 96U * 64U * 2U);
  for (int i = 0; i < 4; ++i) arv_stream_push_buffer(stream.get(), arv_buffer_new_allocate(payload));
  GError* problem = nullptr;
  arv_camera_start_acquisition(client.get(), &problem);
  ASSERT_EQ(problem, nullptr) << problem->message;
  int whole = 0;
  for (int i = 0; i < 20 && whole < 5; ++i) {
    constexpr guint64 patience_us = 10'000'000;
    ArvBuffer* buffer = arv_stream_timeout_pop_buffer(stream.get(), patience_us);
    ASSERT_NE(buffer, nullptr);
    if (arv_buffer_get_status(buffer) == ARV_BUFFER_STATUS_SUCCESS) {
      ++whole;
      EXPECT_EQ(arv_buffer_get_image_width(buffer), 96);
      EXPECT_EQ(arv_buffer_get_image_height(buffer), 64);
      std::size_t size = 0;
      const void* data = arv_buffer_get_data(buffer, &size);
      const std::size_t number = (arv_buffer_get_frame_id(buffer) - 1) % frames_.size();
      const auto expected = encode_depth(frames_[number].frame(), {0, 0, 96, 64}, simulated_.encoding);
      ASSERT_EQ(size, expected.size());
      EXPECT_EQ(std::memcmp(data, expected.data(), size), 0);
    }
    arv_stream_push_buffer(stream.get(), buffer);
  }
  EXPECT_EQ(whole, 5);
  arv_camera_stop_acquisition(client.get(), nullptr);
}

}  // namespace
}  // namespace graspd
