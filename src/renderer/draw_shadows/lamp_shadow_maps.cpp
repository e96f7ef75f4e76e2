// Plans and records the lamps' shadow maps.
#include "renderer/draw_shadows/lamp_shadow_maps.h"

#include "base/octahedral.h"
#include "gpu/context.h"
#include "renderer/draw_shadows/emitter_groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

namespace reflet {

namespace {

constexpr float widestSpot = 60.0F;  // degrees from the axis; beyond that a cube map wastes less than a single tile

constexpr float squaredSunDistance = 25.0F;  // at which a lamp brings the irradiance of a directional lamp as strong

float strength(const LampParams& lamp) {
    const float intensity = std::max({lamp.intensity.x, lamp.intensity.y, lamp.intensity.z});
    return lamp.type == lampDirectional ? squaredSunDistance * intensity : intensity;
}

// Indices of the lamps besides emitters that can cast shadows, the strongest first.
std::vector<uint32_t> casters(const LampBlock& lamps, const LampShadowScene& scene) {
    std::vector<uint32_t> indices;
    for (uint32_t i = 0; i < lamps.count; ++i) {
        const uint32_t type = lamps.lamps[i].type;
        const bool distant = type == lampDirectional && !scene.bounds.empty();
        if ((type == lampPoint || type == lampSpot || distant) && strength(lamps.lamps[i]) > 0.0F) {
            indices.push_back(i);
        }
    }
    std::ranges::stable_sort(indices, std::greater<>(), [&](uint32_t i) { return strength(lamps.lamps[i]); });
    // First, as there are few, and as they are nothing without their shadows.
    for (uint32_t i = lamps.count; i-- > 0;) {
        if (lamps.lamps[i].type == lampReflected && strength(lamps.lamps[i]) > 0.0F) {
            indices.insert(indices.begin(), i);
        }
    }
    return indices;
}

bool hasOneTile(const LampParams& lamp) {
    return lamp.type == lampReflected || (lamp.type == lampSpot && lamp.cosOuter > std::cos(glm::radians(widestSpot)));
}

uint32_t tilesOf(const LampParams& lamp) {
    return lamp.type == lampDirectional ? nestedTiles : hasOneTile(lamp) ? 1 : cubeFaces;
}

// index: in the block, of a lamp that is lit wherever this one is.
LampShadow shadowOf(const LampParams& lamp, uint32_t index, uint32_t firstTile, uint32_t tileSize) {
    LampShadow shadow{};
    shadow.lamp = lamp;
    shadow.index = index;
    // lampClearance of scene.h. The map of an emitter leaves out its own surfaces.
    shadow.near = lamp.type == lampEmitter ? 1e-3F : std::max(lamp.radius, 1e-3F);
    shadow.firstTile = firstTile;
    shadow.tiles = cubeFaces;
    shadow.halfTangent = 1.0F;
    if (hasOneTile(lamp)) {
        const vec3 axis = -lamp.toLamp;
        const vec3 side = glm::normalize(glm::cross(std::abs(axis.y) < 0.99F ? vec3(0, 1, 0) : vec3(1, 0, 0), axis));
        shadow.tiles = 1;
        shadow.worldToTile = glm::transpose(mat3(side, glm::cross(axis, side), axis));
        // Padding: two texels for lookups at the cone's edge, and the search radius beyond the cone.
        const float tangent = std::sqrt(1.0F - lamp.cosOuter * lamp.cosOuter) / lamp.cosOuter;
        shadow.halfTangent =
            (tangent + (lamp.radius > 0.0F ? lampSearchTangent : 0.0F)) * (1.0F + 4.0F / static_cast<float>(tileSize));
    }
    return shadow;
}

// Of a reflected sun: a beam as wide as its mirror. What is farther from the mirror than `reach` casts no shadow.
LampShadow beamOf(const LampParams& lamp, uint32_t index, uint32_t tile, uint32_t tileSize, float reach) {
    LampShadow shadow = shadowOf(lamp, index, tile, tileSize);
    const float away = -1.0F / lamp.inverseRange;
    shadow.near = std::max(0.5F * away, away - reach);
    const float half = away / (2.0F * reflectedSunFar);  // of the mirror's diagonal
    const float penumbra = 2.0F * lamp.radius * std::min(reach / away, 1.0F);
    shadow.halfTangent = (half + penumbra) / shadow.near * (1.0F + 4.0F / static_cast<float>(tileSize));
    return shadow;
}

// Slightly in front of the mirror, which itself casts no shadow.
vec4 mirrorOf(const LampParams& lamp) {
    if (lamp.type != lampReflected) {
        return vec4(0.0F);
    }
    const float away = -1.0F / lamp.inverseRange;
    const vec3 n = unpackUnitVector(std::bit_cast<uint32_t>(lamp.spotOffset));
    const float tolerance = 1e-3F * away / reflectedSunFar;
    return {n, -glm::dot(n, lamp.position - away * lamp.toLamp) - tolerance};
}

// Rows are the tile's axes.
mat3 tileRotation(const LampShadow& shadow, uint32_t face) {
    if (shadow.tiles != cubeFaces) {
        return shadow.worldToTile;
    }
    const auto axis = static_cast<int>(face / 2);
    mat3 tileToWorld(0.0F);
    tileToWorld[0][(axis + 1) % 3] = 1.0F;
    tileToWorld[1][(axis + 2) % 3] = 1.0F;
    tileToWorld[2][axis] = face % 2 == 0 ? 1.0F : -1.0F;
    return glm::transpose(tileToWorld);
}

mat4 worldToClip(const LampShadow& shadow, uint32_t face) {
    if (shadow.lamp.type == lampDirectional) {
        return worldToNestedTile(shadow, face);
    }
    mat4 tileToClip(0.0F);
    tileToClip[0][0] = 1.0F / shadow.halfTangent;
    tileToClip[1][1] = 1.0F / shadow.halfTangent;
    tileToClip[2][3] = 1.0F;
    tileToClip[3][2] = shadow.near;
    return tileToClip * mat4(tileRotation(shadow, face)) * glm::translate(mat4(1.0F), -shadow.lamp.position);
}

float distanceTo(const Aabb& box, const vec3& p) {
    return glm::distance(p, glm::clamp(p, box.min, box.max));
}

void pushTile(const gpu::DrawCommands& to, const uvec2& tileAndLamp) {
    to.context.vk.vkCmdPushConstants(to.commands, to.layout, VK_SHADER_STAGE_ALL, sizeof(glm::mat4x3),
                                     sizeof(tileAndLamp), &tileAndLamp);
}

// In a plane with a unit normal.
mat4 reflection(const vec4& plane) {
    mat4 m(1.0F);
    for (int column = 0; column < 4; ++column) {
        const vec4 along = -2.0F * plane[column] * vec4(vec3(plane), 0.0F);
        m[column] += along;
    }
    return m;
}

// Draws all opaque or all cut-out draws into the tiles in which they are visible.
void drawTiles(const gpu::DrawCommands& to, const DrawList& list, const LampShadows& shadows,
               const LampTileParams& params, bool masked) {
    const vec2 pixels(static_cast<float>(shadows.tileSize));
    for (uint32_t i = 0; i < shadows.count; ++i) {
        const LampShadow& shadow = shadows.lamps[i];
        const auto lit = [&](const Draw& d) {
            const bool own = d.emitter && shadow.lamp.type == lampEmitter;
            return d.masked == masked && !own &&
                   distanceTo(d.boundsW, shadow.lamp.position) * shadow.lamp.inverseRange < 1.0F;
        };
        for (uint32_t face = 0; face < shadow.tiles; ++face) {
            const uint32_t tile = shadow.firstTile + face;
            drawIntoTile(to, uvec2(tile % shadows.columns, tile / shadows.columns), shadows.tileSize);
            const uvec2 own(tile, i);
            pushTile(to, own);
            recordDraws(to, list, {lit, Cull::none, masked, params.worldToTile[tile], pixels}, false);
            if (shadow.lamp.type == lampReflected) {
                pushTile(to, own | uvec2(reflectedInTile, 0));
                recordDraws(to, list,
                            {lit, Cull::none, masked, params.worldToTile[tile] * reflection(params.mirror[i]), pixels},
                            false);
            }
        }
    }
}

uint32_t tilesOf(const LampShadows& shadows) {
    const LampShadow& last = shadows.lamps[shadows.count - 1];
    return last.firstTile + last.tiles;
}

}  // namespace

// seenFrom: a lamp or a group of emitters, of which `index` is the first.
static LampShadow plannedShadow(const LampParams& seenFrom, uint32_t index, uint32_t tile, uint32_t tileSize,
                                const LampShadowScene& scene) {
    if (seenFrom.type == lampDirectional) {
        return nestedShadow(seenFrom, index, tile, tileSize, scene);
    }
    return seenFrom.type == lampReflected ? beamOf(seenFrom, index, tile, tileSize, glm::length(scene.bounds.size()))
                                          : shadowOf(seenFrom, index, tile, tileSize);
}

LampShadows planLampShadows(LampBlock& lamps, const ShadowSettings& settings, uint32_t largestSide,
                            const LampShadowScene& scene, const std::function<void(const std::string&)>& warn) {
    LampShadows shadows{};
    shadows.boundsMin = scene.bounds.min;
    shadows.boundsMax = scene.bounds.max;
    if (settings.filter == ShadowFilter::none || settings.lamps == 0) {
        return shadows;
    }
    std::vector<uint32_t> indices = casters(lamps, scene);
    constexpr uint32_t keptForEmitters = 4;
    const uint32_t room = maxShadowedLamps - (anyEmitters(lamps) ? keptForEmitters : 0);
    const uint32_t own = std::min({settings.lamps, room, static_cast<uint32_t>(indices.size())});
    if (indices.size() > own) {
        warn(fmt::format("the scene has {} lamps, but only the strongest {} cast shadows: shadow.lamps is the limit",
                         indices.size(), own));
    }
    indices.resize(own);
    std::vector<EmitterGroup> groups;  // one of each lamp, too
    uint32_t tiles = 0;
    for (const uint32_t i : indices) {
        groups.push_back({{i}, lamps.lamps[i]});
        tiles += tilesOf(lamps.lamps[i]);
    }
    for (EmitterGroup& group :
         groupEmitters(lamps, std::min({settings.lamps, maxShadowedLamps - own, keptForEmitters}))) {
        groups.push_back(std::move(group));
        tiles += cubeFaces;
    }
    shadows.count = static_cast<uint32_t>(groups.size());
    shadows.tileSize = settings.lampResolution;
    shadows.columns = static_cast<uint32_t>(std::ceil(std::sqrt(static_cast<float>(tiles))));
    while (shadows.columns * shadows.tileSize > largestSide) {
        shadows.tileSize /= 2;
    }
    for (uint32_t i = 0, tile = 0; i < shadows.count; tile += shadows.lamps[i++].tiles) {
        for (const uint32_t lamp : groups[i].lamps) {
            lamps.lamps[lamp].shadow = i;
        }
        const LampParams& from = groups[i].seenFrom;
        shadows.lamps[i] = plannedShadow(from, groups[i].lamps.front(), tile, shadows.tileSize, scene);
    }
    if (shadows.tileSize < settings.lampResolution) {
        warn(fmt::format(
            "{} lamp shadow maps of {} texels a side do not fit into one image and are reduced to {}; lower "
            "shadow.lamps or shadow.lamp_resolution",
            tiles, settings.lampResolution, shadows.tileSize));
    }
    return shadows;
}

namespace {

// Everything that the maps depend on, as a cache key.
struct LampMapContents {
    LampTileParams tiles;
    uint32_t tileSize;
    uint32_t columns;
    uint64_t draws;
};
static_assert(sizeof(LampMapContents) == sizeof(LampTileParams) + 16, "padding would differ at random");

}  // namespace

gpu::Image drawLampShadowMap(gpu::PassList& f, gpu::KeptImage& own, const DrawList& list, const LampShadows& shadows) {
    LampTileParams params{};
    for (uint32_t i = 0; i < shadows.count; ++i) {
        params.mirror[i] = mirrorOf(shadows.lamps[i].lamp);
        for (uint32_t face = 0; face < shadows.lamps[i].tiles; ++face) {
            params.worldToTile[shadows.lamps[i].firstTile + face] = worldToClip(shadows.lamps[i], face);
        }
    }
    const uint32_t rows = (tilesOf(shadows) + shadows.columns - 1) / shadows.columns;
    const gpu::Image map = own.target(f, VK_FORMAT_D32_SFLOAT, uvec2(shadows.columns, rows) * shadows.tileSize);
    if (list.version != 0 && own.holds(f, LampMapContents{params, shadows.tileSize, shadows.columns, list.version})) {
        return map;
    }
    // Opaque draws need no fragment shader; cut-out draws test alpha.
    f.raster("lamp_shadow_map", {"lamp_shadow_map.vert"})
        .depth(map, 0.0F)
        .vertices(vertexLayout())
        .params(params)
        .draw([=, &list](const gpu::DrawCommands& to) { drawTiles(to, list, shadows, params, false); });
    f.raster("lamp_shadow_map", {"lamp_shadow_map_masked.vert", "shadow_map_masked.frag"})
        .depth(map, std::nullopt)
        .vertices(vertexLayout(), list.materialLayout)
        .params(params)
        .draw([=, &list](const gpu::DrawCommands& to) { drawTiles(to, list, shadows, params, true); });
    return map;
}

}  // namespace reflet
