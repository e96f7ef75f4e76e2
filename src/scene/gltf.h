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
    /// Receives each kind of warning once, at the end: one line without a full stop, with the number of further cases.
    std::function<void(const std::string&)> warn;
    /// Invalid parts of the file are errors, even where the rest of it can be drawn.
    bool strict = false;
};

/// Loads the file and everything it refers to. Throws Error with one line that names the file and the invalid part;
/// unless options.strict, only if nothing of the file can be drawn: otherwise it leaves out the smallest part that it
/// can, with a warning. Never crashes or hangs on any input. URIs that leave the file's folder are refused. Supported:
/// KHR_mesh_quantization, KHR_draco_mesh_compression, KHR_texture_transform, KHR_lights_punctual and
/// KHR_materials_emissive_strength; animations of translation, rotation and scale; skins with four joints per vertex.
/// Morph targets are ignored with a warning. An unsupported extension is an error if it is required and
/// the file makes no sense without it, else a warning.
Scene loadGltf(const std::filesystem::path& path, const GltfOptions& options = {});

}  // namespace reflet
