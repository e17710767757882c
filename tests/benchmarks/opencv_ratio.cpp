// Runs graspd and OpenCV's surface_matching on the same frames; see peer_ratio.hpp.

#include <CLI/CLI.hpp>

#include "tests/benchmarks/opencv_peer.hpp"
#include "tests/benchmarks/peer_ratio.hpp"

int main(int argc, char** argv) {
  graspd::RatioOptions options;
  graspd::OpenCvSettings settings;
  CLI::App app("Compares graspd with OpenCV's surface_matching");
  graspd::add_ratio_options(app, options);
  app.add_option("--sampling", settings.sampling, "Share of the diameter")->capture_default_str();
  app.add_option("--reference-share", settings.reference_share, "Of the scene points")->capture_default_str();
  app.add_option("--cluster-position", settings.cluster_position, "Share of the diameter")->capture_default_str();
  app.add_option("--cluster-rotation", settings.cluster_rotation, "Radians")->capture_default_str();
  app.add_option("--refined", settings.refined, "Poses that OpenCV's ICP refines")->capture_default_str();
  app.add_option("--icp-iterations", settings.icp_iterations)->capture_default_str();
  app.add_option("--icp-tolerance", settings.icp_tolerance)->capture_default_str();
  app.add_option("--icp-rejection", settings.icp_rejection)->capture_default_str();
  app.add_option("--icp-levels", settings.icp_levels)->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return graspd::run_comparison("opencv_ratio", graspd::opencv_peer(settings), options);
}
