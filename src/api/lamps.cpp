// Shadows of a host's lamps: checks, and as the stages take them.
#include "api/calls.h"
#include "api/frame.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace reflet::api {

namespace {

// A lamp's own message.
template <class... Args>
[[noreturn]] void failLamp(const std::string& name, fmt::format_string<Args...> format, Args&&... args) {
    failArgument("{}{}", name, fmt::format(format, std::forward<Args>(args)...));
}

void checkPositive(float value, const std::string& name, bool mayBeZero) {
    if (!std::isfinite(value) || !(value > 0.0F || (mayBeZero && value == 0.0F))) {
        failLamp(name, ": is {}; must be finite and {}0 metres", value, mayBeZero ? "at least " : "above ");
    }
}

LampParams lampOf(const RefletLampShadow& given, const std::string& name) {
    LampParams lamp{};
    lamp.position = {given.position[0], given.position[1], given.position[2]};
    if (!std::isfinite(glm::dot(lamp.position, lamp.position))) {
        failLamp(name, ".position: is ({}, {}, {}); must be finite", lamp.position.x, lamp.position.y, lamp.position.z);
    }
    checkPositive(given.radius, name + ".radius", true);
    checkPositive(given.range, name + ".range", true);
    lamp.radius = given.radius;
    lamp.inverseRange = given.range > 0.0F ? 1.0F / given.range : 0.0F;
    lamp.intensity = vec3(1.0F);
    lamp.type = lampPoint;
    const vec3 along(given.direction[0], given.direction[1], given.direction[2]);
    if (!std::isfinite(glm::dot(along, along))) {
        failLamp(name, ".direction: is ({}, {}, {}); must be finite", along.x, along.y, along.z);
    }
    if (along != vec3(0.0F)) {
        if (!(given.coneAngle > 0.0F && given.coneAngle < glm::half_pi<float>())) {
            failLamp(name, ".coneAngle: is {}; of a spot it must be above 0 and below pi / 2 radians", given.coneAngle);
        }
        lamp.type = lampSpot;
        lamp.toLamp = -glm::normalize(along);
        lamp.cosOuter = std::cos(given.coneAngle);
        lamp.spotScale = 1.0F / (1.0F - lamp.cosOuter);
        lamp.spotOffset = -lamp.cosOuter * lamp.spotScale;
    }
    return lamp;
}

// To clip space with y down and depth as the image holds it.
mat4 faceMatrix(const RefletLampShadow& given, uint32_t face, const std::string& name) {
    mat4 m;
    for (int k = 0; k < 16; ++k) {
        if (!std::isfinite(given.worldToClip[face][k])) {
            failLamp(name, ".worldToClip[{}][{}]: is not finite", face, k);
        }
        m[k / 4][k % 4] = given.worldToClip[face][k];
    }
    for (int column = 0; column < 4; ++column) {
        vec4& c = m[column];
        c.y = given.clipYUp != 0 ? -c.y : c.y;
        c.z = given.clipDepthFromMinusOne != 0 ? 0.5F * (c.z + c.w) : c.z;
    }
    const vec4 lamp = m * vec4(given.position[0], given.position[1], given.position[2], 1.0F);
    const mat4 rows = glm::transpose(m);
    const float ahead = glm::length(vec3(rows[3]));
    if (!(ahead > 1e-6F)) {
        failLamp(name, ".worldToClip[{}]: is no perspective projection; matrices are column-major", face);
    }
    const float slack = 1e-3F * ahead * (1.0F + glm::length(vec3(m[3])) / ahead);
    if (std::abs(lamp.x) > slack || std::abs(lamp.y) > slack || std::abs(lamp.w) > slack) {
        failLamp(name, ".worldToClip[{}]: takes the lamp's position to ({}, {}, {}, {}); it must be the eye", face,
                 lamp.x, lamp.y, lamp.z, lamp.w);
    }
    return m;
}

// The host's square of texels that a face has.
vec4 tileOf(const RefletLampShadow& given, uint32_t face, const std::string& name) {
    const auto& t = given.tiles[face];
    const bool whole = t[0] == 0 && t[1] == 0 && t[2] == 0;
    const uvec2 size(given.map.width, given.map.height);
    if (whole && (size.x != size.y || given.kind == REFLET_LAMP_MAP_SIX_TILES)) {
        failLamp(name,
                 ".tiles[{}]: is 0, which stands for all of the map, and that is {}x{}; give first texel and side",
                 face, size.x, size.y);
    }
    const uint32_t side = whole ? size.x : t[2];
    if (side < 1 || uint64_t(t[0]) + side > size.x || uint64_t(t[1]) + side > size.y) {
        failLamp(name, ".tiles[{}]: is {} texels from ({}, {}), and the map is {}x{}", face, side, t[0], t[1], size.x,
                 size.y);
    }
    return {static_cast<float>(t[0]), static_cast<float>(t[1]), static_cast<float>(side), static_cast<float>(side)};
}

// The axes and the angle of a single tile are those of the host's map: its texels are the same.
void fitTile(LampShadow& shadow, const mat4& toClip, const std::string& name) {
    const mat4 rows = glm::transpose(toClip);
    const vec3 x(rows[0]);
    const vec3 y(rows[1]);
    const vec3 z(rows[3]);
    const float wide = glm::length(x);
    const float high = glm::length(y);
    const float ahead = glm::length(z);
    const float skew = std::max({std::abs(glm::dot(x, y)) / (wide * high), std::abs(glm::dot(x, z)) / (wide * ahead),
                                 std::abs(glm::dot(y, z)) / (high * ahead), std::abs(wide - high) / wide});
    if (!(skew < 1e-3F)) {
        failLamp(name, ".worldToClip[0]: must be a symmetric projection of the same angle to all sides");
    }
    shadow.worldToTile = glm::transpose(mat3(x / wide, y / high, z / ahead));
    shadow.halfTangent = ahead / wide;
}

uint32_t depthOf(const RefletLampShadow& given, const std::string& name) {
    switch (given.depth) {
        case REFLET_LAMP_DEPTH_REVERSED:
            return lampDepthReversed;
        case REFLET_LAMP_DEPTH_STANDARD:
            return lampDepthStandard;
        case REFLET_LAMP_DEPTH_DISTANCE:
            checkPositive(given.distanceScale, name + ".distanceScale", true);
            return lampDistance;
        default:
            failLamp(name, ".depth: is {}; known values are 0 to 2", static_cast<int>(given.depth));
    }
}

void checkMap(const RefletLampShadow& given, const std::string& name) {
    if (given.kind < REFLET_LAMP_MAP_TILE || given.kind > REFLET_LAMP_MAP_CUBE) {
        failLamp(name, ".kind: is {}; known values are 0 to 2", static_cast<int>(given.kind));
    }
    checkBoolean(given.clipYUp, (name + ".clipYUp").c_str());
    checkBoolean(given.clipDepthFromMinusOne, (name + ".clipDepthFromMinusOne").c_str());
    if (given.map.image == VK_NULL_HANDLE) {
        failLamp(name, ".map.image: is VK_NULL_HANDLE, and is required");
    }
    checkImage(given.map, (name + ".map").c_str(), {},
               given.depth == REFLET_LAMP_DEPTH_DISTANCE && !isDepthFormat(given.map.format) ? 1 : depthChannel);
}

void checkCube(const RefletLampShadow& given, const std::string& name) {
    if (given.map.width != given.map.height) {
        failLamp(name, ".map.width, height: are {}x{}; faces of a cube map are square", given.map.width,
                 given.map.height);
    }
    if (given.depth != REFLET_LAMP_DEPTH_DISTANCE) {
        checkPositive(given.nearPlane, name + ".nearPlane", false);
        if (!(given.farPlane == 0.0F || given.farPlane > given.nearPlane)) {
            failLamp(name, ".farPlane: is {}; must be beyond nearPlane, or 0 for none", given.farPlane);
        }
    }
}

lighting::HostLamp lampInputs(const RefletLampShadow& given, const std::string& name, HostImages& host) {
    lighting::HostLamp in{};
    in.shadow.lamp = lampOf(given, name);
    checkMap(given, name);
    ImportLampParams& import = in.import;
    import.depth = depthOf(given, name);
    import.distanceScale = given.distanceScale > 0.0F ? given.distanceScale : 1.0F;
    import.nearPlane = given.nearPlane;
    import.farPlane = given.farPlane > 0.0F ? given.farPlane : std::numeric_limits<float>::infinity();
    in.isCube = given.kind == REFLET_LAMP_MAP_CUBE;
    in.shadow.tiles = given.kind == REFLET_LAMP_MAP_TILE ? 1 : cubeFaces;
    in.shadow.halfTangent = 1.0F;
    in.shadow.side = given.map.width;
    import.hostFaces = in.isCube ? 0 : in.shadow.tiles;
    for (uint32_t face = 0; face < import.hostFaces; ++face) {
        import.worldToClip[face] = faceMatrix(given, face, name);
        import.tiles[face] = tileOf(given, face, name);
        in.shadow.side = static_cast<uint32_t>(import.tiles[face].z);
    }
    if (in.isCube) {
        checkCube(given, name);
    } else if (in.shadow.tiles == 1) {
        fitTile(in.shadow, import.worldToClip[0], name);
    }
    in.shadow.near = std::max(in.shadow.lamp.radius, 1e-3F);  // as the renderer's
    in.map = host.add(given.map, uvec2(0), in.isCube ? cubeFaces : 1);
    return in;
}

}  // namespace

