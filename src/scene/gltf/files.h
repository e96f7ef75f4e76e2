// The files that a glTF scene is made of.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

namespace reflet {

/// Calls `visit` with the bytes of a .gltf or .glb file, then with those of every file that its buffers and images
/// name, in the document's order. Reads them as loadGltf does, with its checks and limits; instead of a file that it
/// would refuse, and warn about, the problem's text is visited. Throws Error if the scene file itself cannot be read.
void visitGltfFiles(const std::filesystem::path& path, const std::function<void(std::span<const uint8_t>)>& visit);

/// The files in the scene's folder that the buffers and images of a .gltf or .glb file name; they need not exist. Empty
/// if the file cannot be read: loading it says why.
std::vector<std::filesystem::path> namedGltfFiles(const std::filesystem::path& path);

}  // namespace reflet
