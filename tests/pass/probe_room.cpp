// Builds rooms for tests of probes.
#include "pass/probe_room.h"

#include <array>
#include <string>

namespace reflet::test {

namespace {

// Right and up as seen from inside, looking outward along `out`.
struct Wall {
    vec3 out, right, up;
};
constexpr std::array<Wall, 6> walls{{{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                     {{-1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
                                     {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                                     {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
                                     {{0, 0, 1}, {-1, 0, 0}, {0, 1, 0}},
                                     {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}}}};

// One of 27 colours; neighbours differ.
vec3 tileColor(unsigned wall, unsigned x, unsigned y) {
    const unsigned number = 5 * wall + 7 * x + 11 * y;
    return 0.2F + 0.4F * vec3(number % 3, number / 3 % 3, number / 9 % 3);
}

}  // namespace

void addProbeRoom(Scene& scene, const ProbeRoom& room) {
    const float tile = 1.0F / static_cast<float>(room.tiles);
    for (unsigned w = 0; w < walls.size(); ++w) {
        const auto& [out, right, up] = walls.at(w);
        for (unsigned i = 0; i < room.tiles * room.tiles; ++i) {
            const unsigned x = i % room.tiles;
            const unsigned y = i / room.tiles;
            Material material = lambertMaterial(vec3(0.0F));
            material.emissive = room.radiance.value_or(tileColor(w, x, y));
            const vec2 at = (2.0F * vec2(x, y) + 1.0F) * tile - 1.0F;
            const vec3 center = room.center + room.half * (out + at.x * right + at.y * up);
            builtin::place(scene, "tile", builtin::addMaterial(scene, material),
                           builtin::patch({center, room.half * right * tile, room.half * up * tile}));
        }
    }
}

Probe probeIn(const ProbeRoom& room, const vec3& position) {
    return {position, {room.center - room.half, room.center + room.half}};
}

Material whiteMetal(float roughness) {
    Material material = lambertMaterial(vec3(1.0F));
    material.metallic = 1.0F;
    material.roughness = roughness;
    return material;
}

Settings probeSettings(const std::vector<std::string>& more) {
    std::vector<std::string> all{"trace_screen.enabled=false", "diffuse.rays=0", "probes.enabled=true"};
    all.insert(all.end(), more.begin(), more.end());
    return settingsOf(all);
}

}  // namespace reflet::test
