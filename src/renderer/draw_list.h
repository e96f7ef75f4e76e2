// Draws for raster passes: index ranges with a transform and a material, in shared buffers. Independent of the scene
// classes.
#pragma once

#include "base/math.h"
#include "gpu/pass.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace reflet {

/// A version of a draw's mesh with fewer triangles, and the same vertices.
struct DrawLevel {
    uint32_t firstIndex = 0;
    uint32_t indexCount = 0;
    float error = 0.0F;  ///< distance from the mesh's surface, in object space
    float edge = 0.0F;   ///< length of its longest edge, in object space
};

struct Draw {
    uint32_t firstIndex = 0;
    uint32_t indexCount = 0;
    int32_t firstVertex = 0;
    mat4 objectToWorld{1.0F};
    mat4 previousObjectToWorld{1.0F};
    Aabb boundsW;
    std::span<const Aabb> pieces;       ///< bounds of its parts, in object space; empty: only boundsW is known
    std::span<const DrawLevel> levels;  ///< from fine to coarse; empty: always drawn at full detail
    VkDescriptorSet material = VK_NULL_HANDLE;
    bool masked = false;               ///< has an alpha cutoff
    bool blended = false;              ///< alpha is coverage; masked, too
    bool glass = false;                ///< transmissive
    bool coated = false;               ///< has a clear coat
    bool diffuseTransmission = false;  ///< transmits diffuse light
    float alpha = 1.0F;                ///< blended draws: upper bound of alpha
    bool doubleSided = false;
    bool emitter = false;     ///< lamps replace its emission
    bool turnedOver = false;  ///< its triangles have clockwise winding in object space
};

struct DrawList {
    VkBuffer positions = VK_NULL_HANDLE;          ///< vec3
    VkBuffer previousPositions = VK_NULL_HANDLE;  ///< vec3, of the last frame; none if all draws are rigid
    VkBuffer attributes = VK_NULL_HANDLE;         ///< VertexAttributes
    VkBuffer indices = VK_NULL_HANDLE;            ///< uint32
    VkDescriptorSetLayout materialLayout = VK_NULL_HANDLE;
    std::vector<Draw> draws;
    Aabb boundsW;                          ///< bounds of all draws, world space
    uint32_t textureSlots = 0;             ///< bit mask of the slots for which any material has a texture (material.h)
    uint32_t materialFeatures = 0;         ///< bit mask of materialFeature… that any material has (material.h)
    bool unlit = false;                    ///< nothing reflects light
    bool glass = false;                    ///< some draws are transmissive
    bool frosted = false;                  ///< some transmissive draws are rough
    bool dispersive = false;               ///< some transmissive draws disperse light
    bool murky = false;                    ///< some transmissive draws are partly opaque
    bool coated = false;                   ///< some draws have clear coats
    bool diffuseTransmission = false;      ///< some draws transmit diffuse light
    bool coatedGlass = false;              ///< some coated draws are transmissive
    bool coatedBlended = false;            ///< some coated draws are blended
    std::vector<gpu::Image> livePictures;  ///< camera images shown by materials, written by passes
    /// Changes whenever the draws' geometry or transforms change. 0: treat as always changed.
    uint64_t version = 0;
};

/// The vertex buffers of a draw list: position; normal, tangent, uv0, uv1, color; previousPosition.
const gpu::VertexLayout& vertexLayout();

enum class Cull : uint8_t {
    none,
    back,   ///< back faces of single-sided draws
    front,  ///< front faces of all draws
};

struct DrawFilter {
    std::function<bool(const Draw&)> keep;
    Cull cull = Cull::back;
    bool bindMaterials = true;            ///< false if the pipeline has no descriptor set 1
    mat4 worldToClip{1.0F};               ///< for frustum culling
    vec2 pixels{0.0F};                    ///< size of the viewport, for the level of detail; 0: the finest level
    uint32_t instance = 0;                ///< the shader's gl_InstanceIndex
    std::optional<uint32_t> bothSides{};  ///< index of a draw whose back faces Cull::back keeps
};

/// The level of detail (LOD) to draw: the coarsest whose surface is less than a tenth of a pixel away from the mesh's,
/// and, if materials are bound, whose edges are shorter than two pixels, because attributes are interpolated along
/// them. Null: full detail.
const DrawLevel* levelFor(const Draw& draw, const DrawFilter& filter);

/// Whether recordDraws would record any draw.
bool anyDraws(const DrawList& list, const DrawFilter& filter);

/// Sets viewport and scissor to a square tile of the target, side · side pixels; tile: its column and row.
void drawIntoTile(const gpu::DrawCommands& to, const uvec2& tile, uint32_t side);

/// Records the draws that pass the filter. Push constants of the vertex shader: objectToWorld and, with
/// previousTransform, previousObjectToWorld, both mat4x3 in scalar layout.
void recordDraws(const gpu::DrawCommands& to, const DrawList& list, const DrawFilter& filter, bool previousTransform);

}  // namespace reflet
