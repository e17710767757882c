// Runs graspd and PCL's PPFRegistration on the same frames; see peer_ratio.hpp.

#include <CLI/CLI.hpp>

#include "tests/benchmarks/pcl_peer.hpp"
#include "tests/benchmarks/peer_ratio.hpp"

int main(int argc, char** argv) {
  graspd::RatioOptions options;
  graspd::PclSettings settings;
  CLI::App app("Compares graspd with PCL's PPFRegistration");
  graspd::add_ratio_options(app, options);
  app.add_option("--sampling", settings.sampling, "Share of the diameter")->capture_default_str();
  app.add_option("--angle-step", settings.angle_step, "Radians")->capture_default_str();
  app.add_option("--reference-step", settings.reference_step, "Every so many scene points")->capture_default_str();
  app.add_option("--cluster-position", settings.cluster_position, "Share of the diameter")->capture_default_str();
  app.add_option("--cluster-rotation", settings.cluster_rotation, "Radians")->capture_default_str();
  app.add_option("--instances", settings.instances, "Alignments in a frame")->capture_default_str();
  app.add_option("--icp-iterations", settings.icp_iterations)->capture_default_str();
  app.add_option("--icp-distance", settings.icp_distance, "Share of the diameter")->capture_default_str();
  app.add_option("--taken-distance", settings.taken_distance, "Share of the diameter")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return graspd::run_comparison("pcl_ratio", graspd::pcl_peer(settings), options);
}
