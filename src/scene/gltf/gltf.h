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
    /// Animation to play, by name or by number from 0; "all"; "none": the file's rest pose. Empty: each in the file's
    /// order that moves nothing of what an earlier one moves. So the first of several clips of one figure plays, and
    /// all of a scene in which each thing has one of its own.
    std::string animation;
    /// The file's Z axis points up, which becomes Y; in glTF it is Y, but some programs write Z.
    bool zUp = false;
    /// Receives each kind of warning once, at the end: one line without a full stop, with the number of further cases.
    std::function<void(const std::string&)> warn;
    /// Invalid parts of the file are errors, even where the rest of it can be drawn.
    bool strict = false;
};

/// Loads the file and everything it refers to. Throws Error with one line that names the file and the invalid part;
/// unless options.strict, only if nothing of the file can be drawn: otherwise it leaves out the smallest part that it
/// can, with a warning. Never crashes or hangs on any input. URIs that leave the file's folder are refused.
/// Supported: the extensions in knownExtensions (schema_tables.h); animations of translation, rotation, scale,
/// morph weights and what gltf/pointer.cpp lists; skins; PNG, JPEG, WebP and KTX 2 without Basis. An unsupported
/// extension is an error if it is required and the file makes no sense without it, else a warning.
Scene loadGltf(const std::filesystem::path& path, const GltfOptions& options = {});

}  // namespace reflet
