// Frustum-culls and records draws.
#include "renderer/draw_list.h"

#include "gpu/context.h"
#include "scene/scene.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>

namespace reflet {

const gpu::VertexLayout& vertexLayout() {
    static const gpu::VertexLayout layout{
        {sizeof(vec3), sizeof(VertexAttributes), sizeof(vec3)},
        {{"position", 0, VK_FORMAT_R32G32B32_SFLOAT, 0},
         {"normal", 1, VK_FORMAT_R32G32B32_SFLOAT, offsetof(VertexAttributes, normal)},
         {"tangent", 1, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(VertexAttributes, tangent)},
         {"uv0", 1, VK_FORMAT_R32G32_SFLOAT, offsetof(VertexAttributes, uv0)},
         {"uv1", 1, VK_FORMAT_R32G32_SFLOAT, offsetof(VertexAttributes, uv1)},
         {"color", 1, VK_FORMAT_R16G16B16A16_UNORM, offsetof(VertexAttributes, color)},
         {"previousPosition", 2, VK_FORMAT_R32G32B32_SFLOAT, 0}}};
    return layout;
}

namespace {

// Conservative: false only if all corners are outside of the same frustum plane. There is no far plane.
bool intersectsFrustum(const Aabb& box, const mat4& worldToClip) {
    unsigned outside = 0x1F;
    for (unsigned i = 0; i < 8; ++i) {
        const vec4 c = worldToClip * vec4(box.corner(i), 1.0F);
        unsigned corner = 0;
        corner |= c.x < -c.w ? 1U : 0U;
        corner |= c.x > c.w ? 2U : 0U;
        corner |= c.y < -c.w ? 4U : 0U;
        corner |= c.y > c.w ? 8U : 0U;
        corner |= c.z > c.w ? 16U : 0U;
        outside &= corner;
    }
    return outside == 0;
}

VkCullModeFlags cullMode(Cull cull, const Draw& draw) {
    if (cull == Cull::front) {
        return VK_CULL_MODE_FRONT_BIT;
    }
    return cull == Cull::back && !draw.doubleSided ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_NONE;
}

bool passes(const Draw& draw, const DrawFilter& filter) {
    return filter.keep(draw) && intersectsFrustum(draw.boundsW, filter.worldToClip);
}

// Largest distance of a level from the mesh: far below the bias of shadows and rays.
constexpr float mostErrorInPixels = 0.1F;
constexpr float longestEdgeInPixels = 2.0F;

// Upper bound of the length in pixels of a unit vector in object space, anywhere in the draw's bounds; infinite if the
// bounds reach the camera.
float pixelsPerUnit(const Draw& draw, const mat4& worldToClip, const vec2& pixels) {
    const mat4 rows = glm::transpose(worldToClip);
    const vec3 toW(rows[3]);
    const vec3 nearest = glm::mix(draw.boundsW.max, draw.boundsW.min, glm::greaterThan(toW, vec3(0.0F)));
    const float w = glm::dot(toW, nearest) + rows[3].w;
    if (w <= 0.0F) {
        return std::numeric_limits<float>::infinity();
    }
    // d(x/w) = dx/w - x/w dw/w, with |x/w| <= 1 on the screen.
    const float across = 0.5F * std::max(pixels.x * (glm::length(vec3(rows[0])) + glm::length(toW)),
                                         pixels.y * (glm::length(vec3(rows[1])) + glm::length(toW)));
    const mat3 axes(draw.objectToWorld);
    return across * std::max({glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2])}) / w;
}

struct DrawConstants {
    glm::mat4x3 objectToWorld;
    glm::mat4x3 previousObjectToWorld;
};

}  // namespace

const DrawLevel* levelFor(const Draw& draw, const DrawFilter& filter) {
    if (draw.levels.empty() || filter.pixels == vec2(0.0F)) {
        return nullptr;
    }
    const float scale = pixelsPerUnit(draw, filter.worldToClip, filter.pixels);
    const auto fits = [&](const DrawLevel& level) {
        return level.error * scale <= mostErrorInPixels &&
               (!filter.bindMaterials || level.edge * scale <= longestEdgeInPixels);
    };
    const auto coarser = std::ranges::find_if_not(draw.levels, fits);
    return coarser == draw.levels.begin() ? nullptr : &*std::prev(coarser);
}

bool anyDraws(const DrawList& list, const DrawFilter& filter) {
    return std::ranges::any_of(list.draws, [&](const Draw& draw) { return passes(draw, filter); });
}

void drawIntoTile(const gpu::DrawCommands& to, const uvec2& tile, uint32_t side) {
    const glm::ivec2 corner(tile * side);
    const auto length = static_cast<float>(side);
    const VkViewport viewport{static_cast<float>(corner.x), static_cast<float>(corner.y), length, length, 0, 1};
    const VkRect2D scissor{{corner.x, corner.y}, {side, side}};
    to.context.vk.vkCmdSetViewport(to.commands, 0, 1, &viewport);
    to.context.vk.vkCmdSetScissor(to.commands, 0, 1, &scissor);
}

void recordDraws(const gpu::DrawCommands& to, const DrawList& list, const DrawFilter& filter, bool previousTransform) {
    const gpu::DeviceFunctions& vk = to.context.vk;
    const VkBuffer previous = list.previousPositions != VK_NULL_HANDLE ? list.previousPositions : list.positions;
    const VkBuffer buffers[] = {list.positions, list.attributes, previous};
    const VkDeviceSize offsets[] = {0, 0, 0};
    vk.vkCmdBindVertexBuffers(to.commands, 0, 3, buffers, offsets);
    vk.vkCmdBindIndexBuffer(to.commands, list.indices, 0, VK_INDEX_TYPE_UINT32);
    VkDescriptorSet boundMaterial = VK_NULL_HANDLE;
    for (uint32_t i = 0; i < list.draws.size(); ++i) {
        const Draw& draw = list.draws[i];
        if (!passes(draw, filter)) {
            continue;
        }
        if (filter.bindMaterials && draw.material != boundMaterial) {
            boundMaterial = draw.material;
            vk.vkCmdBindDescriptorSets(to.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, to.layout, 1, 1, &boundMaterial, 0,
                                       nullptr);
        }
        const bool mirrored = (glm::determinant(mat3(draw.objectToWorld)) < 0.0F) != draw.turnedOver;
        vk.vkCmdSetFrontFace(to.commands, mirrored ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE);
        const Cull cull = filter.cull == Cull::back && filter.bothSides == i ? Cull::none : filter.cull;
        vk.vkCmdSetCullMode(to.commands, cullMode(cull, draw));
        const DrawConstants constants{glm::mat4x3(draw.objectToWorld), glm::mat4x3(draw.previousObjectToWorld)};
        vk.vkCmdPushConstants(to.commands, to.layout, VK_SHADER_STAGE_ALL, 0,
                              previousTransform ? sizeof(constants) : sizeof(constants.objectToWorld), &constants);
        const DrawLevel* level = levelFor(draw, filter);
        vk.vkCmdDrawIndexed(to.commands, level != nullptr ? level->indexCount : draw.indexCount, 1,
                            level != nullptr ? level->firstIndex : draw.firstIndex, draw.firstVertex, filter.instance);
    }
}

}  // namespace reflet
