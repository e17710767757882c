#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "drivers/files/bop_evaluation.hpp"
#include "tests/drivers/files/temporary_folder.hpp"

namespace graspd {
namespace {

/// A triangle whose longest side is `size` millimetres.
std::string triangle_ply(int size) {
  const std::string side = std::to_string(size);
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n" +
         side + " 0 0\n0 10 0\n3 0 1 2\n";
}

class BopEvaluation : public testing::Test {
 protected:
  TemporaryFolder folder_;
  std::filesystem::path root_ = folder_.path();

  void SetUp() override {
    folder_.write("models/models_info.json",
                  R"({"4": {"diameter": 50, "symmetries_continuous": [{"axis": [0, 0, 1], "offset": [0, 0, 0]}]},
              "9": {"diameter": 20, "symmetries_discrete": [[-1,0,0,0, 0,-1,0,0, 0,0,1,0, 0,0,0,1]]}})");
    folder_.write("models/obj_000004.ply", triangle_ply(50));
    folder_.write("models/obj_000009.ply", triangle_ply(20));
    folder_.write("val_targets_bop19.json",
                  R"([{"scene_id": 2, "im_id": 5, "obj_id": 9, "inst_count": 2},
              {"scene_id": 2, "im_id": 5, "obj_id": 4, "inst_count": 1},
              {"scene_id": 1, "im_id": 0, "obj_id": 4, "inst_count": 3}])");
    const std::string pose = R"("cam_R_m2c": [1,0,0, 0,1,0, 0,0,1], "cam_t_m2c": [10, 0, 500])";
    folder_.write("val/000002/scene_gt.json", "{\"4\": [{\"obj_id\": 9, " + pose + "}], \"5\": [{\"obj_id\": 4, " +
                                                  pose + "}, {\"obj_id\": 9, " + pose + "}]}");
    folder_.write("val/000002/scene_gt_info.json",
                  R"({"4": [{"visib_fract": 1.0}], "5": [{"visib_fract": 0.25}, {"visib_fract": 0.5}]})");
    folder_.write("val/000002/scene_meta.json", R"({"5": {"level": "hard"}})");
    std::filesystem::create_directories(root_ / "val/000001");
  }
};

TEST_F(BopEvaluation, ReadsPartsWithTheirSymmetries) {
  const Result<std::vector<EvaluationPart>> parts = read_evaluation_parts(root_);
  ASSERT_TRUE(parts.ok()) << parts.status().message();
  ASSERT_EQ(parts.value().size(), 2U);
  EXPECT_EQ(parts.value()[0].id, 4U);
  EXPECT_NEAR(parts.value()[0].diameter, 0.05F, 1e-7F);
  EXPECT_EQ(parts.value()[0].symmetries.size(), 315U);
  EXPECT_EQ(parts.value()[1].symmetries.size(), 2U);
  EXPECT_EQ(parts.value()[1].vertices.size(), 3U);
}

TEST_F(BopEvaluation, PrefersTheModelsMadeForEvaluation) {
  folder_.write("models_eval/obj_000004.ply", triangle_ply(48));
  const Result<std::vector<EvaluationPart>> parts = read_evaluation_parts(root_);
  ASSERT_TRUE(parts.ok()) << parts.status().message();
  EXPECT_NEAR(parts.value()[0].mesh.vertices[1].x(), 0.048F, 1e-7F);
  EXPECT_NEAR(parts.value()[1].mesh.vertices[1].x(), 0.02F, 1e-7F);
}

TEST_F(BopEvaluation, GathersTargetsAndTruthsOfAnImage) {
  const Result<std::vector<EvaluationImage>> images = read_evaluation_images(root_, "val");
  ASSERT_TRUE(images.ok()) << images.status().message();
  ASSERT_EQ(images.value().size(), 2U);
  const EvaluationImage& blind = images.value()[0];
  EXPECT_EQ(blind.scene, 1U);
  EXPECT_FALSE(blind.annotated);
  EXPECT_TRUE(blind.truths.empty());
  EXPECT_EQ(blind.level, "");
  ASSERT_EQ(blind.targets.size(), 1U);
  EXPECT_EQ(blind.targets[0].instances, 3U);
  const EvaluationImage& annotated = images.value()[1];
  EXPECT_TRUE(annotated.annotated);
  EXPECT_EQ(annotated.image, 5U);
  EXPECT_EQ(annotated.level, "hard");
  EXPECT_EQ(annotated.targets.size(), 2U);
  ASSERT_EQ(annotated.truths.size(), 2U);
  EXPECT_EQ(annotated.truths[1].part, 9U);
  EXPECT_EQ(annotated.truths[1].visibility, 0.5F);
  EXPECT_NEAR(annotated.truths[1].camera_from_part.translation.z(), 0.5F, 1e-7F);
}

TEST_F(BopEvaluation, RefusesADamagedGroundTruth) {
  folder_.write("val/000002/scene_gt.json", "{\"5\": [{\"obj_id\": 4}]}");
  const Result<std::vector<EvaluationImage>> images = read_evaluation_images(root_, "val");
  ASSERT_FALSE(images.ok());
  EXPECT_EQ(images.status().code(), StatusCode::bad_file);
}

}  // namespace
}  // namespace graspd
