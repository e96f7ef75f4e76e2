// The record beside a sequence's pictures: what they depend on, so that only what belongs together is put together.
#pragma once

#include "apps/sequence_names.h"
#include "scene/scene.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <string>

namespace reflet {

/// A number for the content of a scene's file and of the files that it names; of a built-in scene its name is enough.
std::string sceneFingerprint(const std::string& scene);

/// All of a view, as numbers.
nlohmann::ordered_json recordOf(const View& view);

/// Writes the record of a sequence that begins, or finds that the one there is the same: then its pictures are kept.
/// Throws Error that says what differs, or that there are pictures without a record. `overwrite`: removes all pictures
/// of the name first. Several processes may do it at once, but not with `overwrite`. Another "device" is only a
/// warning.
void beginSequence(const FrameNames& names, const nlohmann::ordered_json& record, bool overwrite,
                   const std::function<void(const std::string&)>& warn);

}  // namespace reflet
