#include <cstdio>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "drivers/camera/depth_decoding.hpp"
#include "drivers/camera/simulated_registers.hpp"

namespace graspd {
namespace {

namespace reg = simulated_register;

constexpr const char* read_only = "RO";
constexpr const char* read_write = "RW";

/// Puts the description together, feature by feature.
class Description {
 public:
  void category(const char* name, std::initializer_list<const char*> features) {
    text_ += "<Category Name=\"" + std::string(name) + "\" NameSpace=\"Standard\">";
    for (const char* feature : features) text_ += "<pFeature>" + std::string(feature) + "</pFeature>";
    text_ += "</Category>\n";
  }

  void text(const char* name, std::uint32_t address, int length) {
    text_ += "<StringReg Name=\"" + std::string(name) + "\" NameSpace=\"Standard\">" +
             place(address, length, read_only) + "</StringReg>\n";
  }

  void integer(const char* name, std::uint32_t address, const char* access = read_only) {
    const std::string own = std::string(name) + "Register";
    text_ +=
        "<Integer Name=\"" + std::string(name) + "\" NameSpace=\"Standard\"><pValue>" + own + "</pValue></Integer>\n";
    integer_register(own, address, access);
  }

  void flag(const char* name, std::uint32_t address, const char* access = read_only, std::string_view index = {}) {
    const std::string own = std::string(name) + "Register";
    text_ += "<Boolean Name=\"" + std::string(name) + "\" NameSpace=\"Standard\"><pValue>" + own +
             "</pValue><OnValue>1</OnValue><OffValue>0</OffValue></Boolean>\n";
    integer_register(own, address, access, index);
  }

  void real(const char* name, std::uint32_t address, const char* access = read_only) {
    text_ += "<FloatReg Name=\"" + std::string(name) + "\" NameSpace=\"Standard\">" + place(address, 8, access) +
             "<Endianess>BigEndian</Endianess></FloatReg>\n";
  }

  void command(const char* name, std::uint32_t address, int value, const char* own) {
    text_ += "<Command Name=\"" + std::string(name) + "\" NameSpace=\"Standard\"><pValue>" + own +
             "</pValue><CommandValue>" + std::to_string(value) + "</CommandValue></Command>\n";
    if (address != 0) integer_register(own, address, read_write);
  }

  void choice(const char* name, std::uint32_t address, const char* access,
              std::initializer_list<std::pair<const char*, std::uint32_t>> entries) {
    const std::string own = std::string(name) + "Register";
    text_ += "<Enumeration Name=\"" + std::string(name) + "\" NameSpace=\"Standard\">";
    for (const auto& [entry, value] : entries) {
      text_ += "<EnumEntry Name=\"" + std::string(entry) + "\" NameSpace=\"Standard\"><Value>" + std::to_string(value) +
               "</Value></EnumEntry>";
    }
    text_ += "<pValue>" + own + "</pValue></Enumeration>\n";
    integer_register(own, address, access);
  }

  [[nodiscard]] std::string finished() const {
    return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
           "<RegisterDescription ModelName=\"Simulated3DCamera\" VendorName=\"graspd\" StandardNameSpace=\"GEV\" "
           "SchemaMajorVersion=\"1\" SchemaMinorVersion=\"1\" SchemaSubMinorVersion=\"0\" MajorVersion=\"1\" "
           "MinorVersion=\"0\" SubMinorVersion=\"0\" ToolTip=\"A 3D camera that plays frames\" "
           "ProductGuid=\"00000000-0000-0000-0000-000000000000\" VersionGuid=\"00000000-0000-0000-0000-000000000000\" "
           "xmlns=\"http://www.genicam.org/GenApi/Version_1_1\" "
           "xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\">\n" +
           text_ + "<Port Name=\"Device\" NameSpace=\"Standard\"/>\n</RegisterDescription>\n";
  }

 private:
  static std::string place(std::uint32_t address, int length, const char* access, std::string_view index = {}) {
    char hexadecimal[16];
    std::snprintf(hexadecimal, sizeof hexadecimal, "0x%x", static_cast<unsigned>(address));
    std::string text = "<Address>" + std::string(hexadecimal) + "</Address>";
    if (!index.empty()) text += "<pIndex Offset=\"4\">" + std::string(index) + "</pIndex>";
    return text + "<Length>" + std::to_string(length) + "</Length><AccessMode>" + access +
           "</AccessMode><pPort>Device</pPort>";
  }

  void integer_register(const std::string& name, std::uint32_t address, const char* access,
                        std::string_view index = {}) {
    text_ += "<IntReg Name=\"" + name + "\" NameSpace=\"Custom\">" + place(address, 4, access, index) +
             "<Sign>Unsigned</Sign><Endianess>BigEndian</Endianess></IntReg>\n";
  }

