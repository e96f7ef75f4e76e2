// A closed room of emissive tiles; neighbouring tiles differ, so the colour of a hit shows where a ray went.
#pragma once

#include "pass/harness.h"

namespace reflet::test {

/// From -half to half around the centre, `tiles` by `tiles` on each wall, seen from inside only. Tiles reflect nothing
/// but 4 % at grazing angles. Radiance 0.2 to 1 in each channel; `radiance`, where given, is that of all.
struct ProbeRoom {
    vec3 center{0.0F};
    vec3 half{1.0F};
    unsigned tiles = 4;
    std::optional<vec3> radiance{};
};
void addProbeRoom(Scene& scene, const ProbeRoom& room);

/// A probe whose box is the room.
Probe probeIn(const ProbeRoom& room, const vec3& position);

/// Settings with which probes are the only source of rays' light, changed by `more`.
Settings probeSettings(const std::vector<std::string>& more);

/// A metal that reflects everything.
Material whiteMetal(float roughness);

}  // namespace reflet::test
