#include "drivers/camera/genicam_device.hpp"

#include <arv.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace graspd {
namespace {

/// Aravis' way to say what went wrong.
class Problem {
 public:
  Problem() = default;
  ~Problem() { g_clear_error(&error_); }
  Problem(const Problem&) = delete;
  Problem& operator=(const Problem&) = delete;

  GError** place() {
    g_clear_error(&error_);
    return &error_;
  }
  [[nodiscard]] bool none() const { return error_ == nullptr; }
  [[nodiscard]] const char* text() const { return none() ? "unknown reason" : error_->message; }

 private:
  GError* error_ = nullptr;
};

std::string text_or_empty(const char* text) { return text == nullptr ? std::string() : text; }

ArvGcNode* find_node(ArvCamera* camera, const char* name) {
  return arv_device_get_feature(arv_camera_get_device(camera), name);
}

/// The node when it can be used just now: cameras hide nodes that make no sense in their present mode.
ArvGcNode* find_available(ArvCamera* camera, const char* name) {
  ArvGcNode* node = find_node(camera, name);
  if (node == nullptr || !ARV_IS_GC_FEATURE_NODE(node)) return nullptr;
  Problem problem;
  const bool available = arv_gc_feature_node_is_available(ARV_GC_FEATURE_NODE(node), problem.place()) != FALSE;
  return available && problem.none() ? node : nullptr;
}

std::string described(const FeatureValue& value) {
  if (const bool* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const std::int64_t* integer = std::get_if<std::int64_t>(&value)) return std::to_string(*integer);
  if (const double* real = std::get_if<double>(&value)) {
    char text[40];
    std::snprintf(text, sizeof text, "%g", *real);
    return text;
  }
  return "\"" + std::get<std::string>(value) + "\"";
}

std::optional<double> as_number(const FeatureValue& value) {
  if (const std::int64_t* integer = std::get_if<std::int64_t>(&value)) return static_cast<double>(*integer);
  if (const double* real = std::get_if<double>(&value)) return *real;
  return std::nullopt;
}

Status refused(const Feature& feature, const std::string& why) {
  return Status::format(StatusCode::bad_configuration, "camera.features.%s = %s: %s", feature.name.c_str(),
                        described(feature.value).c_str(), why.c_str());
}

/// What the camera made of the value: nothing when it was taken, else why not.
using Refusal = std::optional<std::string>;

Refusal set_text(ArvGcNode* node, const Feature& feature) {
  const std::string* text = std::get_if<std::string>(&feature.value);
  if (text == nullptr) return "the camera wants a text";
  Problem problem;
  arv_gc_string_set_value(ARV_GC_STRING(node), text->c_str(), problem.place());
  if (!problem.none()) return problem.text();
  const std::string held = text_or_empty(arv_gc_string_get_value(ARV_GC_STRING(node), problem.place()));
  if (!problem.none()) return problem.text();
  if (held != *text) return "the camera holds \"" + held + "\" afterwards";
  return std::nullopt;
}

Refusal set_flag(ArvGcNode* node, const Feature& feature) {
  const bool* flag = std::get_if<bool>(&feature.value);
  if (flag == nullptr) return "the camera wants true or false";
  Problem problem;
  arv_gc_boolean_set_value(ARV_GC_BOOLEAN(node), *flag ? TRUE : FALSE, problem.place());
  if (!problem.none()) return problem.text();
  const bool held = arv_gc_boolean_get_value(ARV_GC_BOOLEAN(node), problem.place()) != FALSE;
  if (!problem.none()) return problem.text();
  if (held != *flag) return std::string("the camera holds ") + (held ? "true" : "false") + " afterwards";
  return std::nullopt;
}

Refusal set_integer(ArvGcNode* node, const Feature& feature) {
  const std::optional<double> number = as_number(feature.value);
  if (!number || std::trunc(*number) != *number) return "the camera wants a whole number";
  const auto value = static_cast<std::int64_t>(*number);
  Problem problem;
  arv_gc_integer_set_value(ARV_GC_INTEGER(node), value, problem.place());
  if (!problem.none()) return problem.text();
  const std::int64_t held = arv_gc_integer_get_value(ARV_GC_INTEGER(node), problem.place());
  if (!problem.none()) return problem.text();
  if (held != value) return "the camera holds " + std::to_string(held) + " afterwards";
  return std::nullopt;
}

Refusal set_real(ArvGcNode* node, const Feature& feature) {
  const std::optional<double> number = as_number(feature.value);
  if (!number) return "the camera wants a number";
  Problem problem;
  arv_gc_float_set_value(ARV_GC_FLOAT(node), *number, problem.place());
  if (!problem.none()) return problem.text();
  const double held = arv_gc_float_get_value(ARV_GC_FLOAT(node), problem.place());
  if (!problem.none()) return problem.text();
  // Cameras round times and gains to what their clocks and converters can do.
  constexpr double rounding = 0.01;
  if (!(std::abs(held - *number) <= rounding * std::abs(*number))) {
    return "the camera holds " + described(FeatureValue(held)) + " afterwards";
  }
  return std::nullopt;
}

Refusal set_node(ArvGcNode* node, const Feature& feature) {
  if (ARV_IS_GC_COMMAND(node)) {
    if (feature.value != FeatureValue(true)) return "it is a command: write true to have it executed";
    Problem problem;
    arv_gc_command_execute(ARV_GC_COMMAND(node), problem.place());
    if (!problem.none()) return problem.text();
    return std::nullopt;
  }
  if (ARV_IS_GC_ENUMERATION(node) || ARV_IS_GC_STRING(node)) return set_text(node, feature);
  if (ARV_IS_GC_BOOLEAN(node)) return set_flag(node, feature);
  if (ARV_IS_GC_INTEGER(node)) return set_integer(node, feature);
  if (ARV_IS_GC_FLOAT(node)) return set_real(node, feature);
  return "it holds no value that could be set";
}

/// The IP address of the camera that has this serial number, or of the first one; empty when none answers.
std::string address_of(const std::string& name) {
  for (const FoundCamera& camera : find_cameras()) {
    if (name == "first" || camera.serial == name) return camera.address;
  }
  return {};
}

bool is_address(const std::string& name) {
  GInetAddress* address = g_inet_address_new_from_string(name.c_str());
  if (address == nullptr) return false;
  g_object_unref(address);
  return true;
}

}  // namespace

