// Loads glTF 2.0 files (.gltf, .glb) into a Scene.
#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <functional>
#include <string>

namespace reflet {

struct GltfOptions {
    /// Index of the scene to load; < 0: the file's default scene, or the first.
    int scene = -1;
    /// Name of the material variant (KHR_materials_variants) to load; empty: the file's default materials.
    std::string variant;
    /// Receives each warning once, one line without a full stop.
    std::function<void(const std::string&)> warn;
};

/// Loads the file and everything it refers to. Throws Error with one line that names the file and the invalid part;
/// never crashes or hangs on any input. URIs that leave the file's folder are refused.
/// Supported: KHR_mesh_quantization, KHR_draco_mesh_compression, KHR_texture_transform, KHR_lights_punctual,
/// KHR_materials_emissive_strength, _ior, _specular, _unlit and _variants; animations of translation, rotation and
/// scale; skins with four joints per vertex. Morph targets are ignored with a warning. An unsupported extension is an
/// error if it is required, else a warning.
Scene loadGltf(const std::filesystem::path& path, const GltfOptions& options = {});

}  // namespace reflet
