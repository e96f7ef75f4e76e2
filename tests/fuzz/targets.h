// All fuzz targets as functions, for the test programs.
#pragma once

#include <cstddef>
#include <cstdint>

namespace reflet::fuzz {

using Target = int(const uint8_t* bytes, size_t size);

// Of the scene's library.
Target gltf;
Target draco;
Target meshopt;
Target png;
Target jpeg;
Target webp;
Target ktx2;
Target hdr;
Target exr;
Target viewFile;
Target cameraPath;
Target fingerprint;
// Of renderer, capture and window.
Target settings;
Target sequenceRecord;
Target savedState;
// Of the library.
Target api;

}  // namespace reflet::fuzz
