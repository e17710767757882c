#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/status.hpp"

using ArvCamera = struct _ArvCamera;

namespace graspd {

/// A camera that answered on the network.
struct FoundCamera {
  std::string vendor;
  std::string model;
  std::string serial;
  std::string address;  ///< IP address.
};

/// Asks all networks of this machine which GigE Vision cameras there are, in the order of their serial
/// numbers. Takes a second.
[[nodiscard]] std::vector<FoundCamera> find_cameras();

/// A value of a GenICam feature as the configuration gives it.
using FeatureValue = std::variant<bool, std::int64_t, double, std::string>;

/// Features by name, in the order in which they are to be set.
struct Feature {
  std::string name;
  FeatureValue value;
};

/// The features of one GenICam camera, which this process controls as long as the object lives. All calls go
/// over the network and may take seconds when the camera is gone; one thread at a time.
class GenicamDevice {
 public:
  /// Connects to the camera with this serial number or IP address, or to the "first" that answers. Fails with
  /// camera_lost: nobody answers, or another program controls the camera.
  [[nodiscard]] static Result<GenicamDevice> open(const std::string& name);

  /// The value of a node that exists and can be read just now.
  [[nodiscard]] std::optional<double> read_number(const char* node) const;
  [[nodiscard]] std::optional<std::string> read_text(const char* node) const;
  [[nodiscard]] std::optional<bool> read_flag(const char* node) const;
  /// The choices of an enumeration that are available just now; none when there is no such node.
  [[nodiscard]] std::vector<std::string> choices(const char* node) const;
  [[nodiscard]] bool has(const char* node) const;

  /// Sets a feature and reads it back. Fails with bad_configuration when the camera has no such feature, it
  /// is of another type, or it holds another value afterwards; with camera_lost when nobody answers.
  [[nodiscard]] Status set(const Feature& feature) const;
  /// Executes a command node. Fails with camera_lost.
  [[nodiscard]] Status execute(const char* node) const;

  [[nodiscard]] ArvCamera* handle() const { return camera_.get(); }

 private:
  struct Release {
    void operator()(ArvCamera* camera) const;
  };
  explicit GenicamDevice(ArvCamera* camera) : camera_(camera) {}

  std::unique_ptr<ArvCamera, Release> camera_;
};

}  // namespace graspd
