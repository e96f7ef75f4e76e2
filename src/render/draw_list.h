// What raster passes draw: index ranges with a transform and a material, in buffers shared by all. Knows no scene.
#pragma once

#include "base/math.h"
#include "gpu/pass.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace reflet {

struct Draw {
    uint32_t firstIndex = 0;
    uint32_t indexCount = 0;
    int32_t firstVertex = 0;
    mat4 objectToWorld{1.0F};
    mat4 previousObjectToWorld{1.0F};
    Aabb boundsW;
    VkDescriptorSet material = VK_NULL_HANDLE;
    bool masked = false;  ///< has an alpha cutoff
    bool doubleSided = false;
    bool turnedOver = false;  ///< its triangles are clockwise as its vertices have them
};

struct DrawList {
    VkBuffer positions = VK_NULL_HANDLE;          ///< vec3
    VkBuffer previousPositions = VK_NULL_HANDLE;  ///< vec3, as in the last frame; none: all draws are rigid
    VkBuffer attributes = VK_NULL_HANDLE;         ///< VertexAttributes
    VkBuffer indices = VK_NULL_HANDLE;            ///< uint32
    VkDescriptorSetLayout materialLayout = VK_NULL_HANDLE;
    std::vector<Draw> draws;
    Aabb boundsW;                          ///< of all
    uint32_t textureSlots = 0;             ///< a bit for each that some material has a texture in (material.h)
    std::vector<gpu::Image> livePictures;  ///< that materials show, and that passes write
    /// Another number whenever draws cover other places than before. 0: whoever asks takes them for others.
    uint64_t version = 0;
};

/// The vertex buffers of a draw list: position; normal, tangent, uv0, uv1, color; previousPosition.
const gpu::VertexLayout& vertexLayout();

enum class Cull : uint8_t {
    none,
    back,   ///< of single-sided draws
    front,  ///< of all draws
};

struct DrawFilter {
    std::function<bool(const Draw&)> keep;
    Cull cull = Cull::back;
    bool bindMaterials = true;  ///< false: the pipeline has no set 1
    mat4 worldToClip{1.0F};     ///< draws that this puts wholly outside the view are left out
    uint32_t instance = 0;      ///< the shader's gl_InstanceIndex
};

/// What is drawn next goes to a square part of the target, `side` pixels a side; tile: its column and row.
void drawIntoTile(const gpu::DrawCommands& to, const uvec2& tile, uint32_t side);

/// Records the draws that pass the filter. Push constants of the vertex shader: objectToWorld, then (as far as the
/// shader's block reaches) previousObjectToWorld, both mat4x3 in scalar layout.
void recordDraws(const gpu::DrawCommands& to, const DrawList& list, const DrawFilter& filter, bool previousTransform);

}  // namespace reflet
