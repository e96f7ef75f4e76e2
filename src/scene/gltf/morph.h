// Reads morph targets of glTF primitives and their weights.
#pragma once

#include "scene/gltf/primitive.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace reflet {

/// Fills mesh.morph. `opened`: the source as opened; used: the vertices of the source that the mesh has, in its order;
/// part: the JSON path of the primitive. Throws Error.
void readGltfMorph(Mesh& mesh, const GltfDocument& document, const tinygltf::Primitive& source,
                   const PrimitiveSource& opened, const std::vector<uint32_t>& used, const std::string& part,
                   GltfReport& report);

/// Replaces the deltas of a mesh with flat normals (from makeFlat) by those of the flat normals that each target has
/// alone.
void makeMorphFlat(Mesh& mesh, const std::string& part, GltfReport& report);

/// Number of morph targets of the file's mesh. Throws Error if its primitives disagree.
size_t gltfMorphTargets(const GltfDocument& document, int mesh, const GltfReport& report);

/// The weights of the node's mesh: the node's, else the mesh's, else zeros; empty without morph targets. part: of the
/// node. Throws Error.
std::vector<float> gltfMorphWeights(const GltfDocument& document, const tinygltf::Node& node, const std::string& part,
                                    const GltfReport& report);

}  // namespace reflet
