#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/files/bop_dataset.hpp"
#include "drivers/files/load_frame.hpp"
#include "drivers/files/whole_file.hpp"
#include "tests/drivers/files/bop_scene.hpp"

namespace graspd {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

template <class T>
std::string refusal(const Result<T>& result, StatusCode code = StatusCode::bad_file) {
  EXPECT_EQ(result.status().code(), code);
  return std::string(result.status().message());
}

class BopDataset : public ::testing::Test {
 protected:
  BopFolder folder_;
};

TEST_F(BopDataset, SceneHasItsImagesByNumber) {
  const Result<BopScene> scene = read_bop_scene(bop_scene_folder(folder_.root(), "val", 3));
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  EXPECT_EQ(scene.value().scene_id, 3);
  ASSERT_EQ(scene.value().images.size(), 2U);
  EXPECT_EQ(scene.value().images[0].im_id, 0);
  const BopImage* const image = scene.value().find(7);
  ASSERT_NE(image, nullptr);
  EXPECT_FLOAT_EQ(image->camera.fx, 500.0F);
  EXPECT_FLOAT_EQ(image->camera.fy, 510.0F);
  EXPECT_FLOAT_EQ(image->camera.cx, 4.5F);
  EXPECT_FLOAT_EQ(image->camera.cy, 3.25F);
  EXPECT_FLOAT_EQ(image->depth_scale, 0.1F);
  ASSERT_TRUE(image->camera_from_world.has_value());
  EXPECT_TRUE((*image->camera_from_world * Vector3(0, 0, 1)).isApprox(Vector3(0.01F, -0.98F, 0.03F)));
  EXPECT_FALSE(scene.value().images[0].camera_from_world.has_value());
  EXPECT_EQ(scene.value().find(1), nullptr);
  EXPECT_EQ(read_bop_scene(folder_.scene() / "").value().scene_id, 3);
}

TEST_F(BopDataset, BadSceneCameraNamesImageAndField) {
  const auto changed = [&](const std::string& from, const std::string& to) {
    const BopFolder folder;
    folder.change("val/000003/scene_camera.json", from, to);
    return refusal(read_bop_scene(folder.scene()));
  };
  EXPECT_THAT(changed("\"cam_K\": [400, 0, 4, 0, 400, 3, 0, 0, 1], ", ""),
              HasSubstr("scene_camera.json: image 0: no cam_K"));
  EXPECT_THAT(changed("[400, 0, 4, 0, 400, 3, 0, 0, 1]", "[400, 0, 4]"),
              HasSubstr("image 0: cam_K must be a list of 9"));
  EXPECT_THAT(changed("[400,", "[\"x\","), HasSubstr("image 0: cam_K must be a list of 9 numbers"));
  EXPECT_THAT(changed("[400,", "[0,"), HasSubstr("focal length that is not > 0"));
  EXPECT_THAT(changed("\"depth_scale\": 0.5", "\"depth_scale\": 0"), HasSubstr("image 0: depth_scale"));
  EXPECT_THAT(changed("[1,0,0,", "[2,0,0,"), HasSubstr("image 7: cam_R_w2c is not a rotation matrix"));
  EXPECT_THAT(changed("\"7\": {", "\"seven\": {"), HasSubstr("'seven' is not the number of an image"));
  EXPECT_THAT(changed("\"depth_scale\": 0.5}", "\"depth_scale\" 0.5}"), HasSubstr("scene_camera.json:3: not JSON"));
  folder_.write("val/000003/scene_camera.json", "{}");
  EXPECT_THAT(refusal(read_bop_scene(folder_.scene())), HasSubstr("no images"));
  folder_.write("val/000003/scene_camera.json", "[1, 2]");
  EXPECT_THAT(refusal(read_bop_scene(folder_.scene())), HasSubstr("not an object"));
  EXPECT_THAT(refusal(read_bop_scene(folder_.root() / "none")), HasSubstr("No such file"));
}

TEST_F(BopDataset, GroundTruthInMetres) {
  const Result<std::vector<BopInstance>> truth = read_bop_ground_truth(folder_.scene());
  ASSERT_TRUE(truth.ok()) << truth.status().message();
  ASSERT_EQ(truth.value().size(), 2U);
  EXPECT_EQ(truth.value()[0].im_id, 7);
  EXPECT_EQ(truth.value()[0].obj_id, 2);
  EXPECT_FLOAT_EQ(truth.value()[0].visible_share, 0.25F);
  EXPECT_TRUE((truth.value()[0].camera_from_part * Vector3(0, 0, 0.1F)).isApprox(Vector3(0.1F, -0.3F, 0.7F)));

  fs::remove(folder_.scene() / "scene_gt_info.json");
  EXPECT_FLOAT_EQ(read_bop_ground_truth(folder_.scene()).value()[1].visible_share, -1.0F);
}

TEST_F(BopDataset, BadGroundTruthNamesImageObjectAndField) {
  folder_.change("val/000003/scene_gt_info.json", ", {\"visib_fract\": 1.0}", "");
  EXPECT_THAT(refusal(read_bop_ground_truth(folder_.scene())), HasSubstr("scene_gt_info.json: image 7: not a list"));
  folder_.change("val/000003/scene_gt.json", "\"cam_t_m2c\": [0, 0, 650.5], ", "");
  fs::remove(folder_.scene() / "scene_gt_info.json");
  EXPECT_THAT(refusal(read_bop_ground_truth(folder_.scene())),
              HasSubstr("scene_gt.json: image 7: object 1: no cam_t_m2c"));
}

TEST_F(BopDataset, TargetsAreSorted) {
  const Result<std::vector<BopTarget>> targets = read_bop_targets(folder_.root(), "val");
  ASSERT_TRUE(targets.ok()) << targets.status().message();
  ASSERT_EQ(targets.value().size(), 2U);
  EXPECT_EQ(targets.value()[0].im_id, 0);
  EXPECT_EQ(targets.value()[1].inst_count, 2);
  EXPECT_THAT(refusal(read_bop_targets(folder_.root(), "test")), HasSubstr("test_targets_bop19.json: No such file"));
  folder_.change("val_targets_bop19.json", "\"im_id\": 7", "\"im_id\": 7.5");
  EXPECT_THAT(refusal(read_bop_targets(folder_.root(), "val")), HasSubstr("target 0: im_id must be a whole number"));
}

TEST_F(BopDataset, SplitsOfOneSensorShareTheirTargets) {
  fs::rename(folder_.root() / "val_targets_bop19.json", folder_.root() / "test_targets_bop19.json");
  fs::rename(folder_.root() / "val", folder_.root() / "test_primesense");
  EXPECT_EQ(read_bop_targets(folder_.root(), "test_primesense").value().size(), 2U);
  folder_.write("test_primesense_targets_bop19.json", R"([{"scene_id": 3, "im_id": 7, "obj_id": 2}])");
  EXPECT_EQ(read_bop_targets(folder_.root(), "test_primesense").value().size(), 1U);
}

TEST_F(BopDataset, WithoutATargetsFileWhatIsVisibleIsATarget) {
  fs::remove(folder_.root() / "val_targets_bop19.json");
  const auto count = [&] {
    const Result<std::vector<BopTarget>> targets = read_bop_targets(folder_.root(), "val");
    if (!targets.ok() || targets.value().size() != 1) return -1;
    const BopTarget& target = targets.value().front();
    return target.scene_id == 3 && target.im_id == 7 && target.obj_id == 2 ? target.inst_count : -1;
  };
  EXPECT_EQ(count(), 2);
  folder_.change("val/000003/scene_gt_info.json", "0.25", "0.09");
  EXPECT_EQ(count(), 1);
  folder_.change("val/000003/scene_gt_info.json", "1.0", "0.0");
  EXPECT_THAT(refusal(read_bop_targets(folder_.root(), "val")), HasSubstr("val: nothing visible in the ground truth"));
  fs::remove(folder_.scene() / "scene_gt_info.json");
  EXPECT_EQ(count(), 2);
  folder_.change("val/000003/scene_gt.json", "\"obj_id\": 2", "\"obj_id\": 2.5");
  EXPECT_THAT(refusal(read_bop_targets(folder_.root(), "val")), HasSubstr("object 0: obj_id must be a whole number"));
  fs::remove(folder_.scene() / "scene_gt.json");
  EXPECT_THAT(refusal(read_bop_targets(folder_.root(), "val")), HasSubstr("val_targets_bop19.json: No such file"));
}

TEST_F(BopDataset, ModelsOfAnotherKind) {
  fs::create_directory(folder_.root() / "models_eval");
  fs::rename(folder_.root() / "models", folder_.root() / "models_cad");
  const Result<std::vector<BopModel>> models = read_bop_models(folder_.root());
  ASSERT_TRUE(models.ok()) << models.status().message();
  EXPECT_EQ(models.value().front().mesh_file, folder_.root() / "models_cad" / "obj_000002.ply");
  fs::remove(folder_.root() / "models_cad" / "models_info.json");
  EXPECT_THAT(refusal(read_bop_models(folder_.root())), HasSubstr("models/models_info.json: No such file"));
}

TEST_F(BopDataset, ModelsWithSymmetriesInMetres) {
  const Result<std::vector<BopModel>> models = read_bop_models(folder_.root());
  ASSERT_TRUE(models.ok()) << models.status().message();
  ASSERT_EQ(models.value().size(), 1U);
  const BopModel& model = models.value()[0];
  EXPECT_EQ(model.obj_id, 2);
  EXPECT_FLOAT_EQ(model.diameter, 0.05F);
  EXPECT_EQ(model.mesh_file.filename(), "obj_000002.ply");
  ASSERT_EQ(model.symmetry_discrete.size(), 1U);
  EXPECT_TRUE((model.symmetry_discrete[0] * Vector3(0.001F, 0, 0)).isApprox(Vector3(0.003F, 0.002F, 0)));
  ASSERT_EQ(model.symmetry_continuous.size(), 1U);
  EXPECT_TRUE(model.symmetry_continuous[0].direction.isApprox(Vector3::UnitZ()));
  EXPECT_FLOAT_EQ(model.symmetry_continuous[0].point.x(), 0.001F);
}

TEST_F(BopDataset, BadModelsNameObjectAndField) {
  const auto changed = [](const std::string& from, const std::string& to) {
    const BopFolder folder;
    folder.change("models/models_info.json", from, to);
    return refusal(read_bop_models(folder.root()));
  };
  EXPECT_THAT(changed("\"diameter\": 50.0, ", ""), HasSubstr("models_info.json: object 2: no diameter"));
  EXPECT_THAT(changed("\"diameter\": 50.0", "\"diameter\": -1"), HasSubstr("diameter must be greater than 0"));
  EXPECT_THAT(changed("[[-1,0,0,4,", "[[-1,0,0,"), HasSubstr("symmetries_discrete must hold lists of 16 numbers"));
  EXPECT_THAT(changed("[[-1,0,0,4,", "[[1,0,0,4,"), HasSubstr("not a rigid transform"));
  EXPECT_THAT(changed("[0, 0, 2]", "[0, 0, 0]"), HasSubstr("symmetries_continuous: axis has no length"));
  EXPECT_THAT(changed("\"2\": {", "\"5\": {"), HasSubstr("obj_000005.ply: no such file"));
}

TEST_F(BopDataset, FilesOfOneSensorOfSeveral) {
  for (const char* name : {"depth", "empty"})
    fs::rename(folder_.scene() / name, folder_.scene() / bop_name(name, "far"));
  for (const char* name : {"scene_camera", "scene_gt", "scene_gt_info"}) {
    fs::rename(folder_.scene() / bop_name(name, "", ".json"), folder_.scene() / bop_name(name, "far", ".json"));
  }
  fs::remove(folder_.root() / "val_targets_bop19.json");
  EXPECT_FALSE(is_bop_scene(folder_.scene()));
  const Result<BopScene> scene = read_bop_scene(folder_.scene(), "far");
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  Result<LoadedFrame> frame = load_bop_frame(scene.value(), 7);
  ASSERT_TRUE(frame.ok()) << frame.status().message();
  EXPECT_FLOAT_EQ(frame.value().depth[1], 0.7F);
  EXPECT_FLOAT_EQ(frame.value().empty_depth[1], 0.8F);
  EXPECT_EQ(read_bop_targets(folder_.root(), "val", "far").value().front().inst_count, 2);
  EXPECT_THAT(refusal(read_bop_scene(folder_.scene(), "near")), HasSubstr("scene_camera_near.json: No such file"));

  frame = load_frame(folder_.scene() / "depth_far" / "000007.png", {});
  ASSERT_TRUE(frame.ok()) << frame.status().message();
  EXPECT_FLOAT_EQ(frame.value().depth[1], 0.7F);
  EXPECT_FLOAT_EQ(frame.value().camera.fy, 510.0F);
  frame = load_frame(folder_.scene() / "empty_far" / "000000.png", {});
  ASSERT_TRUE(frame.ok()) << frame.status().message();
  EXPECT_FLOAT_EQ(frame.value().camera.fy, 400.0F);
}

TEST_F(BopDataset, FrameInMetresWithItsEmptyBin) {
  const BopScene scene = read_bop_scene(folder_.scene()).value();
  Result<LoadedFrame> frame = load_bop_frame(scene, 7);
  ASSERT_TRUE(frame.ok()) << frame.status().message();
  EXPECT_EQ(frame.value().camera.width, BopFolder::width);
  EXPECT_EQ(frame.value().camera.height, BopFolder::height);
  EXPECT_EQ(frame.value().depth[0], 0.0F);
  EXPECT_FLOAT_EQ(frame.value().depth[1], 0.7F);
  EXPECT_FLOAT_EQ(frame.value().empty_bin().at(1, 0), 0.8F);

  folder_.write_depth("val/000003/empty/000007.png", 9000);
  EXPECT_FLOAT_EQ(load_bop_frame(scene, 7).value().empty_depth[1], 0.9F);
  fs::remove_all(folder_.scene() / "empty");
  EXPECT_TRUE(load_bop_frame(scene, 7).value().empty_depth.empty());
}

TEST_F(BopDataset, BadFramesAreRefused) {
  const BopScene scene = read_bop_scene(folder_.scene()).value();
  EXPECT_THAT(refusal(load_bop_frame(scene, 1)), HasSubstr("scene_camera.json: no image 1"));
  folder_.write_depth("val/000003/empty/000000.png", 9000, 4);
  EXPECT_THAT(refusal(load_bop_frame(scene, 7), StatusCode::bad_frame),
              HasSubstr("4 x 6 pixels, but the camera has 8 x 6"));
  folder_.write_depth("val/000003/empty/000000.png", 0);
  EXPECT_THAT(refusal(load_bop_frame(scene, 7), StatusCode::bad_frame),
              HasSubstr("empty/000000.png: no pixel is measured"));
  folder_.write_depth("val/000003/depth/000007.png", 100);
  EXPECT_THAT(refusal(load_bop_frame(scene, 7), StatusCode::bad_frame),
              HasSubstr("depth/000007.png: what it shows lies 0.01 metres away"));
  folder_.write_depth("val/000003/depth/000007.png", 0);
  EXPECT_THAT(refusal(load_bop_frame(scene, 7), StatusCode::bad_frame), HasSubstr("no pixel is measured"));
  fs::remove(folder_.scene() / "depth" / "000007.png");
  EXPECT_THAT(refusal(load_bop_frame(scene, 7)), HasSubstr("000007.png: no such file (nor .tif or .tiff)"));
}

TEST_F(BopDataset, ResultsComeBackAsTheyWereWritten) {
  BopResult result{3, 7, 2, 0.875F, {}, 0.25F};
  result.camera_from_part.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  result.camera_from_part.translation = Vector3(0.1F, -0.02F, 0.7F);
  const fs::path path = folder_.root() / "results.csv";
  ASSERT_TRUE(write_bop_results(path, {result, result}).ok());
  EXPECT_THAT(read_file(path).value(),
              ::testing::StartsWith("scene_id,im_id,obj_id,score,R,t,time\n3,7,2,0.875000,0.00000000 -1.00000000 "));
  const Result<std::vector<BopResult>> results = read_bop_results(path);
  ASSERT_TRUE(results.ok()) << results.status().message();
  ASSERT_EQ(results.value().size(), 2U);
  const BopResult& back = results.value()[1];
  EXPECT_EQ(back.scene_id, 3);
  EXPECT_EQ(back.im_id, 7);
  EXPECT_EQ(back.obj_id, 2);
  EXPECT_FLOAT_EQ(back.score, 0.875F);
  EXPECT_FLOAT_EQ(back.seconds, 0.25F);
  EXPECT_TRUE(back.camera_from_part.rotation.isApprox(result.camera_from_part.rotation));
  EXPECT_TRUE(back.camera_from_part.translation.isApprox(result.camera_from_part.translation, 1e-6F));
}

TEST_F(BopDataset, BadResultsNameLineAndField) {
  const std::string header = "scene_id,im_id,obj_id,score,R,t,time\n";
  const auto refused = [&](const std::string& text) {
    return refusal(read_bop_results(folder_.write("bad.csv", text)));
  };
  EXPECT_THAT(refused("1,2,3\n"), HasSubstr("bad.csv:1: the first line must be"));
  EXPECT_THAT(refused(header + "1,2,x,0.5,1 0 0 0 1 0 0 0 1,0 0 0,-1\n"), HasSubstr("bad.csv:2: obj_id"));
  EXPECT_THAT(refused(header + "1,2,3,0.5,1 0 0 0 1 0 0 0,0 0 0,-1\n"), HasSubstr("bad.csv:2: R (nine numbers)"));
  EXPECT_THAT(refused(header + "1,2,3,0.5,1 0 0 0 1 0 0 0 1,0 0 0 0,-1\n"), HasSubstr("t (three numbers)"));
  EXPECT_THAT(refused(header + "1,2,3,0.5,1 0 0 0 1 0 0 0 1,0 0 0\n"), HasSubstr("bad.csv:2: time"));
}

}  // namespace
}  // namespace graspd
