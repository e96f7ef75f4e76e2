// Converts primitives of a glTF file to meshes.
#include "scene/gltf/mesh.h"

#include "scene/gltf/morph.h"
#include "scene/gltf/normals.h"
#include "scene/gltf/primitive.h"
#include "scene/thin_meshes.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace reflet {

namespace {

constexpr uint64_t vertexBytes = sizeof(vec3) + sizeof(VertexAttributes) + sizeof(VertexSkin);

/// The vertices that the triangles use, ascending; the triangles are renumbered to match. Primitives often share one
/// long vertex list, of which each uses only a part.
std::vector<uint32_t> takeUsed(std::vector<uint32_t>& triangles, uint32_t vertices) {
    std::vector<uint32_t> used;
    if (vertices <= 4 * triangles.size()) {
        std::vector<uint32_t> renumbered(vertices, 0);
        for (const uint32_t v : triangles) {
            renumbered[v] = 1;
        }
        for (uint32_t v = 0; v < vertices; ++v) {
            if (renumbered[v] != 0) {
                renumbered[v] = static_cast<uint32_t>(used.size());
                used.push_back(v);
            }
        }
        std::transform(triangles.begin(), triangles.end(), triangles.begin(),
                       [&](uint32_t v) { return renumbered[v]; });
        return used;
    }
    used = triangles;
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    std::transform(triangles.begin(), triangles.end(), triangles.begin(), [&](uint32_t v) {
        return static_cast<uint32_t>(std::lower_bound(used.begin(), used.end(), v) - used.begin());
    });
    return used;
}

glm::u16vec4 colorOf(vec4 value, const AccessorView& view) {
    // The specification requires integer colours to be normalized; some files lack the flag.
    if (!view.normalized && view.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) {
        value /= 255.0F;
    } else if (!view.normalized && view.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) {
        value /= 65535.0F;
    }
    if (view.components < 4) {
        value.w = 1.0F;
    }
    glm::u16vec4 result;
    for (int c = 0; c < 4; ++c) {
        const float clamped = value[c] > 0.0F ? std::min(value[c], 1.0F) : 0.0F;  // a NaN becomes 0
        result[c] = static_cast<uint16_t>(std::lround(clamped * 65535.0F));
    }
    return result;
}

/// Leaves out the triangles whose corners are not all finite; their vertices stay, at the place of another one.
void dropInvalidTriangles(Mesh& mesh, std::vector<uint32_t>& triangles, size_t corners, const std::string& part,
                          const GltfReport& report) {
    const auto isPlaced = [&](uint32_t v) { return isFinite(vec4(mesh.positions[v], 1.0F)); };
    size_t kept = 0;
    for (size_t i = 0; i < triangles.size(); i += corners) {
        const auto corner = triangles.begin() + static_cast<std::ptrdiff_t>(i);
        const auto end = corner + static_cast<std::ptrdiff_t>(corners);
        if (std::all_of(corner, end, isPlaced)) {
            std::copy(corner, end, triangles.begin() + static_cast<std::ptrdiff_t>(kept));
            kept += corners;
        }
    }
    triangles.resize(kept);
    if (triangles.empty()) {
        report.fail(part + ".attributes.POSITION", "no triangle has finite positions");
    }
    const vec3 somewhere = mesh.positions[triangles[0]];
    for (uint32_t v = 0; v < mesh.positions.size(); ++v) {
        mesh.positions[v] = isPlaced(v) ? mesh.positions[v] : somewhere;
    }
}

/// The source's triangles index `used`.
void readPositions(Mesh& mesh, PrimitiveSource& source, const std::vector<uint32_t>& used, const std::string& part,
                   GltfReport& report) {
    const AccessorView& view = *source.find("POSITION");
    mesh.positions.reserve(used.size());
    std::optional<uint32_t> invalid;
    for (const uint32_t v : used) {
        const vec4 position = view.at(v);
        mesh.positions.emplace_back(position);
        if (isFinite(position)) {
            mesh.bounds.add(mesh.positions.back());
        } else if (!invalid) {
            invalid = v;
        }
    }
    const bool isValid = report.tolerate("triangles will be missing", [&] {
        if (invalid) {
            report.fail(part + ".attributes.POSITION", "the position of vertex {} is not finite", *invalid);
        }
    });
    if (!isValid) {
        dropInvalidTriangles(mesh, source.triangles, source.corners, part, report);
    }
}

/// Warns of attributes that are not finite; they are replaced later.
void warnUnlessFinite(const vec4& value, std::string_view semantic, const std::string& part, GltfReport& report) {
    if (!isFinite(value)) {
        report.warn(fmt::format("not finite {}", semantic), fmt::format("{}.attributes.{}", part, semantic),
                    "some vertices will be drawn with other values: theirs are not finite");
    }
}

/// set: of the file.
void readUvs(Mesh& mesh, const PrimitiveSource& source, uint32_t set, vec2 VertexAttributes::*member,
             const std::vector<uint32_t>& used, const std::string& part, GltfReport& report) {
    const std::string semantic = fmt::format("TEXCOORD_{}", set);
    const AccessorView* view = source.find(semantic);
    for (size_t i = 0; view != nullptr && i < used.size(); ++i) {
        const vec4 uv = view->at(used[i]);
        warnUnlessFinite(uv, semantic, part, report);
        mesh.attributes[i].*member = isFinite(uv) ? vec2(uv) : vec2(0.0F);
    }
}

void readAttributes(Mesh& mesh, const PrimitiveSource& source, const std::array<uint32_t, 2>& uvSets,
                    const std::vector<uint32_t>& used, const std::string& part, GltfReport& report) {
    mesh.attributes.resize(used.size());
    readUvs(mesh, source, uvSets[0], &VertexAttributes::uv0, used, part, report);
    readUvs(mesh, source, uvSets[1], &VertexAttributes::uv1, used, part, report);
    const AccessorView* normals = source.find("NORMAL");
    const AccessorView* tangents = source.find("TANGENT");
    const AccessorView* colors = source.find("COLOR_0");
    for (size_t i = 0; i < used.size(); ++i) {
        VertexAttributes& vertex = mesh.attributes[i];
        if (normals != nullptr) {
            vertex.normal = vec3(normals->at(used[i]));
        }
        if (tangents != nullptr) {
            vertex.tangent = tangents->at(used[i]);
            warnUnlessFinite(vertex.tangent, "TANGENT", part, report);
        }
        if (colors != nullptr) {
            const vec4 color = colors->at(used[i]);
            warnUnlessFinite(color, "COLOR_0", part, report);
            vertex.color = colorOf(color, *colors);
        }
    }
}

/// Normalizes the weights to a sum of 1; a vertex without weights follows the first joint.
void readSkin(Mesh& mesh, const PrimitiveSource& source, const std::vector<uint32_t>& used, const std::string& part,
              GltfReport& report) {
    std::vector<std::pair<const AccessorView*, const AccessorView*>> sets;  // of four joints each
    for (int set = 0;; ++set) {
        const AccessorView* joints = source.find(fmt::format("JOINTS_{}", set));
        const AccessorView* weights = source.find(fmt::format("WEIGHTS_{}", set));
        if (joints == nullptr || weights == nullptr) {
            break;
        }
        sets.emplace_back(joints, weights);
    }
    if (sets.empty()) {
        return;
    }
    report.charge(part, used.size() * sets.size() * 4 * sizeof(JointWeight));
    std::vector<JointWeight> moved;
    for (const uint32_t v : used) {
        moved.clear();
        float sum = 0.0F;
        for (const auto& [joints, weights] : sets) {
            const vec4 weight = glm::max(weights->at(v), 0.0F);
            warnUnlessFinite(weights->at(v), "WEIGHTS", part, report);
            for (int k = 0; k < 4; ++k) {
                const float joint = joints->at(v)[k];  // a NaN becomes 0
                moved.push_back({joint > 0.0F ? static_cast<uint32_t>(std::min(joint, 65535.0F)) : 0U, weight[k]});
                sum += weight[k];
            }
        }
        if (!(sum > 0.0F) || !std::isfinite(sum)) {
            moved.assign({JointWeight{}});
            sum = 1.0F;
        }
        for (JointWeight& m : moved) {
            m.weight /= sum;
        }
        mesh.addSkin(moved);
    }
}

/// The texture whose coordinates the material's tangents follow; nullptr: it needs none.
const TextureSlot* tangentTexture(const Material& material) {
    for (const TextureSlot* slot :
         {&material.normalTexture, &material.anisotropy.texture, &material.clearcoat.normalTexture}) {
        if (slot->image >= 0) {
            return slot;
        }
    }
    // The plain first set: that of a slot without a texture.
    return material.anisotropy.strength > 0.0F ? &material.anisotropy.texture : nullptr;
}

/// glTF 2.0, 3.7.2.1: missing normals become flat normals, and then the file's tangents are ignored.
void completeFrames(Mesh& mesh, const PrimitiveSource& source, const TextureSlot* tangentTexture,
                    const std::string& part, GltfReport& report) {
    const bool flat = source.find("NORMAL") == nullptr;
    if (flat) {
        report.charge(part, mesh.indices.size() * vertexBytes);
        makeFlat(mesh);
        makeMorphFlat(mesh, part, report);
    } else if (const size_t broken = repairNormals(mesh); broken > 0) {
        report.warn("normals", part + ".attributes.NORMAL",
                    "{} vertices will get the normals of their triangles: theirs have no direction", broken);
    }
    if (!flat && source.find("TANGENT") != nullptr) {
        repairTangents(mesh);
    } else if (tangentTexture != nullptr) {
        report.charge(part, mesh.indices.size() * vertexBytes);  // each triangle may need its own
        makeTangents(mesh, *tangentTexture);
    } else {
        for (VertexAttributes& vertex : mesh.attributes) {
            vertex.tangent = vec4(perpendicular(vertex.normal), 1.0F);
        }
    }
}

/// Index in the file; < 0: the default material. KHR_materials_variants: a primitive keeps its own material in variants
/// that it does not name.
int materialOf(const tinygltf::Primitive& primitive, int variant) {
    const auto found = primitive.extensions.find("KHR_materials_variants");
    if (variant < 0 || found == primitive.extensions.end()) {
        return primitive.material;
    }
    const tinygltf::Value& mappings = found->second.Get("mappings");
    for (size_t m = 0; m < mappings.Size(); ++m) {
        const tinygltf::Value& mapping = mappings.Get(static_cast<int>(m));
        const tinygltf::Value& variants = mapping.Get("variants");
        for (size_t i = 0; i < variants.Size(); ++i) {
            if (variants.Get(static_cast<int>(i)).GetNumberAsInt() == variant) {
                return mapping.Get("material").GetNumberAsInt();
            }
        }
    }
    return primitive.material;
}

}  // namespace

