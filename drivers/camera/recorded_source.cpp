#include "drivers/camera/recorded_source.hpp"

#include <algorithm>
#include <utility>

#include "drivers/files/bop_dataset.hpp"

namespace graspd {

namespace {

namespace fs = std::filesystem;

std::size_t bytes_of(const LoadedFrame& frame) {
  return (frame.depth.capacity() + frame.empty_depth.capacity()) * sizeof(float);
}

/// Takes in frame after frame while they fit.
class FrameCollector {
 public:
  explicit FrameCollector(const RecordedSourceOptions& options) : options_(options) {}

  Status add(Result<LoadedFrame> frame) {
    if (!frame.ok()) return frame.status();
    bytes_ += bytes_of(frame.value());
    if (bytes_ > options_.maximum_bytes) {
      return Status::format(StatusCode::memory_limit,
                            "%s: the frames need more than %zu MB by frame %zu: play fewer images or allow more memory",
                            options_.path.c_str(), options_.maximum_bytes >> 20U, frames.size() + 1);
    }
    frames.push_back(std::move(frame).value());
    return {};
  }

  std::vector<LoadedFrame> frames;

 private:
  const RecordedSourceOptions& options_;
  std::size_t bytes_ = 0;
};

Status collect_scene(const RecordedSourceOptions& options, FrameCollector& collector) {
  const Result<BopScene> scene = read_bop_scene(options.path);
  if (!scene.ok()) return scene.status();
  std::vector<int> images = options.images;
  if (images.empty()) {
    for (const BopImage& image : scene.value().images) images.push_back(image.im_id);
  }
  for (const int im_id : images) {
    const Status status = collector.add(load_bop_frame(scene.value(), im_id, options.files.empty_file));
    if (!status.ok()) return status;
  }
  return {};
}

Status collect_folder(const RecordedSourceOptions& options, FrameCollector& collector) {
  std::vector<fs::path> paths;
  std::error_code error;
  for (fs::directory_iterator entry(options.path, error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    if (is_frame_file(entry->path())) paths.push_back(entry->path());
  }
  if (error) {
    return Status::format(StatusCode::bad_file, "cannot read %s: %s", options.path.c_str(), error.message().c_str());
  }
  std::sort(paths.begin(), paths.end());
  for (const fs::path& path : paths) {
    const Status status = collector.add(load_frame(path, options.files));
    if (!status.ok()) return status;
  }
  if (!paths.empty()) return {};
  return Status::format(StatusCode::bad_file,
                        "%s: nothing to play: neither a BOP scene nor a folder with .png, .tif, .ply or .pcd frames",
                        options.path.c_str());
}

Status collect(const RecordedSourceOptions& options, FrameCollector& collector) {
  std::error_code ignored;
  if (is_bop_scene(options.path)) return collect_scene(options, collector);
  if (!options.images.empty()) {
    return Status::format(StatusCode::bad_file,
                          "%s: images can be chosen from a BOP scene only, and this folder has no scene_camera.json",
                          options.path.c_str());
  }
  if (fs::is_directory(options.path, ignored)) return collect_folder(options, collector);
  return collector.add(load_frame(options.path, options.files));
}

}  // namespace

Result<std::vector<LoadedFrame>> load_recorded_frames(const RecordedSourceOptions& options) {
  FrameCollector collector(options);
  const Status status = collect(options, collector);
  if (!status.ok()) return status;
  return std::move(collector.frames);
}

Result<std::unique_ptr<RecordedSource>> RecordedSource::open(const RecordedSourceOptions& options) {
  Result<std::vector<LoadedFrame>> frames = load_recorded_frames(options);
  if (!frames.ok()) return frames.status();
  return std::unique_ptr<RecordedSource>(new RecordedSource(std::move(frames).value()));
}

RecordedSource::RecordedSource(std::vector<LoadedFrame> frames) : frames_(std::move(frames)) {
  for (const LoadedFrame& frame : frames_) {
    limits_.maximum_width = std::max(limits_.maximum_width, frame.camera.width);
    limits_.maximum_height = std::max(limits_.maximum_height, frame.camera.height);
  }
}

Status RecordedSource::grab(std::span<float> storage, DepthFrame& frame) {
  const std::size_t next = grabbed_ % frames_.size();
  const LoadedFrame& source = frames_[next];
  if (storage.size() < source.depth.size()) {
    return Status::format(StatusCode::bad_frame, "%s: %d x %d pixels do not fit into room for %zu", source.name.c_str(),
                          source.camera.width, source.camera.height, storage.size());
  }
  std::copy(source.depth.begin(), source.depth.end(), storage.begin());
  last_ = next;
  ++grabbed_;
  frame = {source.camera, storage.first(source.depth.size()), 0, grabbed_};
  return {};
}

DepthFrame RecordedSource::empty_bin() {
  LoadedFrame& last = frames_[last_];
  return {last.camera, last.empty_depth, 0, 0};
}

std::string_view RecordedSource::frame_name() const { return frames_[last_].name; }

std::size_t RecordedSource::bytes() const {
  std::size_t sum = 0;
  for (const LoadedFrame& frame : frames_) sum += bytes_of(frame);
  return sum;
}

}  // namespace graspd
