// Does the long work of a report: traces both references of a scene, renders all variants, compares them and writes
// the image files.
#pragma once

#include "device/device.h"
#include "measure/report/file_names.h"
#include "measure/report/page.h"
#include "measure/variants.h"
#include "reference/reference.h"
#include "scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace reflet {

/// Shared by all scenes.
struct ReportWork {
    std::filesystem::path folder;  ///< exists
    uvec2 size{0};
    uint32_t seed = 0;
    uint32_t frames = 1;         ///< frames of each variant
    ReferenceOptions reference;  ///< options of both references; visibleOnly is set by workOn
    TonemapSettings tonemap;     ///< tone mapping of the references
    std::vector<Variant> variants;
};

/// A scene to work on.
struct ReportInput {
    std::string name;
    std::string source;
    std::string description;
    std::string filePrefix;
    std::string position;  ///< for progress: "cubes (1 of 3)"
    Scene scene;
    View view;
};

/// Traces, renders, compares, and writes the images under names from `names`. Throws Error.
ReportScene workOn(const ReportWork& work, const ReportInput& input, gpu::Device& device, FileNames& names);

}  // namespace reflet
