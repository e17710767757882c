#include <gtest/gtest.h>

#include <algorithm>

#include "core/detect/claimed_scene.hpp"
#include "tests/core/detect/bracket_map.hpp"

namespace graspd {
namespace {

class Claiming : public BracketMap {
 protected:
  ClaimedScene claims_;

  void SetUp() override {
    BracketMap::SetUp();
    claims_ = memory_.workspace.select.claims;
    std::fill(claims_.cells.begin(), claims_.cells.end(), std::uint16_t{0});
    claims_.rooms.clear();
  }
  /// Accepts the bracket at `pose` as the next instance.
  RenderedModel accept(const RigidTransform& pose) {
    const std::size_t room = free_room(claims_);
    const RenderedModel model = render(pose);
    claim(scene_.map, model, 0.001F, claims_.rooms.size(), claims_);
    claims_.rooms.push_back({model.rectangle, room});
    return model;
  }
  [[nodiscard]] RenderedModel render(const RigidTransform& pose) const {
    return render_into(claims_, free_room(claims_), scene_.map, maker_.bank(), pose);
  }
  [[nodiscard]] ClaimedShare share(const RigidTransform& pose) const {
    return claimed_share(scene_.map, maker_.bank(), pose, 0.001F, claims_);
  }
  [[nodiscard]] std::ptrdiff_t claimed_by(std::size_t k) const {
    return std::count(claims_.cells.begin(), claims_.cells.end(), static_cast<std::uint16_t>(k + 1));
  }
};

TEST_F(Claiming, WhoExplainsASurfaceHoldsIt) {
  for (const RigidTransform& pose : bin_.poses) accept(pose);
  for (std::size_t k = 0; k < bin_.poses.size(); ++k) {
    EXPECT_GT(claimed_by(k), 100);
    const ClaimedShare claimed = share(bin_.poses[k]);
    EXPECT_GT(claimed.share, 0.9F);
    EXPECT_EQ(claimed.holder, k);
  }
}

TEST_F(Claiming, APoseOnClaimedSurfaceFindsItsHolder) {
  const RigidTransform& pose = bin_.poses[0];
  accept(pose);
  RigidTransform beside = pose;
  const float width = maker_.bank().part->box_max.x() - maker_.bank().part->box_min.x();
  beside.translation += 0.05F * width * pose.rotation.col(0);
  EXPECT_GT(share(beside).share, 0.9F);
  EXPECT_EQ(share(beside).holder, 0U);
  EXPECT_EQ(share(bin_.poses[1]).share, 0.0F);
  EXPECT_EQ(share(bin_.poses[1]).holder, no_instance);
}

TEST_F(Claiming, WhatIsReleasedIsNobodys) {
  accept(bin_.poses[0]);
  const RenderedModel second = accept(bin_.poses[1]);
  const std::ptrdiff_t first = claimed_by(0);
  release(scene_.map, second, 1, claims_);
  EXPECT_EQ(claimed_by(1), 0);
  EXPECT_EQ(claimed_by(0), first);
  EXPECT_EQ(share(bin_.poses[1]).holder, no_instance);
}

TEST_F(Claiming, ARoomKeepsItsModel) {
  const RenderedModel first = accept(bin_.poses[0]);
  const std::vector<float> front(first.front.begin(), first.front.end());
  accept(bin_.poses[1]);
  const RenderedModel kept = model_in(scene_.map, claims_.rooms[0], claims_);
  EXPECT_TRUE(std::equal(front.begin(), front.end(), kept.front.begin(), kept.front.end()));
  EXPECT_EQ(kept.camera.width, first.camera.width);
}

TEST_F(Claiming, BodiesInOnePlaceShareRoom) {
  accept(bin_.poses[0]);
  EXPECT_GT(shared_room(render(bin_.poses[0]), claims_, 0.002F), 0.9F);
  EXPECT_EQ(shared_room(render(bin_.poses[1]), claims_, 0.002F), 0.0F);
}

}  // namespace
}  // namespace graspd
