// The record beside a sequence's images lists everything that they depend on, so that images of different runs are not
// mixed.
#pragma once

#include "job/sequence_names.h"
#include "scene/scene.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <functional>
#include <string>

namespace reflet {

/// A hash of a scene file and of the files that it references; for a built-in scene, its name.
std::string sceneFingerprint(const std::string& scene);

/// All values of a view.
nlohmann::ordered_json recordOf(const View& view);

/// Writes a record of a file's inputs, or compares it with the existing one. Throws Error with the differences; its
/// message ends in `cure`. Several processes may call it at once.
void beginRecord(const std::filesystem::path& file, const nlohmann::ordered_json& record, const std::string& cure);

/// Writes the record of a new sequence, or checks it against the existing one, whose images are then kept. Throws Error
/// with the differences, or if images exist without a record. `overwrite`: first removes all images of that name.
/// Several processes may call it at once, except with `overwrite`. A different "device" is only a warning.
void beginSequence(const FrameNames& names, const nlohmann::ordered_json& record, bool overwrite,
                   const std::function<void(const std::string&)>& warn);

}  // namespace reflet
