// Loads glTF 2.0 files (.gltf, .glb) into a Scene.
#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <functional>
#include <string>

namespace reflet {

struct GltfOptions {
    /// Which of the file's scenes; < 0: the one the file names as default, else the first.
    int scene = -1;
    /// Receives each warning once, one line without a full stop.
    std::function<void(const std::string&)> warn;
};

/// Reads the file and everything it refers to. Throws Error with one line that names the file and the part of it
/// that is broken; never crashes or hangs on any input. URIs that leave the file's folder are refused.
/// Understood: KHR_mesh_quantization, KHR_draco_mesh_compression, KHR_texture_transform, KHR_lights_punctual,
/// KHR_materials_emissive_strength. Animations of translation, rotation and scale, and skins of four joints a vertex;
/// morph targets are left out, with a warning. Required but unknown: an error; used but unknown: a warning.
Scene loadGltf(const std::filesystem::path& path, const GltfOptions& options = {});

}  // namespace reflet