gpu::Image recordLampShadows(RefletView_T& view, Frame& frame, const Settings& settings,
                             std::vector<lighting::HostLamp>& lamps) {
    gpu::PassList& f = view.recorder;
    if (settings.shadow.filter == ShadowFilter::traced || settings.shadow.filter == ShadowFilter::none) {
        failArgument("shadow.filter: the library looks lamps up in shadow maps alone; set hard, pcf or pcss");
    }
    const lighting::ViewContext& context = contextOf(view, frame);
    frame.lampVisibility = lighting::lampShadow(f, context, settings, frame, lamps);
    frame.lamps = static_cast<uint32_t>(lamps.size());
    finishCall(view, frame);
    return frame.lampVisibility;
}

}  // namespace reflet::api

using namespace reflet;
using namespace reflet::api;

RefletResult refletLampShadows(RefletView view, RefletSettings settings, const RefletLampShadow* lamps, uint32_t count,
                               RefletImage* visibility) {
    return inFrame(view, settings, [&](Frame& frame, const Settings& values) {
        if (visibility == nullptr) {
            failArgument("visibility: is NULL");
        }
        if (count < 1 || count > REFLET_MAX_LAMP_SHADOWS) {
            failArgument("count: is {}; must be 1 to {}", count, REFLET_MAX_LAMP_SHADOWS);
        }
        HostImages host(*view);
        std::vector<lighting::HostLamp> inputs;
        for (uint32_t i = 0; i < count; ++i) {
            const std::string name = fmt::format("lamps[{}]", i);
            const RefletLampShadow given = adopted(elementOf(lamps, i), name.c_str());
            inputs.push_back(lampInputs(given, name, host));
        }
        host.acquire();
        *visibility = resultOf(recordLampShadows(*view, frame, values, inputs));
    });
}
