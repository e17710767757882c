#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>

#include "tests/drivers/camera/camera_faults.hpp"
#include "tests/drivers/camera/lossy_relay.hpp"

namespace graspd {
namespace {

using testing::HasSubstr;

/// How many packets a network loses, and whether the client asks for them again.
struct PacketLoss {
  double share;
  bool resend;
};

class LossyNetwork : public CameraFaults, public testing::WithParamInterface<PacketLoss> {
 protected:
  static constexpr int frames = 20;

  /// Asks for `frames` frames, through small packets. Each is whole and right in every bit, or refused.
  int count_whole() {
    options_.device = LossyRelay::address;
    options_.packet_resend = GetParam().resend;
    options_.packet_size = 576;
    options_.timeout_ns = 3 * second_ns;
    switch_on();
    connect();
    int whole = 0;
    for (int i = 0; i < frames; ++i) {
      const Status status = grab_in_time();
      if (status.ok()) {
        ++whole;
        expect_frame(static_cast<std::size_t>(camera_->frames_sent() - 1));
      } else if (status.code() == StatusCode::bad_frame) {
        EXPECT_THAT(std::string(status.message()), HasSubstr("came in part"));
      } else {
        EXPECT_EQ(status.code(), StatusCode::camera_lost) << status.message();
      }
    }
    // While the relay is there: a session that is given up tells the camera so.
    source_.reset();
    return whole;
  }
};

TEST_P(LossyNetwork, FramesAreWholeOrRefused) {
  LossyRelay relay(GetParam().share);
  const int whole = count_whole();
  std::printf("%g of the packets lost, %s resend: %d of %d frames whole, %llu packets, %llu lost, asked %llu times\n",
              GetParam().share, GetParam().resend ? "with" : "without", whole, frames,
              static_cast<unsigned long long>(relay.streamed()), static_cast<unsigned long long>(relay.lost()),
              static_cast<unsigned long long>(relay.asked_again()));
  EXPECT_GT(relay.lost(), 0U);
  if (!GetParam().resend) {
    EXPECT_EQ(relay.asked_again(), 0U);
    EXPECT_LT(whole, frames) << "each has 38 packets";
    EXPECT_GT(whole, 0);
  } else if (GetParam().share < 0.1) {
    EXPECT_EQ(whole, frames);
  } else {
    EXPECT_GT(whole, frames / 4);
  }
}

constexpr std::array losses{PacketLoss{0.02, true}, PacketLoss{0.2, true}, PacketLoss{0.02, false}};

INSTANTIATE_TEST_SUITE_P(All, LossyNetwork, testing::ValuesIn(losses), [](const auto& one) {
  return std::to_string(static_cast<int>(100 * one.param.share)) + "Percent" +
         (one.param.resend ? "WithResend" : "WithoutResend");
});

}  // namespace
}  // namespace graspd
