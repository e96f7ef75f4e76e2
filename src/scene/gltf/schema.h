// Checks a glTF document against the part of the specification that the loader reads.
#pragma once

#include "scene/gltf/report.h"

#include <nlohmann/json.hpp>

namespace reflet {

/// Returns of the document what the loader reads, whose elements are freed as they are read, with all types, ranges and
/// indices checked and whole numbers as integers. Throws Error with the JSON path of the first invalid value; unless
/// the report is strict, only if nothing can be read without it. Elements that are tolerated until used are stand-ins,
/// to which nothing refers.
nlohmann::json checkedGltfDocument(nlohmann::json document, GltfReport& report);

/// The array of this name in an object of a checked document; empty if there is none.
const nlohmann::json& arrayIn(const nlohmann::json& object, const char* name);

/// Whether the loader supports the extension.
bool knownGltfExtension(const std::string& name);

}  // namespace reflet
