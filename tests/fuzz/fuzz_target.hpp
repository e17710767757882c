#pragma once

#include <cstddef>
#include <cstdint>

/// The name that libFuzzer calls; the input is any bytes, and nothing may come of it but a clear refusal or a value
/// that can be used. Returns 0.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