std::vector<FoundCamera> find_cameras() {
  arv_update_device_list();
  std::vector<FoundCamera> cameras;
  for (unsigned i = 0; i < arv_get_n_devices(); ++i) {
    // Cameras on other buses than the network have no address.
    const std::string address = text_or_empty(arv_get_device_address(i));
    if (text_or_empty(arv_get_device_protocol(i)) != "GigEVision") continue;
    cameras.push_back({text_or_empty(arv_get_device_vendor(i)), text_or_empty(arv_get_device_model(i)),
                       text_or_empty(arv_get_device_serial_nbr(i)), address});
  }
  std::sort(cameras.begin(), cameras.end(), [](const FoundCamera& a, const FoundCamera& b) {
    return std::tie(a.serial, a.address) < std::tie(b.serial, b.address);
  });
  return cameras;
}

void GenicamDevice::Release::operator()(ArvCamera* camera) const { g_object_unref(camera); }

Result<GenicamDevice> GenicamDevice::open(const std::string& name) {
  const std::string address = is_address(name) ? name : address_of(name);
  if (address.empty()) {
    return Status::format(StatusCode::camera_lost,
                          name == "first" ? "no camera answers on any network%.0s"
                                          : "no camera with serial number %s answers on any network",
                          name.c_str());
  }
  Problem problem;
  ArvCamera* camera = arv_camera_new(address.c_str(), problem.place());
  if (camera == nullptr) {
    return Status::format(StatusCode::camera_lost, "camera %s: %s", address.c_str(), problem.text());
  }
  GenicamDevice device(camera);
  if (!arv_camera_is_gv_device(camera)) {
    return Status::format(StatusCode::camera_lost, "camera %s: not a GigE Vision camera", address.c_str());
  }
  if (!arv_gv_device_is_controller(ARV_GV_DEVICE(arv_camera_get_device(camera)))) {
    return Status::format(StatusCode::camera_lost, "camera %s: another program controls it", address.c_str());
  }
  return device;
}

bool GenicamDevice::has(const char* node) const { return find_available(camera_.get(), node) != nullptr; }

std::optional<double> GenicamDevice::read_number(const char* node) const {
  ArvGcNode* found = find_available(camera_.get(), node);
  if (found == nullptr) return std::nullopt;
  Problem problem;
  double value = 0;
  if (ARV_IS_GC_FLOAT(found)) {
    value = arv_gc_float_get_value(ARV_GC_FLOAT(found), problem.place());
  } else if (ARV_IS_GC_INTEGER(found)) {
    value = static_cast<double>(arv_gc_integer_get_value(ARV_GC_INTEGER(found), problem.place()));
  } else {
    return std::nullopt;
  }
  return problem.none() ? std::optional(value) : std::nullopt;
}

std::optional<std::string> GenicamDevice::read_text(const char* node) const {
  ArvGcNode* found = find_available(camera_.get(), node);
  if (found == nullptr || !ARV_IS_GC_STRING(found)) return std::nullopt;
  Problem problem;
  const std::string value = text_or_empty(arv_gc_string_get_value(ARV_GC_STRING(found), problem.place()));
  return problem.none() ? std::optional(value) : std::nullopt;
}

std::optional<bool> GenicamDevice::read_flag(const char* node) const {
  ArvGcNode* found = find_available(camera_.get(), node);
  if (found == nullptr || !ARV_IS_GC_BOOLEAN(found)) return std::nullopt;
  Problem problem;
  const bool value = arv_gc_boolean_get_value(ARV_GC_BOOLEAN(found), problem.place()) != FALSE;
  return problem.none() ? std::optional(value) : std::nullopt;
}

std::vector<std::string> GenicamDevice::choices(const char* node) const {
  std::vector<std::string> names;
  if (find_available(camera_.get(), node) == nullptr) return names;
  guint count = 0;
  Problem problem;
  const char** found = arv_camera_dup_available_enumerations_as_strings(camera_.get(), node, &count, problem.place());
  for (guint i = 0; found != nullptr && i < count; ++i) names.push_back(text_or_empty(found[i]));
  g_free(found);
  return names;
}

Status GenicamDevice::set(const Feature& feature) const {
  ArvGcNode* node = find_node(camera_.get(), feature.name.c_str());
  if (node == nullptr) return refused(feature, "the camera has no such feature");
  const Refusal refusal = set_node(node, feature);
  if (!refusal) return {};
  // A camera that is gone refuses everything.
  if (!read_number("Width") && !read_number("PayloadSize")) {
    return Status::format(StatusCode::camera_lost, "the camera stopped answering while %s was set",
                          feature.name.c_str());
  }
  return refused(feature, *refusal);
}

Status GenicamDevice::execute(const char* node) const {
  Problem problem;
  arv_camera_execute_command(camera_.get(), node, problem.place());
  if (problem.none()) return {};
  return Status::format(StatusCode::camera_lost, "%s: %s", node, problem.text());
}

}  // namespace graspd