const std::vector<uint32_t>& GltfMeshes::use(int mesh) {
    const auto index = static_cast<size_t>(mesh);
    if (!loaded_[index]) {
        loaded_[index] = true;
        for (size_t p = 0; p < document_.model.meshes[index].primitives.size(); ++p) {
            report_.tolerate("the primitive will not be drawn", [&] { loadPrimitive(index, p); });
        }
    }
    return meshes_[index];
}

void GltfMeshes::loadPrimitive(size_t mesh, size_t primitive) {
    const tinygltf::Primitive& source = document_.model.meshes[mesh].primitives[primitive];
    const std::string part = fmt::format("meshes[{}].primitives[{}]", mesh, primitive);
    if (source.mode < 0) {
        return;  // a stand-in
    }
    if (!source.attributes.contains("POSITION")) {
        report_.fail(part + ".attributes", "has no POSITION");
    }
    PrimitiveSource opened = openPrimitive(document_, source, part, report_);
    const std::vector<uint32_t> used = takeUsed(opened.triangles, opened.find("POSITION")->count);
    report_.charge(part, used.size() * vertexBytes + document_.model.meshes[mesh].name.size());
    Mesh result;
    result.name = document_.model.meshes[mesh].name;
    const bool lit = opened.corners == 3 || opened.find("NORMAL") != nullptr;
    result.material = materials_.use(materialOf(source, variant_), lit);
    readPositions(result, opened, used, part, report_);
    readAttributes(result, opened, materials_.uvSets(result.material), used, part, report_);
    readSkin(result, opened, used, part, report_);
    readGltfMorph(result, document_, source, opened, used, part, report_);
    if (opened.corners < 3) {
        report_.charge(part, opened.triangles.size() * 6 * vertexBytes);
        makeThin(result, opened.triangles, opened.corners);
        if (size_t broken = lit ? repairNormals(result) : 0; broken > 0) {
            report_.warn("normals", part + ".attributes.NORMAL", "{} vertices will get other normals", broken);
        }
        meshes_[mesh].push_back(static_cast<uint32_t>(scene_.meshes.size()));
        scene_.meshes.push_back(std::move(result));
        return;
    }
    result.indices = std::move(opened.triangles);
    completeFrames(result, opened, tangentTexture(scene_.materials[result.material]), part, report_);
    meshes_[mesh].push_back(static_cast<uint32_t>(scene_.meshes.size()));
    scene_.meshes.push_back(std::move(result));
}

}  // namespace reflet
