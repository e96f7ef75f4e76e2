// The camera that took an image, in the header of its EXR file.
#pragma once

#include "base/image_file.h"
#include "base/math.h"

namespace reflet {

/// As OpenEXR's standard attributes worldToCamera and worldToNDC define it.
struct ImageCamera {
    mat4 worldToCamera{1.0F};  ///< X right, Y up, Z ahead: left-handed
    mat4 worldToNdc{1.0F};     ///< after division by w, (0, 0) is the image's upper left corner, (1, 1) the lower right
};

/// writeExr with the camera in the header.
void writeExr(const std::filesystem::path& path, std::span<const ImageLayer> layers, const ImageCamera& camera);

}  // namespace reflet