  std::string text_;
};

constexpr std::uint32_t number(PixelFormat format) { return static_cast<std::uint32_t>(format); }
constexpr std::uint32_t number(SimulatedOutputMode mode) { return static_cast<std::uint32_t>(mode); }
constexpr std::uint32_t number(SimulatedComponent component) { return static_cast<std::uint32_t>(component); }

}  // namespace

std::string simulated_camera_xml() {
  Description d;
  d.category("Root", {"DeviceControl", "ImageFormatControl", "AcquisitionControl", "EventControl", "Scan3dControl",
                      "TransportLayerControl"});
  d.category("DeviceControl", {"DeviceVendorName", "DeviceModelName", "DeviceVersion", "DeviceSerialNumber"});
  d.text("DeviceVendorName", reg::manufacturer_name, 32);
  d.text("DeviceModelName", reg::model_name, 32);
  d.text("DeviceVersion", reg::device_version, 32);
  d.text("DeviceSerialNumber", reg::serial_number, 16);

  d.category("ImageFormatControl",
             {"Width", "Height", "OffsetX", "OffsetY", "ComponentSelector", "ComponentEnable", "PixelFormat"});
  d.integer("Width", reg::width);
  d.integer("Height", reg::height);
  d.integer("OffsetX", reg::offset_x);
  d.integer("OffsetY", reg::offset_y);
  d.choice("ComponentSelector", reg::component_selector, read_write,
           {{"Range", number(SimulatedComponent::range)},
            {"Confidence", number(SimulatedComponent::confidence)},
            {"Intensity", number(SimulatedComponent::intensity)}});
  d.flag("ComponentEnable", reg::component_enable, read_write, "ComponentSelectorRegister");
  d.choice("PixelFormat", reg::pixel_format, read_write,
           {{"Mono16", number(PixelFormat::mono16)},
            {"Coord3D_C16", number(PixelFormat::coordinate_c16)},
            {"Coord3D_C32f", number(PixelFormat::coordinate_c32f)},
            {"Coord3D_ABC16", number(PixelFormat::coordinate_abc16)},
            {"Coord3D_ABC32f", number(PixelFormat::coordinate_abc32f)}});

  d.category("AcquisitionControl",
             {"AcquisitionMode", "AcquisitionStart", "AcquisitionStop", "AcquisitionFramePeriod", "TriggerSelector",
              "TriggerMode", "TriggerSource", "TriggerSoftware", "ExposureTime"});
  d.choice("AcquisitionMode", reg::acquisition_mode, read_write, {{"Continuous", 0}});
  d.command("AcquisitionStart", reg::acquisition, 1, "AcquisitionRegister");
  d.command("AcquisitionStop", 0, 0, "AcquisitionRegister");
  d.integer("AcquisitionFramePeriod", reg::frame_period, read_write);
  d.choice("TriggerSelector", reg::trigger_selector, read_write, {{"FrameStart", 0}});
  d.choice("TriggerMode", reg::trigger_mode, read_write, {{"Off", 0}, {"On", 1}});
  d.choice("TriggerSource", reg::trigger_source, read_write, {{"Line0", 0}, {"Software", 1}});
  d.command("TriggerSoftware", reg::trigger_software, 1, "TriggerSoftwareRegister");
  d.real("ExposureTime", reg::exposure_time, read_write);

  d.category("EventControl", {"EventSelector", "EventNotification", "EventExposureEnd"});
  d.choice("EventSelector", reg::event_selector, read_write, {{"ExposureEnd", 0}});
  d.choice("EventNotification", reg::event_notification, read_write, {{"Off", 0}, {"On", 1}});
  d.integer("EventExposureEnd", reg::event_exposure_end);

  d.category("Scan3dControl",
             {"Scan3dOutputMode", "Scan3dDistanceUnit", "Scan3dCoordinateSelector", "Scan3dCoordinateScale",
              "Scan3dCoordinateOffset", "Scan3dInvalidDataFlag", "Scan3dInvalidDataValue", "Scan3dFocalLength",
              "Scan3dPrincipalPointU", "Scan3dPrincipalPointV", "Scan3dBaseline"});
  d.choice("Scan3dOutputMode", reg::output_mode, read_write,
           {{"CalibratedC", number(SimulatedOutputMode::calibrated_c)},
            {"CalibratedABC_Grid", number(SimulatedOutputMode::calibrated_abc_grid)},
            {"DisparityC", number(SimulatedOutputMode::disparity_c)}});
  d.choice("Scan3dDistanceUnit", reg::distance_unit, read_only, {{"Millimeter", 0}, {"Pixel", 1}});
  d.choice("Scan3dCoordinateSelector", reg::coordinate_selector, read_write, {{"CoordinateC", 0}});
  d.real("Scan3dCoordinateScale", reg::scale);
  d.real("Scan3dCoordinateOffset", reg::offset);
  d.flag("Scan3dInvalidDataFlag", reg::invalid_flag);
  d.real("Scan3dInvalidDataValue", reg::invalid_value);
  d.real("Scan3dFocalLength", reg::focal_length);
  d.real("Scan3dPrincipalPointU", reg::principal_point_u);
  d.real("Scan3dPrincipalPointV", reg::principal_point_v);
  d.real("Scan3dBaseline", reg::baseline);

  d.category("TransportLayerControl", {"PayloadSize"});
  d.integer("PayloadSize", reg::payload_size);
  return d.finished();
}

}  // namespace graspd
