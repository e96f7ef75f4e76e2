// Checks a glTF document against the part of the specification that the loader reads.
#pragma once

#include "scene/gltf_report.h"

#include <nlohmann/json.hpp>

namespace reflet {

/// Returns a copy that holds only what the loader reads, every value of the stated type and in range, every index one
/// that exists, whole numbers as integers. Throws Error with the JSON path of the first value that is not so.
nlohmann::json checkedGltfDocument(const nlohmann::json& document, const GltfReport& report);

/// The extensions that the schema knows.
bool knownGltfExtension(const std::string& name);

}  // namespace reflet
